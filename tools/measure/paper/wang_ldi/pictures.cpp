#include "tools/measure/paper/wang_ldi/pictures.h"

#include <cmath>
#include <numbers>

#include "runtime/wang_ldi/portraits.h"
#include "runtime/wang_ldi/random.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr uint64_t kSeed = 1;
constexpr int kEyes = 12;              // that the one LDI is put together from
constexpr double kEyesWithin_m = 0.3;  // of its camera
constexpr double kAside_m[] = {0, 0.25, 0.5, 1, 2, 4};
constexpr double kShownAside_m = 4;  // figure 2b
constexpr uint32_t kRingTiles = 10, kRingTile_px = 24;

Picture picture(const Plants& plants, int figure, const std::string& name, const std::string& caption, ImageRgb8 image) {
    return {figure, name + "-" + plants.name, caption, std::move(image)};
}

std::string counted(const WoodCounts& counts) {
    return fmt::format("{} tiles, {} samples, warped in {} ms by one thread: {} million a second",
                       short_count(double(counts.tiles)), short_count(double(counts.samples)), short_number(counts.warp_ms),
                       short_number(double(counts.samples) / std::max(1e-3, counts.warp_ms) / 1000));
}

view::Camera aside(view::Camera camera, double aside_m) {
    camera.position_m += view::axes_of(camera).right * aside_m;
    return camera;
}

wang_ldi::Warped empty_for(const view::Camera& camera) {
    wang_ldi::Warped empty;
    empty.clear(camera.width_px, camera.height_px);
    return empty;
}

// Of what eyes about the camera see of the ground by tiles.
Result<OneLdi> one_of(Wood& wood, const view::Camera& camera) {
    OneLdi one(camera);
    wang_ldi::Random random(kSeed);
    for (int eye = 0; eye < kEyes; ++eye) {
        view::Camera near = camera;
        for (int axis = 0; axis < 3 && eye > 0; ++axis) near.position_m[axis] += kEyesWithin_m * (2 * random.next_unit() - 1);
        wang_ldi::Warped seen = empty_for(near);
        auto counts = wood.draw(near, seen);
        if (!counts) return tl::unexpected(counts.error());
        one.add(near, seen);
    }
    return one;
}

Result<void> add_one_ldi(Wood& wood, const view::Camera& camera, Plants& plants) {
    auto one = one_of(wood, camera);
    if (!one) return tl::unexpected(one.error());
    plants.one_samples = one->sample_count(), plants.one_layers = one->most_layers();
    for (double aside_m : kAside_m) {
        view::Camera there = aside(camera, aside_m);
        wang_ldi::Warped truth = empty_for(there), seen = empty_for(there);
        if (auto counts = wood.draw(there, truth); !counts) return tl::unexpected(counts.error());
        one->draw(there, seen);
        plants.moved.push_back({aside_m, broken_of(truth, seen)});
        bool is_first = aside_m == 0;
        if (!is_first && aside_m != kShownAside_m) continue;
        std::string caption =
            is_first ? fmt::format("one LDI of the whole scene, {} samples in up to {} layers",
                                   short_count(double(plants.one_samples)), plants.one_layers)
                     : fmt::format(
                           "the same from {} m aside: {} % of what should be there is missing, {} % more is too near or too "
                           "far",
                           short_number(aside_m), short_number(100 * plants.moved.back().broken.hole_share),
                           short_number(100 * plants.moved.back().broken.wrong_share));
        plants.pictures.push_back(picture(plants, 2, is_first ? "figure-2a" : "figure-2b", caption, with_ground(there, seen)));
    }
    return {};
}

Result<void> add_field(const Bake& bake, const char* name, const std::string& what, WoodCounts& counts, Plants& plants) {
    auto wood = Wood::make(bake, kSeed);
    if (!wood) return tl::unexpected(wood.error());
    view::Camera camera = wood->camera(kWidth_px, kHeight_px);
    wang_ldi::Warped seen = empty_for(camera);
    auto drawn = wood->draw(camera, seen);
    if (!drawn) return tl::unexpected(drawn.error());
    counts = *drawn;
    plants.pictures.push_back(picture(plants, 2, name, what + ": " + counted(counts), with_ground(camera, seen)));
    return {};
}

Result<void> add_figure_2(const Subject& subject, Plants& plants) {
    auto wood = Wood::make(subject.paper, kSeed);
    if (!wood) return tl::unexpected(wood.error());
    if (auto added = add_one_ldi(*wood, wood->camera(kWidth_px, kHeight_px), plants); !added) return added;
    if (auto added = add_field(subject.single, "figure-2c", "a single tile that repeats", plants.by_single, plants); !added)
        return added;
    std::string tiles = fmt::format("{} tiles, the paper's constants and planting", subject.of_paper.tiles);
    if (auto added = add_field(subject.paper, "figure-2d", tiles, plants.by_paper, plants); !added) return added;
    std::string own =
        fmt::format("{} tiles as Overlook bakes them by itself, for tiles from {} m on (nearer ones are to be geometry)",
                    subject.of_own.tiles, short_number(subject.own.set().cell.nearest_m));
    return add_field(subject.own, "figure-2-own", own, plants.by_own, plants);
}

void add_sheets(const Subject& subject, Plants& plants) {
    struct Said {
        const char* name;
        int figure;
        std::string caption;
        bool is_of_own;
    };
    auto repeats = [](const BakeReport& report) {
        return fmt::format("greatest correlation over lags 2 to 10: {}", short_number(report.correlation));
    };
    const Said kSaid[] = {{"tiles", 3, "the eight tiles", false},
                          {"tiling-32", 4, "a: 32 x 32 of the eight", false},
                          {"tiling-256", 4, "b: 256 x 256 of the eight, " + repeats(subject.of_paper), false},
                          {"robinson-32", 4, "c: 32 x 32 of Robinson's sixteen", false},
                          {"robinson-256", 4, "d: 256 x 256 of Robinson's sixteen, " + repeats(subject.of_robinson), false},
                          {"tiling-256", 4, "256 x 256 of Overlook's own, " + repeats(subject.of_own), true},
                          {"spectrum", 4, "spectrum of b", false},
                          {"robinson-spectrum", 4, "spectrum of d", false},
                          {"spectrum", 4, "spectrum of Overlook's own", true},
                          {"planting-neighbours", 5, "neighbours across an edge, planted as published", false},
                          {"planting-neighbours", 5, "the same, planted corners first", true},
                          {"planting-tiles", 6, "what stands in and over tiles, planted as published", false},
                          {"planting-tiles", 6, "the same, planted corners first", true}};
    for (const Said& said : kSaid)
        for (const auto& [name, image] : said.is_of_own ? subject.own_sheet : subject.sheet)
            if (name == said.name)
                plants.pictures.push_back(
                    picture(plants, said.figure, name + (said.is_of_own ? "-own" : ""), said.caption, image));
}

Result<void> add_portraits(const Subject& subject, Plants& plants) {
    wang_ldi::PortraitOptions small, large;
    large.width_px = 320;
    int tiles_figure = subject.name == "grass" ? 12 : 11;
    auto add = [&](int figure, const char* name, const std::string& caption, const Bake& bake,
                   Result<ImageRgb8> image) -> Result<void> {
        if (!image) return tl::unexpected(Error{image.error().exit, bake.path + ": " + image.error().message});
        plants.pictures.push_back(picture(plants, figure, name, caption, std::move(*image)));
        return {};
    };
    const Bake &paper = subject.paper, &unlit = subject.unlit;
    auto added = add(8, "figure-8", "images for eyes in the south, west, north and east: from there, and from a quarter turn on",
                     paper, directions_portrait(paper.images(), 0, small));
    if (added)
        added = add(9, "figure-9", "a coarse level from where it is for, the same close up, the right one close up", paper,
                    levels_portrait(paper.images(), 0, large));
    if (added)
        added = add(tiles_figure, "figure-tiles-above", "the tiles among their neighbours from above, without light", unlit,
                    tiles_from_above(unlit.images(), unlit.ground, small));
    if (added)
        added = add(tiles_figure, "figure-tiles-aside", "the tiles from aside, each with its own objects alone", paper,
                    tiles_from_aside(paper.images(), paper.ground, small));
    return added;
}

Result<void> add_rings(const Subject& subject, Plants& plants) {
    for (const Bake* bake : {&subject.paper, &subject.own}) {
        auto wood = Wood::make(*bake, kSeed);
        if (!wood) return tl::unexpected(wood.error());
        bool is_own = bake == &subject.own;
        plants.pictures.push_back(picture(
            plants, 7, is_own ? "figure-7-own" : "figure-7",
            fmt::format("levels (brightness) and directions (hue) of the tiles about an eye, {}: {} levels, {} directions",
                        is_own ? "as Overlook chooses them" : "the paper's", wood->set().levels.size(),
                        wood->set().direction_count),
            wood->rings(wood->camera(kWidth_px, kHeight_px), kRingTiles, kRingTile_px)));
    }
    return {};
}

Size size_of(const Bake& bake) {
    Size size;
    for (const wang_ldi::Entry& entry : bake.images().entries())
        size.samples += entry.sample_count, size.stored_bytes += entry.stored_bytes;
    size.file_bytes = bake.file->file_bytes();
    return size;
}

}  // namespace

Result<Plants> plants_of(const Subject& subject, const std::function<void(double)>& done) {
    Plants plants;
    plants.name = subject.name;
    plants.paper = subject.of_paper, plants.own = subject.of_own, plants.single = subject.of_single;
    plants.robinson = subject.of_robinson, plants.gloss = subject.gloss, plants.gloss_none = subject.gloss_none;
    plants.paper_size = size_of(subject.paper), plants.own_size = size_of(subject.own);
    if (auto added = add_figure_2(subject, plants); !added) return tl::unexpected(added.error());
    done(0.6);
    if (subject.one && subject.eight) {
        auto directions = compare_directions(*subject.one, *subject.eight, kSeed);
        if (!directions) return tl::unexpected(directions.error());
        plants.directions = *directions;
    }
    add_sheets(subject, plants);
    if (auto added = add_rings(subject, plants); !added) return tl::unexpected(added.error());
    if (auto added = add_portraits(subject, plants); !added) return tl::unexpected(added.error());
    done(1);
    return plants;
}

}  // namespace overlook::measure::paper::wang
