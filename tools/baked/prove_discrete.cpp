#include "tools/baked/prove_discrete.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/discrete/from_levels.h"
#include "tools/bake/discrete/seen_area.h"

namespace overlook::discrete {
namespace {

constexpr double kRoundingShare = 1e-7;  // of the thing's size: what float positions and double arithmetic cannot tell apart
constexpr int kTimes = 64;
constexpr uint64_t kMostSteps =
    1 << 18;  // halvings for each level and way: a bound that is not proven anew by then is not broken

std::vector<caveclod::Triangle> triangles_of_source(const mesh::MeshFile& source) {
    std::vector<caveclod::Triangle> triangles;
    for (size_t f = 0; f < source.mesh.faces.size(); ++f) {
        caveclod::Triangle& t = triangles.emplace_back();
        for (size_t c = 0; c < 3; ++c) t[c] = source.mesh.origin_m + glm::dvec3(corner_m(source.mesh, f, c));
    }
    return triangles;
}

double area_of(const Chain& chain, const Level& level) {
    double area_m2 = 0;
    for (const caveclod::Triangle& t : triangles_of(chain, level))
        area_m2 += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    return area_m2;
}

double out_of_sphere_m(const Chain& chain) {
    double most_m = 0;
    for (uint32_t p = 1; p < chain.parts.size(); ++p)
        for (int time = 0; time < kTimes; ++time) {
            Pose pose = pose_at(chain.parts[p], chain.clip_s, chain.clip_s * time / kTimes);
            glm::dquat turn(pose.turn);
            for (const Level& level : chain.levels)
                for (const Vertex& v : level.vertices) {
                    if (v.part != p) continue;
                    glm::dvec3 at_m = turn * position_m(chain, v) + glm::dvec3(pose.move_m);
                    most_m = std::max(most_m, glm::distance(at_m, chain.middle_m) - chain.radius_m);
                }
        }
    return most_m;
}

caveclod::Distance distance_of_billboards(const Chain& chain, const Level& level, const std::vector<Mask>& masks,
                                          const LevelsChainOptions& options) {
    caveclod::Distance worst;
    for (uint32_t part = 0; part < chain.parts.size(); ++part) {
        std::vector<caveclod::Triangle> finest = triangles_of(chain, chain.levels[0], part);
        DrawnSets drawn = drawn_sets(chain, level, part, masks);
        if (finest.empty() && drawn.most.empty()) continue;
        caveclod::Distance distance{0, 2 * chain.radius_m};
        if (!finest.empty() && !drawn.least.empty())
            distance = distance_to_drawn(finest, drawn, options.gap, options.floor_share * chain.radius_m, options.most_steps,
                                         options.enough_m);
        worst = {std::max(worst.least_m, distance.least_m), std::max(worst.most_m, distance.most_m)};
    }
    return worst;
}

// Rays that just hit or miss may do the other where a triangle's corners come in another order.
bool is_more(double found, double stated) {
    return found > 1.02 * stated + 1e-4;
}

Result<void> prove_areas(const Chain& chain, ChainProof& proof) {
    auto looks = Looks::make(chain.surfaces);
    if (!looks) return tl::unexpected(looks.error());
    double area_m2 = area_of(chain, chain.levels[0]);
    auto finest_m2 = seen_areas_m2(chain, chain.levels[0], *looks);
    for (size_t k = 1; k < chain.levels.size(); ++k) {
        LevelProof& found = proof.levels[k];
        if (found.rung != Rung::billboards) continue;
        SeenChange seen = seen_change(finest_m2, seen_areas_m2(chain, chain.levels[k], *looks), area_m2);
        found.lost = seen.lost, found.added = seen.added;
        found.area_is_broken = is_more(found.lost, found.stated_lost) || is_more(found.added, found.stated_added);
    }
    return {};
}

}  // namespace

size_t ChainProof::proven_count() const {
    return size_t(std::count_if(levels.begin(), levels.end(), [](const LevelProof& level) { return level.is_proven; })) -
           (!levels.empty() && levels[0].is_proven ? 1 : 0);
}

bool ChainProof::holds() const {
    double slack_m = 1e-5 * (1 + finest_stated_m);
    return !finest_is_broken && moved_most_m <= slack_m &&
           std::none_of(levels.begin(), levels.end(),
                        [](const LevelProof& level) { return level.is_broken || level.area_is_broken; });
}

Result<ChainProof> prove(const Chain& chain, std::span<const mesh::MeshFile> sources,
                         const std::function<void(double)>& progress) {
    ChainProof proof;
    auto masks = masks_of(chain);
    if (!masks) return tl::unexpected(masks.error());
    proof.finest_stated_m = chain.finest_error_m;
    double rounding_m = kRoundingShare * (chain.radius_m + glm::length(chain.middle_m));
    LevelsChainOptions options;
    options.most_steps = kMostSteps;
    for (size_t k = 0; k < sources.size(); ++k) {
        caveclod::Distance off = caveclod::two_sided_distance(
            caveclod::TriangleTree(triangles_of_source(sources[k])), caveclod::TriangleTree(triangles_of(chain, chain.levels[k])),
            options.gap, std::max(0.05 * chain.finest_error_m, rounding_m), options.most_steps);
        proof.finest = {std::max(proof.finest.least_m, off.least_m), std::max(proof.finest.most_m, off.most_m)};
        progress(0.3 * double(k + 1) / double(sources.size()));
    }
    proof.finest_is_broken = proof.finest.least_m > chain.finest_error_m * (1 + 1e-6) + rounding_m;
    proof.moved_most_m = out_of_sphere_m(chain);

    proof.levels.resize(chain.levels.size());
    double finest_area_m2 = area_of(chain, chain.levels[0]);
    parallel_ranges(chain.levels.size(), 1, [&](size_t k, size_t) {
        const Level& level = chain.levels[k];
        LevelProof& found = proof.levels[k];
        found.rung = level.rung, found.triangle_count = level.triangle_count(), found.stated_m = double(level.error_m);
        LevelsChainOptions asked = options;
        asked.enough_m = found.stated_m * (1 + 1e-6) + rounding_m;
        if (level.rung == Rung::billboards)
            found.measured = distance_of_billboards(chain, level, *masks, asked);
        else if (k > 0)
            found.measured = distance_of_levels(chain, chain.levels[0], level, asked);
        found.is_broken = found.measured.least_m > asked.enough_m;
        found.is_proven = found.measured.most_m <= asked.enough_m;
        found.stated_lost = double(level.lost_area_share), found.stated_added = double(level.added_area_share);
        found.lost = finest_area_m2 > 0 ? std::max(0.0, 1 - area_of(chain, level) / finest_area_m2) : 0;
    });
    if (chain.picture_count > 0)
        if (auto areas = prove_areas(chain, proof); !areas) return tl::unexpected(areas.error());
    progress(1);
    return proof;
}

}  // namespace overlook::discrete
