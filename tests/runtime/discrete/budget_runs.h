// Crowds that a camera passes, chosen for within a budget frame by frame as the renderer does it.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "runtime/discrete/budget.h"
#include "runtime/discrete/director.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {

constexpr double kStep_s = 1.0 / 32;
constexpr Variant kAll[] = {Variant::fsi, Variant::fsi_paper, Variant::hard, Variant::blend, Variant::dither, Variant::late};

// side x side spheres on the ground before the eye.
inline std::vector<Placement> crowd(int side) {
    std::vector<Placement> placements;
    for (int i = 0; i < side * side; ++i) {
        Placement placed;
        placed.translation_m = {3.0 * (i % side - side / 2) + 0.1 * (i * 7 % 11), 6 + 3.0 * (i / side), 0.1 * (i * 5 % 7)};
        placed.scale = 0.5 + 0.1 * (i % 3);
        placements.push_back(placed);
    }
    return placements;
}

inline view::Camera camera_at(const glm::dvec3& at_m, double heading_deg = 0) {
    view::Camera camera;
    camera.position_m = at_m, camera.heading_deg = heading_deg, camera.pitch_deg = -8;
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.01;
    return camera;
}
// Past the crowd, sideways.
inline view::Camera passing(int frame) {
    return camera_at({-8 + 4 * kStep_s * frame, -4, 4});
}

// As FrameDrawer does it.
struct BudgetRun {
    BudgetRun(Variant variant, const std::vector<Placement>& placements, Chain chain = made::sphere_chain(64, 6))
        : BudgetRun(defaults_of(variant), placements, std::move(chain)) {}
    BudgetRun(const FrameOptions& options, const std::vector<Placement>& placements, Chain chain = made::sphere_chain(64, 6))
        : director(facts_of(chain), placements, options) {}

    void frame(const view::Camera& camera, double dt_s = kStep_s) {
        Demand demand = director.demand(camera, dt_s);
        times = keeper.times(std::span(&demand, 1));
        foretold = demand.triangles(times);
        director.coarsen(times);
        director.decide(camera, dt_s);
    }
    double settled() const { return double(director.frame().settled_triangle_count); }
    double drawn() const { return double(director.frame().triangle_count); }

    Director director;
    BudgetKeeper keeper;
    double times = 1, foretold = 0;
};

inline double free_triangles(Variant variant, const std::vector<Placement>& placements, const view::Camera& camera) {
    BudgetRun show(variant, placements);
    show.frame(camera);
    return show.settled();
}

}  // namespace overlook::discrete
