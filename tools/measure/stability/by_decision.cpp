// The cases that are judged on what is decided: which vertices, at which error, promised how well.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "runtime/view/error_budget.h"
#include "tools/measure/honesty/terrain_honesty.h"
#include "tools/measure/numbers/honesty_tally.h"
#include "tools/measure/stability/stage.h"
#include "tools/measure/stability/surface.h"

namespace overlook::measure {
namespace {

constexpr double kSeen_px = 0.1;      // a vertex that comes or goes by less does not switch anything
constexpr uint32_t kMostSlopes = 8;   // frames; every sample of each is measured
constexpr uint32_t kSettled = 20;     // frames after which a budget has to be kept
constexpr double kFirstBudget = 0.8;  // of the triangles of the first frame at the error asked
constexpr double kBudgetBand = 0.05;  // a budget is met within this share of it

// Whether what is decided is a cut of a terrain, which depends on the camera alone.
bool is_cut(const Stage& stage, const MethodSpec& spec) {
    return stage.world.terrain != nullptr && !is_image(spec);
}

struct Switching {
    uint64_t came_or_went = 0, switches = 0, while_still = 0;
    double greatest_px = 0;
    uint32_t greatest_frame = 0;
};

bool stands_still(const view::Camera& a, const view::Camera& b) {
    return a.position_m == b.position_m && a.heading_deg == b.heading_deg && a.pitch_deg == b.pitch_deg;
}

// Of two frames after each other: the vertices of one that the other lacks, and how far the surface there moved at once.
void compare(const Surface& here, const Surface& there, const view::Camera& camera, uint32_t frame, bool is_still,
             Switching& all) {
    for (uint32_t sample : here.vertices()) {
        if (there.is_vertex(sample)) continue;
        double jump_px = here.distance_px(sample, there.height_m(sample), camera);
        if (std::isnan(jump_px)) continue;
        ++all.came_or_went;
        if (is_still) ++all.while_still;
        if (jump_px > kSeen_px) ++all.switches;
        if (jump_px <= all.greatest_px) continue;
        all.greatest_px = jump_px;
        all.greatest_frame = frame;
    }
}

Switching switching_of(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras, double step_s) {
    const terrain::Terrain& terrain = *stage.world.terrain;
    Switching all;
    Surface before(terrain), now(terrain);
    terrain::Cut cut;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        stage.world.refiner->cut_by_pixels(cameras[frame], setting(spec, "error-px"), cut, morph_of(spec));
        now.take(cut);
        // Frames whose step from the one before ends after the first second.
        if (frame > 0 && (frame - 1) * step_s >= 1) {
            bool is_still = stands_still(cameras[frame - 1], cameras[frame]);
            compare(now, before, cameras[frame], frame, is_still, all);
            compare(before, now, cameras[frame], frame, is_still, all);
        }
        std::swap(before, now);
    }
    return all;
}

// What switches in a method that shows pictures again: one picture takes over from another.
Result<Finding> key_switches(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                             double step_s) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    uint64_t switches = 0, while_still = 0, first_second = 0;
    uint32_t last = 0;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        uint64_t events = method->draw(*target).event_count;
        if (events == 0) continue;
        last = frame;
        bool is_after = frame > 0 && (frame - 1) * step_s >= 1;
        (is_after ? switches : first_second) += events;
        if (is_after && stands_still(cameras[frame - 1], cameras[frame])) while_still += events;
    }
    Finding finding;
    finding.figures["switches_after_first_second"] = double(switches);
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "Keys took over {} times in the first second and {} times after it, {} of these while the "
        "camera stood still; the last one in frame {}.",
        first_second, switches, while_still, last);
    Result<Shot> shot = shot_of(stage, spec, cameras[last], last);
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

// What switches in a mesh: splits and collapses, and levels exchanged for the whole of it or of an instance.
Result<Finding> operations_at_rest(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                                   double step_s) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    uint64_t switches = 0, while_still = 0, first_second = 0;
    uint32_t last = 0;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        Counters counters = method->draw(*target);
        uint64_t changes = counters.operation_count + counters.event_count;
        if (changes == 0) continue;
        last = frame;
        bool is_after = frame > 0 && (frame - 1) * step_s >= 1;
        (is_after ? switches : first_second) += changes;
        if (is_after && stands_still(cameras[frame - 1], cameras[frame])) while_still += changes;
    }
    Finding finding;
    finding.figures["switches_after_first_second"] = double(switches);
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "{} {} in the first second and {} after it, {} of these while the camera stood still; the last one in "
        "frame {}.",
        stage.world.is_planted() ? "tiles that were shown by another image at once"
        : stage.world.is_chain() ? "changes of level"
                                 : "splits and collapses",
        first_second, switches, while_still, last);
    Result<Shot> shot = shot_of(stage, spec, cameras[last], last);
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

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

}  // namespace

Result<std::vector<Finding>> run_jitter(Stage& stage, const Case&, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        if (!is_cut(stage, spec)) {
            Result<Finding> finding = is_image(spec) && !stage.world.is_mesh()
                                          ? key_switches(stage, spec, cameras, flight.step_s)
                                          : operations_at_rest(stage, spec, cameras, flight.step_s);
            if (!finding) return tl::unexpected(finding.error());
            findings.push_back(std::move(*finding));
            continue;
        }
        Switching all = switching_of(stage, spec, cameras, flight.step_s);
        Finding finding;
        finding.figures["switches_after_first_second"] = double(all.switches);
        finding.frames = uint32_t(cameras.size());
        finding.sentence = fmt::format(
            "{} vertices came or went, {} of them while the camera stood still; {} moved the surface at once by more "
            "than {} px, the worst by {:.3f} px.",
            all.came_or_went, all.while_still, all.switches, kSeen_px, all.greatest_px);
        Result<Shot> shot = shot_of(stage, spec, cameras[all.greatest_frame], all.greatest_frame);
        if (!shot) return tl::unexpected(shot.error());
        finding.worst = std::move(*shot);
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_slopes(Stage& stage, const Case&, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    Stage few = stage;
    few.frames = stage.frames == 0 ? kMostSlopes : std::min(stage.frames, kMostSlopes);
    std::vector<view::Camera> cameras = cameras_of(few, flight, Pick::spread);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        if (stage.world.is_planted()) {
            Result<Finding> shear = planted_shear(stage, spec, flight);
            if (!shear) return tl::unexpected(shear.error());
            findings.push_back(std::move(*shear));
            continue;
        }
        if (is_image(spec)) {
            Result<Finding> shear = shear_of(stage, spec, flight);
            if (!shear) return tl::unexpected(shear.error());
            findings.push_back(std::move(*shear));
            continue;
        }
        Finding finding;
        HonestyTally tally;
        uint32_t worst_frame = 0;
        double worst_px = -1;
        std::unique_ptr<Method> method = stage.make(spec, stage.world);
        for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
            method->decide(cameras[frame], frame);
            std::optional<Promises> promises = method->promises();
            if (!promises) return impossible("{}: promises nothing of what it draws", label_of(spec));
            double most_px = tally.add(promises->predicted_px, promises->measured_px).measured_max_px;
            if (most_px > worst_px) worst_frame = frame;
            worst_px = std::max(worst_px, most_px);
        }
        const Honesty& honesty = tally.all();
        finding.figures["honesty"] = honesty.ratio_max;
        finding.frames = uint32_t(cameras.size());
        finding.sentence = fmt::format(
            "Of {} triangles seen {} do worse than they promise; the worst is {:.3f} px off, {:.3f} px promised at most.",
            honesty.count, honesty.above_prediction, honesty.measured_max_px, honesty.predicted_max_px);
        Result<Shot> shot = shot_of(stage, spec, cameras[worst_frame], worst_frame);
        if (!shot) return tl::unexpected(shot.error());
        finding.worst = std::move(*shot);
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_halved_budget(Stage& stage, const Case& each, const scene::Flight& flight,
                                               std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    size_t middle = cameras.size() / 2;
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        if (!is_cut(stage, spec)) {
            Result<Finding> finding = halved_budget_by_method(stage, spec, cameras, each.settings.budget_share);
            if (!finding) return tl::unexpected(finding.error());
            findings.push_back(std::move(*finding));
            continue;
        }
        terrain::Cut cut;
        stage.world.refiner->cut_by_pixels(cameras[0], setting(spec, "error-px"), cut, morph_of(spec));
        view::ErrorBudget budget{kFirstBudget * double(cut.triangle_count()), setting(spec, "error-px"), false};
        view::ErrorController controller(budget);
        std::vector<double> costs, free;
        for (size_t frame = 0; frame < cameras.size(); ++frame) {
            stage.world.refiner->cut_by_pixels(cameras[frame], budget.least_error_px, cut, morph_of(spec));
            free.push_back(double(cut.triangle_count()));
            if (frame == middle) {
                budget.cost *= each.settings.budget_share;
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
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace overlook::measure
