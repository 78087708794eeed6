#include "tools/measure/paper/wang_ldi/figure_2.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "runtime/gl/timer.h"
#include "runtime/wang_ldi/hole_fill.h"
#include "runtime/wang_ldi/perspective_warp.h"
#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/wang_ldi/broken.h"

namespace overlook::measure::paper::wang {
namespace {

using wang_ldi::Hiding;
using wang_ldi::Warped;

constexpr double kShownNear_m = 0.25, kShownAway_m = 4;  // figure 2b

// Draws a view; says how many samples and how long it took.
using Draw = std::function<Result<WoodCounts>(const view::Camera& camera, Hiding hiding, Warped& picture)>;

Warped empty_for(const view::Camera& camera) {
    Warped empty;
    empty.clear(camera.width_px, camera.height_px);
    return empty;
}

Warped by_rays(const wang_ldi::PerspectiveLdi& picture) {
    view::Camera camera = wang_ldi::camera_of(picture.view);
    Warped shown = empty_for(camera);
    wang_ldi::PerspectiveWarper(picture).warp(camera, Hiding::by_order, shown);
    return shown;
}

double away_of(const SceneFile& file, const wang_ldi::PerspectiveLdi& picture) {
    return std::round(1000 * glm::length(picture.view.position_m - file.scene.image.view.position_m)) / 1000;
}

// Sums over the views of one distance.
struct Sums {
    SeenFrom row;
    std::vector<double> errors, unfilled, ms;
};

Result<void> add_view(const wang_ldi::PerspectiveLdi& view, const wang_ldi::PerspectiveView* image, const Draw& draw,
                      Sums& sums) {
    view::Camera camera = wang_ldi::camera_of(view.view);
    Warped truth = by_rays(view), drawn = empty_for(camera), by_depth = empty_for(camera);
    auto counts = draw(camera, Hiding::by_order, drawn);
    if (!counts) return tl::unexpected(counts.error());
    if (auto again = draw(camera, Hiding::by_depth, by_depth); !again) return tl::unexpected(again.error());
    Warped filled = drawn;
    wang_ldi::fill_holes(filled);
    Broken broken = broken_of(truth, drawn);
    std::vector<double> errors = errors_of(truth, filled), unfilled = errors_of(truth, drawn);
    sums.unfilled.insert(sums.unfilled.end(), unfilled.begin(), unfilled.end());
    SeenFrom& row = sums.row;
    ++row.views, row.hole_share += broken.hole_share, row.wrong_share += broken.wrong_share;
    row.filled_share += broken_of(truth, filled).hole_share, row.order_share += differing_share(drawn, by_depth);
    if (image) row.beyond_share += causes_of_holes(camera, *image, truth, drawn).beyond_share;
    row.samples += double(counts->samples);
    sums.ms.push_back(counts->warp_ms), sums.errors.insert(sums.errors.end(), errors.begin(), errors.end());
    return {};
}

// image: the view of the one image, or null of tiles.
Result<std::vector<SeenFrom>> rows_of(const SceneFile& file, const wang_ldi::PerspectiveView* image, const Draw& draw) {
    std::map<double, Sums> by_distance;
    for (const wang_ldi::PerspectiveLdi& view : file.scene.pictures)
        if (auto added = add_view(view, image, draw, by_distance[away_of(file, view)]); !added)
            return tl::unexpected(added.error());
    std::vector<SeenFrom> rows;
    for (auto& [away_m, sums] : by_distance) {
        SeenFrom row = sums.row;
        row.away_m = away_m;
        for (double* mean :
             {&row.hole_share, &row.filled_share, &row.beyond_share, &row.wrong_share, &row.order_share, &row.samples})
            *mean /= row.views;
        for (double error : sums.errors) row.e_mean += error / double(sums.errors.size());
        for (double error : sums.unfilled) row.unfilled_e_mean += error / double(sums.unfilled.size());
        row.e_p99 = percentile(sums.errors, 0.99), row.warp_ms = percentile(sums.ms, 0.5);
        rows.push_back(row);
    }
    return rows;
}

std::string counted(const SeenFrom& row) {
    return fmt::format("E {} (p99 {}; {} before small holes are filled), {} % holes; {} samples warped in {} ms by one thread",
                       short_number(row.e_mean), short_number(row.e_p99), short_number(row.unfilled_e_mean),
                       short_number(100 * row.hole_share), short_count(row.samples), short_number(row.warp_ms));
}

const SeenFrom* row_at(const Way& way, double away_m) {
    auto at = std::find_if(way.rows.begin(), way.rows.end(), [&](const SeenFrom& row) { return row.away_m == away_m; });
    return at == way.rows.end() ? nullptr : &*at;
}

class Drawing {
  public:
    Drawing(const std::string& plants, Figure2& figure) : plants_(plants), figure_(figure) {}

    // What a way draws and, if named, what rays see, from the first view that is so far away.
    Result<void> show(const SceneFile& file, double away_m, const Draw& draw, const std::string& name, const std::string& caption,
                      const std::string& truth_caption) {
        for (const wang_ldi::PerspectiveLdi& view : file.scene.pictures) {
            if (away_of(file, view) != away_m) continue;
            view::Camera camera = wang_ldi::camera_of(view.view);
            Warped drawn = empty_for(camera);
            if (auto counts = draw(camera, Hiding::by_order, drawn); !counts) return tl::unexpected(counts.error());
            const SeenFrom* row = row_at(figure_.ways.back(), away_m);
            add(name, caption + (row ? ": " + counted(*row) : ""), with_ground(camera, drawn));
            if (!truth_caption.empty()) add(name + "-rays", truth_caption, with_ground(camera, by_rays(view)));
            break;
        }
        return {};
    }

  private:
    void add(const std::string& name, const std::string& caption, ImageRgb8 image) {
        figure_.pictures.push_back({2, name + "-" + plants_, caption, std::move(image)});
    }
    const std::string& plants_;
    Figure2& figure_;
};

Result<void> add_one(const Subject& subject, Figure2& figure) {
    const SceneFile& file = subject.scene;
    wang_ldi::PerspectiveWarper warper(file.scene.image);
    Draw draw = [&](const view::Camera& camera, Hiding hiding, Warped& picture) -> Result<WoodCounts> {
        gl::Timer timer;
        wang_ldi::WarpCounts warped = warper.warp(camera, hiding, picture);
        WoodCounts counts;
        counts.samples = counts.kept = warped.samples, counts.warp_ms = timer.elapsed_ms();
        return counts;
    };
    auto rows = rows_of(file, &file.scene.image.view, draw);
    if (!rows) return tl::unexpected(rows.error());
    figure.ways.push_back({"one LDI", file.scene.image.sample_count(), file.image_bytes, std::move(*rows)});
    Drawing drawing(subject.name, figure);
    auto shown =
        drawing.show(file, 0, draw, "figure-2a", "a: one LDI of the whole scene, from its own place", "by rays, from there");
    if (shown)
        shown = drawing.show(file, kShownNear_m, draw, "figure-2a-near",
                             fmt::format("the same from {} m aside", short_number(kShownNear_m)), "by rays, from there");
    if (!shown) return shown;
    return drawing.show(file, kShownAway_m, draw, "figure-2b",
                        fmt::format("b: the same from {} m aside (means of {} views so far away)", short_number(kShownAway_m),
                                    row_at(figure.ways[0], kShownAway_m) ? row_at(figure.ways[0], kShownAway_m)->views : 0),
                        "by rays, from there");
}

struct Tiles {
    const Bake& bake;
    const SceneFile& file;
    std::string name, figure, caption;
};

Result<void> add_tiles(const Subject& subject, const Tiles& tiles, Figure2& figure) {
    Wood wood(tiles.bake, tiles.file.scene);
    Draw draw = [&](const view::Camera& camera, Hiding hiding, Warped& picture) { return wood.draw(camera, picture, hiding); };
    auto rows = rows_of(tiles.file, nullptr, draw);
    if (!rows) return tl::unexpected(rows.error());
    Way way{tiles.name, 0, 0, std::move(*rows)};
    for (const wang_ldi::Entry& entry : tiles.bake.images().entries())
        way.samples += entry.sample_count, way.bytes += entry.stored_bytes;
    figure.ways.push_back(std::move(way));
    Drawing drawing(subject.name, figure);
    bool has_other_ground = &tiles.file != &subject.scene;
    auto shown =
        drawing.show(tiles.file, 0, draw, tiles.figure, tiles.caption, has_other_ground ? "by rays, of that ground" : "");
    if (!shown || has_other_ground) return shown;
    return drawing.show(tiles.file, kShownAway_m, draw, tiles.figure + "-aside", tiles.caption + ", from where b is seen", "");
}

}  // namespace

Result<Figure2> figure_2(const Subject& subject) {
    Figure2 figure;
    const wang_ldi::PerspectiveLdi& image = subject.scene.scene.image;
    figure.width_px = image.view.width_px, figure.height_px = image.view.height_px;
    figure.tiles_a_side = subject.scene.scene.columns, figure.cell_m = image.cell_m;
    figure.unseen_share = double(image.unseen_share);
    figure.most_layers = most_layers(image);
    if (auto added = add_one(subject, figure); !added) return tl::unexpected(added.error());
    const Tiles kTiles[] = {
        {subject.single, subject.single_scene, "a single tile", "figure-2c", "c: a single tile that repeats"},
        {subject.paper, subject.scene, fmt::format("{} tiles, as published", subject.of_paper.tiles), "figure-2d",
         fmt::format("d: {} tiles, planted as published", subject.of_paper.tiles)},
        {subject.own, subject.own_scene, fmt::format("{} tiles, Overlook", subject.of_own.tiles), "figure-2-own",
         fmt::format("{} tiles as Overlook bakes them by itself, for tiles from {} m on (nearer ones are to be geometry)",
                     subject.of_own.tiles, short_number(subject.own.set().cell.nearest_m))}};
    for (const Tiles& tiles : kTiles)
        if (auto added = add_tiles(subject, tiles, figure); !added) return tl::unexpected(added.error());
    return figure;
}

std::string figure_2_csv(const std::string& plants, const Figure2& figure) {
    std::string csv;
    for (const Way& way : figure.ways)
        for (const SeenFrom& row : way.rows)
            csv += fmt::format("{},\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", plants, way.name, row.away_m, row.views,
                               row.e_mean, row.e_p99, row.unfilled_e_mean, row.hole_share, row.filled_share, row.beyond_share,
                               row.wrong_share, row.order_share, row.samples, row.warp_ms, way.samples, way.bytes);
    return csv;
}

}  // namespace overlook::measure::paper::wang
