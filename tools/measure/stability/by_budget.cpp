// S19: what is drawn under a budget of triangles that is halved at once.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "runtime/view/error_budget.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kSettled = 20;     // frames after which a budget has to be kept
constexpr double kFirstBudget = 0.8;  // of the triangles that a frame takes at the error asked
constexpr double kBudgetBand = 0.05;  // a budget is met within this share of it

// What a flight of counted triangles under a budget halved at `middle` showed. A frame misses it by what it takes more or less.
struct Budgeted {
    uint32_t frames_until_met = 0;
    double miss_share = 0;
    uint32_t changes_of_sign = 0;
    double free_mean = 0;  // of what frames take without a budget when all has settled
};
Budgeted judge_budget(const std::vector<double>& costs, const std::vector<double>& free, size_t middle, double budget) {
    Budgeted found;
    auto miss = [&](size_t frame) { return std::abs(costs[frame] - budget) / budget; };
    int sign = 0;
    for (size_t frame = middle; frame < costs.size(); ++frame) {
        size_t after = frame - middle;
        if (miss(frame) > kBudgetBand) found.frames_until_met = uint32_t(after + 1);
        if (after >= kSettled) {
            found.miss_share = std::max(found.miss_share, miss(frame));
            found.free_mean += free[frame] / double(costs.size() - middle - kSettled);
        }
        int now = costs[frame] > budget ? 1 : -1;
        if (after <= kSettled && sign != 0 && now != sign) ++found.changes_of_sign;
        sign = now;
    }
    return found;
}

// Of a flight whose budget holds nothing back nothing is found: no gate is kept or missed by that.
void say(const Budgeted& found, double budget, Finding& finding) {
    finding.sentence += fmt::format(" Without a budget a frame takes {:.0f} on the average from {} frames after that on.",
                                    found.free_mean, kSettled);
    if (found.free_mean <= budget) return;
    finding.figures["budget_miss_share"] = found.miss_share;
    finding.figures["frames_until_budget_met"] = found.frames_until_met;
    finding.figures["changes_of_sign"] = found.changes_of_sign;
}

constexpr double kStarted = 0.5;  // of the frames before the middle: what starting costs is over by then

// What the frames of a flight cost, all that is drawn into pictures to be shown again included. Within `budget` triangles (0 = as
// many as they take), and within `share` of it from the middle frame on.
Result<std::vector<double>> costs_of(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                                     double budget, double share) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    method->set_triangles(budget);
    std::vector<double> costs;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        if (frame == cameras.size() / 2) method->set_triangles(share * budget);
        method->decide(cameras[frame], frame);
        costs.push_back(double(method->draw(*target).triangle_count));
    }
    return costs;
}

Result<Finding> keeps_no_budget(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    Finding finding;
    for (const char* name : {"budget_miss_share", "frames_until_budget_met", "changes_of_sign"}) finding.figures[name] = kNever;
    finding.frames = uint32_t(cameras.size());
    finding.sentence = "It keeps no budget of triangles.";
    Result<Shot> shot = shot_of(stage, spec, cameras.back(), uint32_t(cameras.size() - 1));
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

// The budget before it is halved is so much of what a frame takes on the average without one.
Result<Finding> halved_budget_by_method(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                                        double share) {
    if (!stage.make(spec, stage.world)->set_triangles(0)) return keeps_no_budget(stage, spec, cameras);
    size_t middle = cameras.size() / 2;
    Result<std::vector<double>> free = costs_of(stage, spec, cameras, 0, 1);
    if (!free) return tl::unexpected(free.error());
    auto started = free->begin() + ptrdiff_t(kStarted * double(middle)), ended = free->begin() + ptrdiff_t(middle);
    double mean = std::accumulate(started, ended, 0.0) / double(ended - started), budget = kFirstBudget * mean;
    Result<std::vector<double>> costs = costs_of(stage, spec, cameras, budget, share);
    if (!costs) return tl::unexpected(costs.error());
    Budgeted found = judge_budget(*costs, *free, middle, share * budget);
    Finding finding;
    finding.frames = uint32_t(cameras.size());
    auto [least, most] = std::minmax_element(costs->begin() + ptrdiff_t(middle + kSettled), costs->end());
    auto settled = free->begin() + ptrdiff_t(middle + kSettled);
    finding.sentence = fmt::format(
        "A frame takes {:.0f} triangles without a budget{}. {:.0f} allowed from frame {} on: {:.0f} to {:.0f} drawn, {} frames "
        "after that, where {:.0f} at least would be taken without.",
        mean, is_image(spec) ? ", those drawn into keys included" : "", share * budget, middle, *least, *most, kSettled,
        *std::min_element(settled, free->end()));
    say(found, share * budget, finding);
    Result<Shot> shot = shot_of(stage, spec, cameras.back(), uint32_t(cameras.size() - 1));
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

// Of terrain whose cuts are counted by themselves; the budget before it is halved is so much of what the first frame takes.
Result<Finding> halved_budget_by_cut(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                                     double share) {
    size_t middle = cameras.size() / 2;
    terrain::Cut cut;
    stage.world.refiner->cut_by_pixels(cameras[0], setting(spec, "error-px"), cut, morph_of(spec));
    view::ErrorBudget budget{kFirstBudget * double(cut.triangle_count()), setting(spec, "error-px"), false};
    view::ErrorController controller(budget);
    std::vector<double> costs, free;
    for (size_t frame = 0; frame < cameras.size(); ++frame) {
        stage.world.refiner->cut_by_pixels(cameras[frame], budget.least_error_px, cut, morph_of(spec));
        free.push_back(double(cut.triangle_count()));
        if (frame == middle) {
            budget.cost *= share;
            controller.set_budget(budget);
        }
        stage.world.refiner->cut_by_pixels(cameras[frame], controller.error_px(), cut, morph_of(spec));
        costs.push_back(double(cut.triangle_count()));
        controller.frame_done(costs.back());
    }
    Budgeted found = judge_budget(costs, free, middle, budget.cost);
    Finding finding;
    finding.frames = uint32_t(cameras.size());
    finding.sentence =
        fmt::format("{:.0f} triangles from frame {} on; {:.0f} in the frame before, {:.0f} in the last, at {:.2f} px.",
                    budget.cost, middle, costs[middle - 1], costs.back(), controller.error_px());
    say(found, budget.cost, finding);
    MethodSpec last = spec;
    for (auto& [name, value] : last.settings) value = name == "error-px" ? controller.error_px() : value;
    Result<Shot> shot = shot_of(stage, last, cameras.back(), uint32_t(cameras.size() - 1));
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

}  // namespace

Result<std::vector<Finding>> run_halved_budget(Stage& stage, const Case& each, const scene::Flight& flight,
                                               std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    double share = each.settings.budget_share;
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Finding> finding = is_cut(stage, spec) ? halved_budget_by_cut(stage, spec, cameras, share)
                                                      : halved_budget_by_method(stage, spec, cameras, share);
        if (!finding) return tl::unexpected(finding.error());
        findings.push_back(std::move(*finding));
    }
    return findings;
}

}  // namespace overlook::measure
