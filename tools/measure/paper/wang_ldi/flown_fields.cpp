#include "tools/measure/paper/wang_ldi/flown_fields.h"

#include <algorithm>
#include <cmath>

#include "tools/measure/figures.h"
#include "tools/measure/full_geometry.h"
#include "tools/measure/magenta.h"
#include "tools/measure/methods.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr double kErrors_px[] = {0.5, 1, 2, 4, 8}, kRacedErrors_px[] = {1, 2, 4, 8};
constexpr double kRadii_tiles[] = {10, 20, 40, 100, 400, 1000};
constexpr uint32_t kRadiusFrames = 4, kMagentaFrames = 2, kStreamedFrames = 160, kRacedFrames = 8;

// What is switched off, and how.
struct Remedy {
    const char *what, *setting;
};
constexpr Remedy kRemedies[] = {{"holes filled", "fill=0"},
                                {"levels fade", "fade=0"},
                                {"directions fade", "direction-fade=0"},
                                {"splats wider on slopes", "slope-splats=0"},
                                {"textures and colours to the horizon", "far=0"},
                                {"hidden by depth, not by order", "depth=0"},
                                {"tiles in pieces, better diagonals", "cuts=0"},
                                {"what the ground hides left out", "ground-hides=0"},
                                {"near tiles as geometry", "geometry=0"},
                                {"levels of near plants fade", "plant-fade=0"}};

// Runs, and what is said of them.
class Runs {
  public:
    explicit Runs(const Land& land) : near_m_(land.images().cell.nearest_m), tile_m_(land.images().tile_m) {}

    std::string near() const { return fmt::format("@geometry-m={}", near_m_); }
    void add(const std::string& method, FieldRow row) {
        Result<MethodSpec> spec = parse_method(method + "@samples=1");
        if (spec && std::find(specs.begin(), specs.end(), *spec) == specs.end())
            specs.push_back(std::move(*spec)), rows.push_back(std::move(row));
    }
    void add_own_and_paper(const std::string& set, const std::string& what, double x) {
        add("wang-ldi" + near(), {set, "Overlook", what, x});
        add("wang-ldi:paper", {set, "the paper's", what, x});
    }
    void add_errors() {
        for (double error_px : kErrors_px) {
            std::string within = fmt::format("@radius-m={}@error-px={}", kPlantsUpTo_m, error_px);
            add("wang-ldi" + near() + within, {"error", "Overlook", "", error_px});
            add(fmt::format("wang-ldi@geometry-m={}", 2 * kPlantsUpTo_m) + within, {"error", "geometry", "", error_px});
        }
    }
    void add_race(const Land& land, const view::Camera& camera) {
        for (double error_px : kRacedErrors_px) {
            Raced raced = raced_at(land, camera, error_px);
            std::string reach = fmt::format("up to {:.0f} m", raced.geometry_to_m);
            add(raced.own, {"race", "Overlook", "", error_px});
            add(raced.by_processor, {"race", kByProcessor, reach, error_px});
            add(raced.by_opengl, {"race", kByOpenGl, reach, error_px});
        }
    }
    void add_remedies() {
        add_own_and_paper("remedy", "", 1);
        for (const Remedy& remedy : kRemedies)
            add("wang-ldi" + near() + "@" + remedy.setting, {"remedy", "Overlook", remedy.what, 1});
    }
    void add_radii() {
        for (double tiles : kRadii_tiles) {
            std::string within = fmt::format("@radius-m={}", tiles * tile_m_);
            add("wang-ldi" + near() + within, {"radius", "Overlook", "", tiles});
            add("wang-ldi:paper" + within, {"radius", "the paper's", "", tiles});
        }
    }

    std::vector<MethodSpec> specs;
    std::vector<FieldRow> rows;

  private:
    double near_m_, tile_m_;
};

void take(const CourseResult& course, const RunResult& run, bool is_compared, FieldRow& row) {
    Percentiles ms = percentiles_of(run, "frame_ms");
    row.ms_p50 = ms.p50, row.ms_p99 = ms.p99;
    row.samples = percentiles_of(run, "samples_warped").p50, row.triangles = percentiles_of(run, "triangles").p50;
    row.tiles = percentiles_of(run, "tiles").p50;
    for (const FrameRecord& frame : run.frames)
        row.outside_share += double(frame.counters.is_eye_outside) / double(run.frames.size());
    if (!is_compared) return;
    row.e_p99 = mean_of(run, "e_p99_flip"), row.e_mean = mean_of(run, "e_mean_flip"), row.w = mean_of(run, "w_luma");
    row.pop = run.pop.index;
    row.floor_e_p99 = mean_of(course.runs[run.floor], "e_p99_flip");
}

Result<void> fly(World& world, Runs runs, std::vector<view::Camera> cameras, Compared compared, const gl::Renderer& renderer,
                 std::vector<FieldRow>& rows) {
    if (Result<void> fits = check_draws(runs.specs, world); !fits) return fits;
    Course course{runs.specs, std::move(cameras), kWalkStep_s, compared};
    if (compared != Compared::none) add_floors(course.specs);
    Result<CourseResult> flown = run_course(world, course, renderer, "", [](double) {});
    if (!flown) return tl::unexpected(flown.error());
    for (size_t i = 0; i < runs.rows.size(); ++i) {
        take(*flown, flown->runs[i], compared != Compared::none, runs.rows[i]);
        rows.push_back(std::move(runs.rows[i]));
    }
    return {};
}

void compare_race(std::vector<FieldRow>& rows) {
    for (FieldRow& row : rows)
        for (const FieldRow& own : rows)
            if (row.set == "race" && own.set == "race" && row.family != "Overlook" && own.family == "Overlook" && row.x == own.x)
                row.own_times_as_fast = row.ms_p50 / std::max(1e-3, own.ms_p50);
}

Picture picture(int figure, const std::string& name, const std::string& caption, ImageRgb8 image) {
    return {figure, name, caption, std::move(image)};
}

// Holes of everything that is switched off, and pictures of what is not, with and without filling.
Result<void> add_gaps(const Land& land, const std::string& plants, const std::vector<view::Camera>& cameras, FlownLand& flown) {
    Result<World> read = read_world(land.path);
    if (!read) return tl::unexpected(read.error());
    World world = std::move(*read);
    paint_magenta(world);
    if (Result<void> uploaded = upload(world); !uploaded) return uploaded;
    Runs runs(land);
    runs.add_remedies();
    Result<std::vector<Magenta>> found = gaps_over_magenta(world, runs.specs, cameras);
    if (!found) return tl::unexpected(found.error());
    for (size_t i = 0; i < runs.rows.size(); ++i)
        for (FieldRow& row : flown.rows)
            if (row.set == "remedy" && row.family == runs.rows[i].family && row.what == runs.rows[i].what)
                row.in_cell = (*found)[i].in_cell, row.anywhere = (*found)[i].anywhere;
    auto add = [&](const char* name, const std::string& what, const Magenta& one) {
        flown.pictures.push_back(
            picture(0, fmt::format("magenta-{}-{}-{}", name, land.name, plants),
                    fmt::format("{}: in the cell {} % of the pixels are holes, the widest {} px, the largest of {} pixels", what,
                                short_number(100 * one.in_cell.share()), one.in_cell.widest_px, one.in_cell.largest_px),
                    one.worst));
    };
    add("own", "Overlook", (*found)[0]), add("unfilled", "before holes are filled", (*found)[2]);
    add("paper", "the paper's", (*found)[1]);
    flown.pictures.push_back(
        picture(0, fmt::format("magenta-plants-{}-{}", land.name, plants), "the plants themselves", (*found)[0].truth));
    return {};
}

Result<ImageRgb8> drawn(World& world, const std::string& method, const view::Camera& camera) {
    Result<MethodSpec> spec = parse_method(method);
    if (!spec) return tl::unexpected(spec.error());
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, 4);
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> made = make_method(*spec, world);
    made->decide(camera, 0);
    made->draw(*target);
    return target->read();
}

// Figure 10, or figure 1 of a valley.
Result<void> add_views(Land& land, const std::string& plants, const Guide& guide, const FieldOptionsAsked& asked,
                       FlownLand& flown) {
    struct View {
        const char* what;
        double ahead_m, up_m, turned_deg, pitch_deg;
    };
    const View kViews[] = {{"at head height", 0, 0, 0, -4},
                           {"a hundred metres on", 100, 0, 0, -6},
                           {"turned by a right angle", 0, 0, 90, -3},
                           {"turned about", 30, 0, 180, -4},
                           {"from 8 m up, outside the cell", 0, 8, 0, -12},
                           {"from 40 m up, outside the cell", 0, 40, 0, -20}};
    bool is_valley = land.name == "valley";
    std::string own = "wang-ldi" + Runs(land).near();
    int n = 0;
    for (const View& view : kViews) {
        uint32_t width_px = is_valley && n == 0 ? asked.width_px * 3 / 2 : asked.width_px;
        view::Camera camera = guide.camera(view.ahead_m, view.up_m, view.turned_deg, view.pitch_deg, width_px, asked.height_px);
        if (!(view.up_m > 0)) camera = guide.cleared(camera);
        Result<ImageRgb8> image = drawn(land.world, own, camera);
        if (!image) return tl::unexpected(image.error());
        int figure = is_valley && n == 0 ? 1 : 10;
        flown.pictures.push_back(picture(
            figure, fmt::format("figure-{}-{}-{}-{}", figure, land.name, plants, n++),
            fmt::format("{}, {}", land.name == "valley" ? "a real valley, planted below a height" : "gentle hills", view.what),
            std::move(*image)));
    }
    return {};
}

void count_view(const Land& land, const view::Camera& camera, FlownLand& flown) {
    auto plants = wang_ldi::plants_in_sight(land.planted(), camera, kPlantsUpTo_m);
    const std::vector<discrete::Chain>& models = land.world.planted->models();
    for (size_t m = 0; m < plants.size(); ++m) {
        flown.plants_in_view += double(plants[m].placements.size());
        flown.millions_in_view += double(plants[m].placements.size()) * double(models[m].levels.front().triangle_count()) / 1e6;
    }
}

}  // namespace

Raced raced_at(const Land& land, const view::Camera& camera, double error_px) {
    wang_ldi::FrameOptions options;
    options.error_px = error_px;
    const std::optional<wang_ldi::TextureSet>& textures = land.planted().textures();
    uint32_t side_px = textures ? textures->side_px : wang_ldi::texture_side_of_images_px(land.images());
    double to_m = wang_ldi::field_options_of(land.images(), options, camera, side_px).ladder.texture_from_m;
    std::string within = fmt::format("@error-px={}", error_px), geometry = fmt::format("wang-ldi@geometry-m={}", to_m);
    return {to_m, "wang-ldi" + within, geometry + "@geometry-by=1" + within, geometry + "@geometry-by=2" + within};
}

Result<void> race_geometry(Land& land, std::vector<view::Camera> cameras, const gl::Renderer& renderer,
                           std::vector<FieldRow>& rows) {
    Runs runs(land);
    runs.add_race(land, cameras.front());
    if (auto flew = fly(land.world, std::move(runs), std::move(cameras), Compared::none, renderer, rows); !flew) return flew;
    compare_race(rows);
    return {};
}

Result<FlownLand> fly_land(Land& land, const std::string& plants, const FieldOptionsAsked& asked, const gl::Renderer& renderer,
                           const std::function<void(double)>& done) {
    FlownLand flown{land.name, asked.width_px, asked.height_px, asked.judged_width_px, asked.judged_height_px, 0, 0, {}, {}, {}};
    Guide guide(land);
    count_view(land, guide.camera(0, 0, 0, -4, asked.width_px, asked.height_px), flown);
    for (Walk& walk : guide.walks(asked.frames, asked.width_px, asked.height_px)) {
        Runs runs(land);
        runs.add_own_and_paper("flight", walk.name, 0);
        if (auto flew = fly(land.world, std::move(runs), std::move(walk.cameras), Compared::none, renderer, flown.rows); !flew)
            return tl::unexpected(flew.error());
    }
    Walk walk = guide.walks(kRacedFrames, asked.width_px, asked.height_px)[0];
    if (auto raced = race_geometry(land, std::move(walk.cameras), renderer, flown.rows); !raced)
        return tl::unexpected(raced.error());
    done(0.1);
    std::vector<view::Camera> judged = guide.steps(asked.judged_frames, asked.judged_width_px, asked.judged_height_px);
    Runs compared(land), radii(land);
    compared.add_remedies(), compared.add_errors();
    if (auto flew = fly(land.world, std::move(compared), judged, Compared::all, renderer, flown.rows); !flew)
        return tl::unexpected(flew.error());
    done(0.7);
    radii.add_radii();
    if (auto flew = fly(land.world, std::move(radii), guide.steps(kRadiusFrames, asked.width_px, asked.height_px), Compared::none,
                        renderer, flown.rows);
        !flew)
        return tl::unexpected(flew.error());
    judged.resize(std::min<size_t>(judged.size(), kMagentaFrames));
    if (auto added = add_gaps(land, plants, judged, flown); !added) return tl::unexpected(added.error());
    done(0.9);
    Walk drive = guide.walks(std::min(kStreamedFrames, 8 * asked.frames), asked.judged_width_px, asked.judged_height_px)[1];
    Result<StreamedWalk> streamed = walk_streamed(land, drive.cameras, kWalkStep_s);
    if (!streamed) return tl::unexpected(streamed.error());
    flown.streamed = *streamed;
    if (auto added = add_views(land, plants, guide, asked, flown); !added) return tl::unexpected(added.error());
    done(1);
    return flown;
}

}  // namespace overlook::measure::paper::wang
