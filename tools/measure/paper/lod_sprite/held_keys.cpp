#include "tools/measure/paper/lod_sprite/held_keys.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/measure/methods.h"

namespace overlook::measure::paper::sprite {
namespace {

constexpr uint32_t kStepFrames = 600;  // of the paper's flight
uint32_t first_frame_of(uint32_t part, uint32_t parts) {
    return parts == 1 ? (kStepFrames - kHeldFrames) / 2 : part * (kStepFrames - kHeldFrames) / (parts - 1);
}

struct Targets {
    gl::Target picture, middle;
};
Result<Targets> targets_for(const Flying& flying) {
    Result<gl::Target> picture = gl::Target::make(flying.width_px, flying.height_px, 1);
    Result<gl::Target> middle = gl::Target::make(flying.width_px, flying.height_px, 1);
    if (!picture) return tl::unexpected(picture.error());
    if (!middle) return tl::unexpected(middle.error());
    return Targets{std::move(*picture), std::move(*middle)};
}

// One frame of every run.
Result<void> judge_frame(std::vector<HeldRun>& runs, std::vector<std::unique_ptr<Method>>& methods, const Targets& targets,
                         const view::Camera& camera, ReuseTruth& truth) {
    std::optional<Frame> full;
    for (size_t i = 0; i < runs.size(); ++i) {
        std::optional<Sources> sources = methods[i]->sources(targets.middle);
        if (!sources) continue;
        if (!full) {
            Result<Frame> drawn = truth.full_geometry(camera);
            if (!drawn) return tl::unexpected(drawn.error());
            full = std::move(*drawn);
        }
        Result<Reuse> reuse = truth.reuse(*sources, *full);
        if (!reuse) return tl::unexpected(reuse.error());
        JudgedPixels judged = judged_pixels(*sources, *full, *reuse);
        runs[i].tally.add(judged.parallax_px, judged.pixels);
        ++runs[i].judged_frames;
    }
    return {};
}

// A line of one share over the middles of the ranges, of a run each.
Chart share_chart(const std::vector<HeldRun>& runs, const char* name, const char* title, const char* column, double goal,
                  double prototype) {
    Chart chart{name, title, chart_head(runs.size() + 2)};
    chart.script += x_label("parallax, pixels; a point for each range") +
                    "set ylabel '% of the pixels asked of keys'\nset logscale xy\nset xrange [0.5:128]\nset yrange [0.001:100]\n"
                    "set xtics (1, 2, 4, 8, 16, 32, 64)\nset mxtics 1\n";
    chart.script +=
        fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead lc rgb \"#666666\" dt 3\n", HeldGoals::kEdge_px);
    chart.script += "plot ";
    for (size_t i = 0; i < runs.size(); ++i) {
        chart.script += fmt::format(
            "'../held_keys.csv' skip 1 using (strcol(1) eq {0} ? $5 : NaN):(100 * {1} > 0.001 ? 100 * {1} : 0.001) with "
            "linespoints pt {2} ps 0.8 lw 2 lc rgb \"{3}\" title {0}, \\\n",
            gnuplot_text(runs[i].title), column, i < 7 ? 7 : 5, chart_colour(i));
    }
    chart.script += fmt::format(
        "(x <= {0} ? {1} : NaN) with lines lc rgb \"#009E73\" lw 2 dt 2 title 'to reach up to {0} px: {1} %', \\\n"
        "(x <= {0} ? {2} : NaN) with lines lc rgb \"#666666\" lw 2 dt 2 title 'prototype of the paper: {2} %'\n",
        HeldGoals::kEdge_px, 100 * goal, 100 * prototype);
    return chart;
}

}  // namespace

std::vector<HeldRun> held_runs(const Plan& plan) {
    const std::pair<const char*, const char*> asked[] = {
        {"lod-sprite", "lod-sprite"},
        {"lod-sprite:paper@depth-thickness=1e-6", "paper: depth thickness 1e-6"},
        {"lod-sprite:paper@depth-thickness=1e-5", "paper: depth thickness 1e-5"},
        {"lod-sprite:paper@depth-thickness=3e-5", "paper: depth thickness 3e-5"},
        {"lod-sprite:paper@depth-thickness=1e-4", "paper: depth thickness 1e-4"},
        {"lod-sprite:paper@eye-depth=1@depth-thickness=300", "paper: 300 m in eye space"},
        {"lod-sprite:paper@depth-thickness=1e-4@strips=1", "paper: 1e-4 in strips"},
    };
    std::vector<HeldRun> runs;
    for (const auto& [method, title] : asked) {
        Result<Cast> cast = cast_from(plan, {method});
        runs.push_back({at_threshold(cast->sprites[0], kHeldThreshold_px), title, {}, 0});
    }
    return runs;
}

JudgedPixels judged_pixels(const Sources& sources, const Frame& truth, const Reuse& reuse) {
    std::vector<std::vector<float>> by_key;
    for (const view::Camera& key : sources.keys) by_key.push_back(parallax_px(truth, key));
    JudgedPixels judged{by_key.at(0), std::vector<Reused>(truth.depth_m.size(), Reused::well)};
    for (size_t i = 0; i < judged.pixels.size(); ++i) {
        uint8_t source = sources.of_pixel[i];
        if (std::isnan(by_key[0][i])) {
            judged.pixels[i] = Reused::nothing_there;
            continue;
        }
        bool shows_key = source != 0 && source < Sources::kOwn;
        float parallax = shows_key ? 0 : by_key[0][i];
        for (size_t k = 0; k < by_key.size(); ++k) {
            if (shows_key && (source >> k & 1) != 0) parallax = std::max(parallax, by_key[k][i]);
            if (!shows_key) parallax = std::min(parallax, by_key[k][i]);
        }
        judged.parallax_px[i] = parallax;
        if (source == Sources::kNear) judged.pixels[i] = Reused::near;
        if (reuse.is_ghost[i]) judged.pixels[i] = Reused::ghost;
        if (reuse.is_loss[i]) judged.pixels[i] = Reused::loss;
    }
    return judged;
}

Result<std::vector<HeldRun>> fly_held_keys(const Flying& flying, const Plan& plan, uint32_t parts,
                                           const std::function<void(double)>& done) {
    std::vector<HeldRun> runs = held_runs(plan);
    Result<Targets> targets = targets_for(flying);
    if (!targets) return tl::unexpected(targets.error());
    ReuseTruth truth(flying.world);
    std::vector<view::Camera> cameras = cameras_of(flying, kStepFrames);
    for (uint32_t part = 0; part < parts; ++part) {
        std::vector<std::unique_ptr<Method>> methods;
        for (const HeldRun& run : runs) methods.push_back(make_method(run.spec, flying.world));
        for (uint32_t frame = 0; frame < kHeldFrames; ++frame) {
            const view::Camera& camera = cameras[first_frame_of(part, parts) + frame];
            for (const std::unique_ptr<Method>& method : methods) {
                method->decide(camera, frame);
                method->draw(targets->picture);
            }
            if (frame % kHeldStep != kHeldStep - 1) continue;
            if (Result<void> judged = judge_frame(runs, methods, *targets, camera, truth); !judged)
                return tl::unexpected(judged.error());
            done((part + double(frame + 1) / kHeldFrames) / parts);
        }
    }
    return runs;
}

// parallax_px: the geometric middle of the range, for charts.
std::string held_keys_csv(const std::vector<HeldRun>& runs) {
    std::string csv = "run,frames,from_px,to_px,parallax_px,asked_px,ghost_share,loss_share,near_px\n";
    for (const HeldRun& run : runs) {
        for (const ParallaxBin& bin : run.tally.bins()) {
            double low = std::max(bin.from_px, 0.5), high = std::isinf(bin.to_px) ? 2 * bin.from_px : bin.to_px;
            csv += fmt::format("{},{},{},{},{:.4g},{},{},{},{}\n", run.title, run.judged_frames, bin.from_px,
                               std::isinf(bin.to_px) ? "" : fmt::format("{}", bin.to_px), std::sqrt(low * high), bin.asked_px,
                               bin.ghost_share(), bin.loss_share(), bin.near_px);
        }
    }
    return csv;
}

std::vector<Chart> held_keys_charts(const std::vector<HeldRun>& runs) {
    return {
        share_chart(runs, "ghosts-parallax", "Ghosts against parallax", "$7", HeldGoals::kGhosts, HeldGoals::kPrototypeGhosts),
        share_chart(runs, "losses-parallax", "Losses against parallax", "$8", HeldGoals::kLosses, HeldGoals::kPrototypeLosses)};
}

}  // namespace overlook::measure::paper::sprite
