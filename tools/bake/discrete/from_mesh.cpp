#include "tools/bake/discrete/from_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/parallel.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/discrete/billboards.h"
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

// A level that might be: of the family, or of billboards.
struct Tried {
    TriedLevel about;
    Shape shape;
    std::optional<PackedPicture> picture;
};

// Triangles of the coarsest member within a distance.
size_t triangles_within(const std::vector<Family::Member>& members, double distance_m) {
    size_t count = members[0].shape.faces.size();
    for (const Family::Member& member : members)
        if (member.error_m <= distance_m) count = member.shape.faces.size();
    return count;
}

constexpr double kBillboardStep = 1.2599210498948732, kFinestBillboards = 1.0 / 400, kCoarsestBillboards = 0.25;

// Levels of billboards that have fewer triangles than a member within as much.
Result<std::vector<Billboards>> billboards_of(const Family& family, const std::vector<Family::Member>& members,
                                              const MeshChainOptions& options, const std::function<void(double)>& progress) {
    std::vector<Billboards> made;
    auto maker = BillboardMaker::make(family);
    if (!maker) return tl::unexpected(maker.error());
    size_t fewest = members[0].shape.faces.size();
    auto consider = [&](const BillboardPlan& plan, size_t most_triangles) {
        auto count = double(plan.triangle_count());
        if (count * options.ladder.least_saving > double(std::min(most_triangles, fewest))) return;
        if (auto one = maker->build(plan)) {
            fewest = std::min(fewest, one->shape.faces.size());
            made.push_back(std::move(*one));
        }
    };
    bool has_clouds = options.impostors != Impostors::cross, has_crosses = options.impostors != Impostors::cloud;
    for (double share = kFinestBillboards; has_clouds && share <= kCoarsestBillboards; share *= kBillboardStep) {
        double distance_m = share * family.size_m();
        consider(maker->cloud(distance_m), triangles_within(members, distance_m));
        progress(0.9 * std::log(share / kFinestBillboards) / std::log(kCoarsestBillboards / kFinestBillboards));
    }
    for (int upright = 3; has_crosses && upright >= 2; --upright)
        for (bool has_level : {true, false}) consider(maker->cross(upright, has_level), members[0].shape.faces.size());
    return made;
}

std::vector<Tried> merged(std::vector<Family::Member> members, std::vector<Billboards> billboards) {
    std::vector<Tried> all;
    double area_m2 = members[0].shape.area_m2();
    for (Family::Member& member : members) {
        Tried& one = all.emplace_back();
        one.about = {"mesh", {member.shape.faces.size(), member.error_m}, area_m2 > 0 ? member.lost_m2 / area_m2 : 0, 0, {}};
        one.shape = std::move(member.shape);
    }
    for (Billboards& made : billboards) {
        Tried& one = all.emplace_back();
        one.about = {made.kind, {made.shape.faces.size(), made.error_m}, made.seen.lost, made.seen.added, {}};
        one.shape = std::move(made.shape), one.picture = std::move(made.picture);
    }
    std::stable_sort(all.begin() + 1, all.end(), [](const Tried& a, const Tried& b) {
        const Candidate &of_a = a.about.candidate, &of_b = b.about.candidate;
        return of_a.error_m != of_b.error_m ? of_a.error_m < of_b.error_m : of_a.triangle_count > of_b.triangle_count;
    });
    return all;
}

// Which of all levels tried stay. Those that are cut give way to billboards of fewer triangles that are as near, lost and added
// area counted as displacements by whoever chooses among them (s A / (4 pi r): runtime/discrete/select.h).
void judge(std::vector<Tried>& all, double radius_m, const LadderOptions& options) {
    double outline_m = 4 * std::numbers::pi * radius_m, area_m2 = all[0].shape.area_m2();
    auto strain_m = [&](const Tried& tried) {
        double share = std::max(tried.about.lost_area_share, tried.about.added_area_share);
        return std::max(tried.about.candidate.error_m, share * area_m2 / outline_m);
    };
    std::vector<size_t> staying;
    std::vector<Candidate> candidates;
    for (size_t i = 0; i < all.size(); ++i) {
        auto is_better = [&](const Tried& other) {
            return other.picture && strain_m(other) <= strain_m(all[i]) &&
                   other.about.candidate.triangle_count <= all[i].about.candidate.triangle_count;
        };
        if (i > 0 && !all[i].picture && std::any_of(all.begin(), all.end(), is_better)) {
            all[i].about.verdict.why = "billboards of fewer triangles are as near, what is lost of the area counted";
            continue;
        }
        staying.push_back(i), candidates.push_back(all[i].about.candidate);
    }
    std::vector<Verdict> verdicts = choose_rungs(candidates, radius_m, options);
    for (size_t k = 0; k < staying.size(); ++k) all[staying[k]].about.verdict = verdicts[k];
}

// Makes a level's picture the last of the chain's surfaces.
Result<void> add_picture(Chain& chain, Tried& tried, size_t level) {
    const PictureRgba8& picture = tried.picture->picture;
    auto png = png_bytes(picture.width, picture.height, 4, picture.pixels);
    if (!png) return tl::unexpected(png.error());
    caveclod::Surface surface;
    surface.name = fmt::format("billboards of level {}", level), surface.texture = fmt::format("billboards-{}.png", level);
    surface.texture_bytes = std::move(*png), surface.is_alpha_masked = surface.is_two_sided = true;
    std::replace(tried.shape.face_surface.begin(), tried.shape.face_surface.end(), kPictureSurface,
                 uint32_t(chain.surfaces.size()));
    chain.surfaces.push_back(std::move(surface));
    ++chain.picture_count;
    chain.attributes.uvs = chain.attributes.colours = true;
    return {};
}

// From above, as it is stored.
double billboards_error_m(const Chain& chain, const Level& level, const std::vector<Mask>& masks) {
    constexpr double kGap = 0.02, kFloorShare = 1e-5;
    constexpr uint64_t kMostSteps = 1 << 18;
    double most_m = 0;
    for (uint32_t part = 0; part < chain.parts.size(); ++part) {
        std::vector<caveclod::Triangle> finest = triangles_of(chain, chain.levels[0], part);
        DrawnSets drawn = drawn_sets(chain, level, part, masks);
        if (finest.empty() && drawn.most.empty()) continue;
        most_m = std::max(most_m, most_distance_to_drawn(finest, drawn, kGap, kFloorShare * chain.radius_m, kMostSteps));
    }
    return most_m;
}

// What levels promise: those of billboards measured anew, as they are stored.
Result<void> state(Chain& chain, const std::vector<Tried>& kept, const std::vector<Mask>& masks, double rounding_m) {
    float error_m = 0, lost = 0;
    std::optional<Looks> looks;
    std::array<double, kSeenFrom> finest_m2{};
    double area_m2 = 0;
    for (size_t k = 1; k < kept.size(); ++k) {
        Level& level = chain.levels[k];
        double own_m = kept[k].about.candidate.error_m + 2 * rounding_m, own_lost = kept[k].about.lost_area_share;
        if (kept[k].picture) {
            if (!looks) {
                auto made = Looks::make(chain.surfaces);
                if (!made) return tl::unexpected(made.error());
                looks = std::move(*made), area_m2 = shape_of_level(chain, chain.levels[0]).area_m2();
                finest_m2 = seen_areas_m2(chain, chain.levels[0], *looks);
            }
            SeenChange seen = seen_change(finest_m2, seen_areas_m2(chain, level, *looks), area_m2);
            level.rung = Rung::billboards, level.added_area_share = rounded_up(seen.added);
            own_m = billboards_error_m(chain, level, masks), own_lost = seen.lost;
        }
        level.error_m = error_m = std::max(error_m, rounded_up(own_m));
        level.lost_area_share = lost = std::max(lost, std::min(1.0f, rounded_up(own_lost)));
    }
    return {};
}

void mark_plain(Chain& chain, double radius_m, const MeshChainOptions& options) {
    for (size_t k = 1; k < chain.levels.size(); ++k) {
        Level& level = chain.levels[k];
        double from_m = options.ladder.view.distance_m(double(level.error_m));
        bool has_masks = std::any_of(level.draws.begin(), level.draws.end(),
                                     [&](const Draw& draw) { return chain.surfaces[draw.surface].is_alpha_masked; });
        level.is_plain =
            level.rung == Rung::mesh && !has_masks && 2 * radius_m * options.ladder.view.focal_px() < options.plain_px * from_m;
    }
}

// Lays what is kept on the chain's grid, with what each level promises.
Result<void> lay(Chain& chain, std::vector<Tried>& kept, double& rounding_m) {
    std::vector<Mask> masks;
    std::vector<Shape> shapes;
    for (size_t k = 0; k < kept.size(); ++k) {
        if (kept[k].picture) {
            masks.push_back(kept[k].picture->mask);
            if (auto added = add_picture(chain, kept[k], k); !added) return added;
        }
        shapes.push_back(std::move(kept[k].shape));
    }
    Grid grid = grid_of(shapes);
    chain.origin_m = grid.origin_m, chain.position_step_m = grid.position_step_m;
    chain.uv_low = grid.uv_low, chain.uv_step = grid.uv_step;
    for (const Shape& shape : shapes) chain.levels.push_back(level_of(shape, grid, rounding_m));
    fit_sphere(chain);
    return state(chain, kept, masks, rounding_m);
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
    constexpr double kBaked = 0.6, kTried = 0.75;
    auto family = Family::make(file, options, [&](double share) { progress(kBaked * share); });
    if (!family) return tl::unexpected(family.error());
    std::vector<Family::Member> members =
        candidates_of(*family, options.ladder, [&](double share) { progress(kBaked + (kTried - kBaked) * share); });
    // What is thin is stated at several times what it takes: a measurement would undo that.
    if (!options.bake.simplify.keeps_thin) tighten(members, uint32_t(file.motion.parts.size() + 1));
    std::vector<Billboards> billboards;
    if (options.impostors != Impostors::none) {
        auto made = billboards_of(*family, members, options, [&](double share) { progress(kTried + (1 - kTried) * share); });
        if (!made) return tl::unexpected(made.error());
        billboards = std::move(*made);
    }
    double radius_m = radius_of(members[0].shape);
    std::vector<Tried> all = merged(std::move(members), std::move(billboards)), kept;

    judge(all, radius_m, options.ladder);
    report.source_triangle_count = file.mesh.faces.size(), report.part_count = file.motion.parts.size() + 1;
    report.card_count = family->card_count(), report.card_triangle_count = family->card_triangle_count();
    for (Tried& tried : all) {
        report.tried.push_back(tried.about);
        if (tried.about.verdict.is_kept) kept.push_back(std::move(tried));
    }

    Chain chain;
    chain.attributes = family->attributes(), chain.surfaces = family->surfaces();
    chain.parts = parts_of(file.motion), chain.clip_s = file.motion.clip_s;
    if (auto laid = lay(chain, kept, report.rounding_m); !laid) return tl::unexpected(laid.error());
    mark_plain(chain, radius_m, options);
    chain.finest_error_m = family->finest_error_m() + report.rounding_m;
    progress(1);
    return chain;
}

}  // namespace overlook::discrete
