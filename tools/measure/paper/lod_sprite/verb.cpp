#include "tools/measure/paper/lod_sprite/verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "formats/mapped_file.h"
#include "tools/measure/deliver.h"
#include "tools/measure/methods.h"
#include "tools/measure/options.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/lod_sprite/paper_page.h"
#include "tools/measure/paper/lod_sprite/targets.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::sprite {
namespace {

Result<void> fly_views(const Flying& flying, Flown& flown) {
    for (const PlanView& view : flown.plan.views) {
        Result<ViewPictures> pictures = draw_view(flying, flown.cast, view);
        if (!pictures) return tl::unexpected(pictures.error());
        flown.views.push_back(std::move(*pictures));
    }
    return {};
}

// The run at the full number of frames is one of figure 12's points.
Result<void> fly_counts(const Flying& flying, Flown& flown, const std::function<void(double)>& done) {
    const uint32_t counts[] = {flying.frames / 8, flying.frames / 4, flying.frames / 2, flying.frames * 2};
    Result<std::vector<Swept>> swept = fly_frame_counts(flying, flown.cast, counts, done);
    if (!swept) return tl::unexpected(swept.error());
    flown.frame_counts = std::move(*swept);
    for (const RunResult* sprite : sprites_of(flown)) flown.frame_counts.push_back(swept_from(*sprite, nullptr, kThreshold_px));
    std::stable_sort(flown.frame_counts.begin(), flown.frame_counts.end(), [](const Swept& a, const Swept& b) {
        return a.family != b.family ? a.family < b.family : a.frames < b.frames;
    });
    return {};
}

// Puts what was flown where it is kept.
template <class T>
Result<void> keep(Result<T> flown, T& into) {
    if (!flown) return tl::unexpected(flown.error());
    into = std::move(*flown);
    return {};
}

Result<Flown> fly_all(const Flying& flying, const Plan& plan, const Cast& cast, const PaperOptions& options,
                      const command::Common& common) {
    Flown flown{plan, cast, {}, step_s(flying, flying.frames), {}, {}, {}, path_of(flying, flying.frames), {}, {}};
    command::Progress progress(common, "flying");
    if (Result<void> drawn = fly_views(flying, flown); !drawn) return tl::unexpected(drawn.error());
    Result<void> kept;
    {
        Part part(progress, common, "side by side", 0.02, 0.4);
        kept = keep(fly_beside(flying, cast, part.done()), flown.beside);
    }
    if (kept && options.remedy_frames > 0) {
        Part part(progress, common, "remedies", 0.4, 0.6);
        kept = keep(fly_remedies(flying, plan, options.remedy_frames, part.done()), flown.remedies);
    }
    if (kept && options.held_parts > 0) {
        Part part(progress, common, "held keys", 0.6, 0.7);
        kept = keep(fly_held_keys(flying, plan, options.held_parts, part.done()), flown.held);
    }
    if (kept && !options.has_no_sweeps) {
        Part part(progress, common, "thresholds", 0.7, 0.9);
        kept = keep(fly_thresholds(flying, cast, options.thresholds_px, part.done()), flown.thresholds);
    }
    if (kept && !options.has_no_sweeps) {
        Part part(progress, common, "numbers of frames", 0.9, 1);
        kept = fly_counts(flying, flown, part.done());
    }
    if (!kept) return tl::unexpected(kept.error());
    return flown;
}

// The page that measure makes of the same run keeps another name.
Result<void> keep_measured_page(const std::string& out) {
    std::error_code problem;
    std::filesystem::rename(out + "/index.html", out + "/measured.html", problem);
    if (problem) return cannot_write("{}/measured.html: cannot write: {}", out, problem.message());
    return {};
}

Result<void> deliver_paper(const Flown& flown, const World& world, const RunSetup& setup, const std::string& out,
                           const command::Common& common) {
    command::Common quiet = common;
    quiet.quiet = true;
    if (Result<void> delivered = deliver(flown.beside, setup, out, quiet); !delivered) return delivered;
    if (Result<void> kept = keep_measured_page(out); !kept) return kept;
    std::vector<std::vector<FigurePicture>> pictures;
    for (const ViewPictures& view : flown.views) pictures.push_back(pictures_of(view));
    Leavings leavings;
    leavings.tables = {{"thresholds.csv", swept_csv(flown.thresholds)},
                       {"frame_counts.csv", swept_csv(flown.frame_counts)},
                       {"path.csv", path_csv(flown)},
                       {"map.csv", map_csv(world)},
                       {"remedies.csv", remedies_csv(flown.remedies)},
                       {"held_keys.csv", held_keys_csv(flown.held)}};
    for (const std::vector<FigurePicture>& view : pictures)
        for (const FigurePicture& picture : view) leavings.pictures.emplace_back(picture.name, &picture.image);
    std::vector<Chart> charts = charts_8_to_14(flown), held = held_keys_charts(flown.held);
    leavings.charts = charts;
    if (!flown.held.empty()) leavings.charts.insert(leavings.charts.end(), held.begin(), held.end());
    leavings.page = [&](bool has_charts) { return paper_page_html({flown, setup, charts, pictures, has_charts}); };
    for (const Target& target : targets_of(flown)) leavings.targets.push_back(target_line(target, sprite_names(flown)));
    return leave(leavings, out, common);
}

RunSetup setup_of(const Flying& flying, double step_s, const std::vector<std::string>& words) {
    RunSetup setup = setup_here(flying.renderer, flying.width_px, flying.height_px, words);
    setup.scene = flying.world.name;
    setup.scene_hash = flying.world.content_hash;
    std::string flight = scene::json_from_flight(flying.flight);
    setup.flight = "flight.json";
    setup.flight_hash = content_hash(std::as_bytes(std::span(flight)));
    setup.step_s = step_s;
    return setup;
}

}  // namespace

CLI::App* add_verb(CLI::App& app, PaperOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "lod-sprite", "Section 4 of the LOD-sprite paper: figures 6 to 14 as pictures, tables, charts and a page");
    verb.add_option("folder", options.folder, "What make-sample lod-sprite made, with sample.ovl baked into it")
        ->required()
        ->type_name("FOLDER");
    verb.add_option("--method", options.methods,
                    "Flown beside the high and the low cut, as of measure; may be repeated; default lod-sprite:paper, lod-sprite")
        ->type_name("METHOD")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("--size", options.size, "Size of the pictures in pixels")->type_name("WxH")->capture_default_str();
    verb.add_option("--frames", options.frames, "Frames on the way; figure 12 takes an eighth to twice as many")
        ->type_name("N")
        ->check(command::number_in(16, 10000))
        ->capture_default_str();
    verb.add_option("--remedy-frames", options.remedy_frames, "Frames with each remedy switched off alone; 0 = leave them out")
        ->type_name("N")
        ->check(command::number_in(0, 540))
        ->capture_default_str();
    verb.add_option("--held-keys", options.held_parts,
                    "Keys held over 60 frames each, for ghosts and losses against parallax; 0 = leave them out")
        ->type_name("N")
        ->check(command::number_in(0, 100))
        ->capture_default_str();
    verb.add_flag("--no-sweeps", options.has_no_sweeps, "Leave out figures 12 to 14: other numbers of frames, other thresholds");
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<Plan> plan = read_plan(options.folder + "/run.json");
    if (!plan) return tl::unexpected(plan.error());
    Result<Cast> cast = cast_from(*plan, options.methods);
    if (!cast) return tl::unexpected(cast.error());
    Result<scene::Flight> flight = scene::read_flight(options.folder + "/flight.json");
    if (!flight) return tl::unexpected(flight.error());
    uint32_t width_px = 0, height_px = 0;
    if (Result<void> size = parse_size(options.size, width_px, height_px); !size) return size;
    Result<World> read = read_world(options.folder + "/scene.json");
    if (!read) return tl::unexpected(read.error());
    if (Result<void> made = make_folders(options.out, {"images", "cache"}); !made) return made;

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    World world = std::move(*read);  // goes before the context
    if (Result<void> uploaded = upload(world); !uploaded) return uploaded;
    Flying flying{world, context->renderer(), *flight, width_px, height_px, options.frames, options.out + "/cache"};
    Result<Flown> flown = fly_all(flying, *plan, *cast, options, common);
    if (!flown) return tl::unexpected(flown.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});

    RunSetup setup = setup_of(flying, flown->step_s, words);
    return deliver_paper(*flown, world, setup, options.out, common);
}

}  // namespace overlook::measure::paper::sprite
