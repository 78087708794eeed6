#include "runtime/wang_ldi/plants.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

// Whether some of a box may be in the picture: one behind one of its sides is not.
bool may_be_seen(const std::array<glm::dvec3, 4>& sides, const glm::dvec3& low, const glm::dvec3& high) {
    return std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) {
        return std::max(side.x * low.x, side.x * high.x) + std::max(side.y * low.y, side.y * high.y) +
                   std::max(side.z * low.z, side.z * high.z) >=
               0;
    });
}

}  // namespace

void add_plants(const PlantedField& planted, int64_t i, int64_t j, float share, std::vector<PlantPlaces>& by_model) {
    glm::dvec2 corner_m = planted.placement().rect_of(i, j).low_m;
    for (const Planted& object : planted.planting().tiles[planted.tiling().at(i, j)]) {
        glm::dvec2 at_m = corner_m + glm::dvec2(object.x_m, object.y_m);
        double height_m = planted.ground().height_m(at_m);
        if (std::isnan(height_m)) continue;
        by_model[object.model].placements.push_back(
            {{at_m, height_m}, std::cos(double(object.turn_rad)), std::sin(double(object.turn_rad)), double(object.scale)});
        by_model[object.model].shares.push_back(share);
    }
}

std::vector<PlantPlaces> plants_in_sight(const PlantedField& planted, const view::Camera& camera, double radius_m) {
    std::vector<PlantPlaces> by_model(planted.planting().models.size());
    const Placement& placement = planted.placement();
    const ImageSet& images = planted.images().set();
    std::array<glm::dvec3, 4> sides = view::sides_of(camera);
    glm::dvec2 eye(camera.position_m);
    glm::dvec2 low = glm::floor(glm::max(planted.ground().extent().low_m, eye - radius_m) / images.tile_m);
    glm::dvec2 high = glm::floor(glm::min(planted.ground().extent().high_m, eye + radius_m) / images.tile_m);
    for (auto j = int64_t(low.y); double(j) <= high.y; ++j)
        for (auto i = int64_t(low.x); double(i) <= high.x; ++i) {
            Rect rect = placement.rect_of(i, j);
            if (glm::distance(glm::clamp(eye, rect.low_m, rect.high_m), eye) > radius_m) continue;
            GroundRange bound = planted.ground().bound(rect);
            if (bound.is_empty()) continue;
            // Plants whose middles are on the tile stand out of it by less than another tile.
            glm::dvec3 from(rect.low_m - images.tile_m, bound.low_m + images.low_m);
            glm::dvec3 to(rect.high_m + images.tile_m, bound.high_m + images.high_m);
            if (!may_be_seen(sides, from - camera.position_m, to - camera.position_m)) continue;
            if (placement.is_planted(i, j)) add_plants(planted, i, j, 1, by_model);
        }
    return by_model;
}

}  // namespace overlook::wang_ldi
