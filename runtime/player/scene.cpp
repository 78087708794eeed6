#include "runtime/player/scene.h"

#include <algorithm>
#include <cassert>

#include "runtime/gl/timer.h"
#include "runtime/player/flight.h"

namespace overlook::player {

Result<Scene> Scene::read(const std::string& path) {
    Result<terrain::Terrain> terrain = terrain::read(path);
    if (!terrain) return tl::unexpected(terrain.error());
    Scene scene;
    scene.terrain_ = std::make_unique<terrain::Terrain>(std::move(*terrain));
    scene.refiner_.emplace(*scene.terrain_);
    return scene;
}

Result<void> Scene::upload() {
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*terrain_);
    if (!drawing) return tl::unexpected(drawing.error());
    drawing_.emplace(std::move(*drawing));
    return {};
}

FrameRecord Scene::draw(const gl::Target& target, const view::Camera& camera, double error_px, double morph,
                        const terrain::DrawOptions& options) {
    assert(drawing_.has_value());
    FrameRecord record;
    gl::Timer refining;
    refiner_->cut_by_pixels(camera, error_px, cut_, morph);
    record.refine_ms = refining.elapsed_ms();

    gl::Timer drawing;
    drawing_->draw(target, cut_, camera, options);
    record.draw_ms = drawing.finished_ms();

    record.triangle_count = cut_.triangle_count();
    record.void_rim_triangle_count = cut_.void_rim_triangle_count;
    record.tested_count = cut_.tested_count;
    record.predicted_error_px = cut_.predicted_error_px;
    record.uploaded_bytes = drawing_->uploaded_bytes();
    return record;
}

std::vector<view::Camera> keys_of(const Plan& plan, const Scene& scene) {
    std::vector<view::Camera> keys = plan.keys;
    if (keys.empty()) {
        keys.push_back(
            overview(scene.terrain(), scene.refiner().lowest_m(), scene.refiner().highest_m(), plan.width_px, plan.height_px));
    }
    for (view::Camera& key : keys) key.near_m = near_m(scene.terrain());
    return keys;
}

double near_m(const terrain::Terrain& terrain) {
    double cell_m = std::min(terrain.frame.metres_per_column, terrain.frame.metres_per_row);
    return std::min(0.5, 0.25 * cell_m);
}

}  // namespace overlook::player
