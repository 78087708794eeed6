#include "tools/bake/discrete/from_mesh.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/discrete/family.h"

namespace overlook::discrete {
namespace {

double radius_of(const Shape& shape) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const ShapeVertex& v : shape.vertices) low = glm::min(low, v.at_m), high = glm::max(high, v.at_m);
    return glm::length(high - low) / 2;
}

constexpr double kLeastShare = 1e-5, kMostShare = 2;  // of the thing's size: distances that are tried
constexpr double kDistanceStep = 1.2599210498948732;  // three of them double it

// Members of the family, each with about a factor-th of the triangles of the one before, finest first; errors and losses ascend.
std::vector<Family::Member> candidates_of(const Family& family, const LadderOptions& options,
                                          const std::function<void(double)>& progress) {
    std::vector<Family::Member> members{family.member(0)};
    Family::Member last;  // the coarsest that is none of them
    for (double share = kLeastShare; share <= kMostShare; share *= kDistanceStep) {
        progress(std::log(share / kLeastShare) / std::log(kMostShare / kLeastShare));
        last = family.member(share * family.size_m());
        if (last.shape.faces.size() < options.least_triangles) break;
        last.error_m = std::max(last.error_m, members.back().error_m);
        last.lost_m2 = std::max(last.lost_m2, members.back().lost_m2);
        if (double(last.shape.faces.size()) * options.factor <= double(members.back().shape.faces.size()))
            members.push_back(last);
    }
    size_t count = last.shape.faces.size();
    if (count >= options.least_triangles && count < members.back().shape.faces.size()) members.push_back(std::move(last));
    return members;
}

// The hierarchies' bounds hold for every cut of them; of one that is at hand a measurement from above is often tighter.
void tighten(std::vector<Family::Member>& members, uint32_t part_count) {
    constexpr double kGap = 0.02, kFloorShare = 1e-5;
    constexpr uint64_t kMostSteps = 1 << 18;
    double floor_m = kFloorShare * radius_of(members[0].shape);
    parallel_ranges(members.size(), 1, [&](size_t k, size_t) {
        double most_m = 0;
        for (uint32_t part = 0; part < part_count && k > 0; ++part) {
            std::vector<caveclod::Triangle> finest = members[0].shape.triangles_of(part),
                                            own = members[k].shape.triangles_of(part);
            if (finest.empty() && own.empty()) continue;
            caveclod::TriangleTree to_finest(finest), to_own(own);
            most_m = std::max(most_m, caveclod::two_sided_distance(to_finest, to_own, kGap, floor_m, kMostSteps).most_m);
        }
        members[k].error_m = std::min(members[k].error_m, most_m);
    });
    for (size_t k = 1; k < members.size(); ++k) members[k].error_m = std::max(members[k].error_m, members[k - 1].error_m);
}

}  // namespace

std::vector<Part> parts_of(const mesh::Motion& motion) {
    std::vector<Part> parts{Part{}};
    for (const mesh::Motion::Part& from : motion.parts) {
        Part& part = parts.emplace_back();
        part.name = from.name, part.pivot_m = glm::vec3(from.pivot_m);
        for (const mesh::Motion::Key& key : from.keys) {
            part.at_s.push_back(float(key.at_s));
            part.poses.push_back({glm::normalize(glm::quat(key.turn)), glm::vec3(key.move_m)});
        }
    }
    return parts;
}

Result<Chain> chain_from_mesh(const mesh::MeshFile& file, const MeshChainOptions& options, MeshChainReport& report,
                              const std::function<void(double)>& progress) {
    constexpr double kBaked = 0.7, kTried = 0.9;
    auto family = Family::make(file, options, [&](double share) { progress(kBaked * share); });
    if (!family) return tl::unexpected(family.error());
    std::vector<Family::Member> members =
        candidates_of(*family, options.ladder, [&](double share) { progress(kBaked + (kTried - kBaked) * share); });
    tighten(members, uint32_t(file.motion.parts.size() + 1));

    std::vector<Candidate> candidates;
    for (const Family::Member& member : members) candidates.push_back({member.shape.faces.size(), member.error_m});
    std::vector<Verdict> verdicts = choose_rungs(candidates, radius_of(members[0].shape), options.ladder);
    report.source_triangle_count = file.mesh.faces.size(), report.part_count = file.motion.parts.size() + 1;
    report.card_count = family->card_count(), report.card_triangle_count = family->card_triangle_count();
    double area_m2 = members[0].shape.area_m2();
    std::vector<Shape> shapes;
    for (size_t i = 0; i < members.size(); ++i) {
        report.tried.push_back({candidates[i], area_m2 > 0 ? members[i].lost_m2 / area_m2 : 0, verdicts[i]});
        if (verdicts[i].is_kept) shapes.push_back(std::move(members[i].shape));
    }

    Chain chain;
    Grid grid = grid_of(shapes);
    chain.origin_m = grid.origin_m, chain.position_step_m = grid.position_step_m;
    chain.uv_low = grid.uv_low, chain.uv_step = grid.uv_step;
    chain.attributes = family->attributes(), chain.surfaces = family->surfaces();
    chain.parts = parts_of(file.motion), chain.clip_s = file.motion.clip_s;
    for (const Shape& shape : shapes) chain.levels.push_back(level_of(shape, grid, report.rounding_m));
    size_t k = 0;
    for (const TriedLevel& tried : report.tried) {
        if (!tried.verdict.is_kept) continue;
        Level& level = chain.levels[k++];
        if (k == 1) continue;
        level.error_m = rounded_up(tried.candidate.error_m + 2 * report.rounding_m);
        level.lost_area_share = std::min(1.0f, rounded_up(tried.lost_area_share));
    }
    chain.finest_error_m = family->finest_error_m() + report.rounding_m;
    fit_sphere(chain);
    progress(1);
    return chain;
}

}  // namespace overlook::discrete
