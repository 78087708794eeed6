#include "tools/measure/full_geometry.h"

#include "runtime/caveclod/static_levels.h"
#include "runtime/discrete/director.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

constexpr double kEverything_m = -1;  // below every error, 0 as well

class Full : public Method {
  public:
    explicit Full(World& world) : geometry_(world) {}

    void decide(const view::Camera& camera, uint32_t) override { camera_ = camera; }
    Counters draw(const gl::Target& target) override { return geometry_.draw(target, camera_); }

  private:
    FullGeometry geometry_;
    view::Camera camera_;
};

}  // namespace

FullGeometry::FullGeometry(World& world) : world_(&world) {
    if (world.is_chain()) {
        lists_.resize(world.chains.size());
        return;
    }
    if (world.is_planted()) {
        world.planted->land().refiner->cut_by_metres(kEverything_m, cut_);
        return;
    }
    if (!world.mesh) {
        cut_ = full_cut(world);
        return;
    }
    buffers_ = std::make_unique<caveclod::CameraBuffers>(*world.mesh->mesh);
    buffers_->take(caveclod::faces_within(*world.mesh->mesh, kEverything_m).by_surface);
}

Counters FullGeometry::draw_chains(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part) {
    Counters counters;
    std::vector<discrete::DrawList> lists;
    uint32_t first_instance = 0;
    for (const ChainWorld& one : world_->chains) {
        discrete::FrameList frame = discrete::finest_frame(one.facts, one.placements, camera);
        lists.push_back(discrete::draw_list(one.drawing->layout(), *one.chain, frame, one.placements, camera, world_->time_s,
                                            first_instance));
        first_instance += uint32_t(one.placements.size());
        counters.triangle_count += frame.triangle_count;
        counters.tested_count += frame.tested_count;
    }
    std::vector<discrete::Drawn> parts;
    for (size_t i = 0; i < lists.size(); ++i) {
        counters.uploaded_bytes += lists_[i].fill(lists[i]);
        parts.push_back({&*world_->chains[i].drawing, &lists_[i], &lists[i]});
    }
    discrete::DrawOptions look;
    look.part = part;
    counters.draw_call_count = discrete::draw(target, parts, look);
    counters.vertex_reference_count = 3 * counters.triangle_count;
    counters.resident_bytes = world_->resident_bytes;
    return counters;
}

Counters FullGeometry::draw_planted(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part) {
    wang_ldi::Land land = world_->planted->land();
    terrain::DrawOptions look = world_->look;
    look.part = part;
    view::Camera on_ground = camera;
    on_ground.position_m -= wang_ldi::origin_of(land, camera);
    Counters counters = draw_cut(*land.drawing, world_->resident_bytes, target, cut_, on_ground, look);
    auto plants = wang_ldi::plants_in_sight(world_->planted->planted(), camera, kPlantsUpTo_m);
    std::vector<wang_ldi::PlantList> lists =
        wang_ldi::plant_lists(land.plants->forms(), std::move(plants), camera, {kPlantError_px});
    wang_ldi::PlantCounts drawn = land.plants->draw(target, camera, lists, land.drawing->haze_per_m(look), part);
    target.resolve();
    counters.triangle_count += drawn.triangle_count;
    counters.vertex_reference_count += 3 * drawn.triangle_count;
    counters.draw_call_count += drawn.draw_call_count;
    counters.uploaded_bytes += drawn.uploaded_bytes;
    counters.predicted_error_px = kPlantError_px;
    return counters;
}

Counters FullGeometry::draw(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part) {
    if (world_->is_planted()) return draw_planted(target, camera, part);
    if (world_->is_chain()) return draw_chains(target, camera, part);
    if (!world_->mesh) {
        terrain::DrawOptions look = world_->look;
        look.part = part;
        return draw_cut(*world_->drawing, world_->resident_bytes, target, cut_, camera, look);
    }
    caveclod::DrawOptions look = world_->mesh->look;
    look.part = part;
    world_->mesh->drawing->draw(target, *buffers_, camera, look);
    Counters counters;
    counters.triangle_count = buffers_->triangle_count();
    counters.vertex_reference_count = 3 * counters.triangle_count;
    counters.draw_call_count = buffers_->draw_call_count() + 1;
    counters.resident_bytes = world_->resident_bytes + buffers_->uploaded_bytes();
    return counters;
}

std::unique_ptr<Method> make_full_method(World& world) {
    return std::make_unique<Full>(world);
}

}  // namespace overlook::measure
