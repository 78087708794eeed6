#include "runtime/wang_ldi/own_objects.h"

#include <limits>

namespace overlook::wang_ldi {

ObjectMap::ObjectMap(const PlantedTiles& ground, size_t tile, uint32_t side_px)
    : tile_m_(ground.planting.tile_size_m), objects_(ground.planting.tiles[tile]), of_pixel_(size_t(side_px) * side_px, 0) {
    std::vector<Planted> reaching_in = overhang(ground.set, ground.planting, tile);
    objects_.insert(objects_.end(), reaching_in.begin(), reaching_in.end());
    double pixel_m = tile_m_ / side_px;
    for (uint32_t row = 0; row < side_px; ++row)
        for (uint32_t column = 0; column < side_px; ++column) {
            glm::dvec2 at((column + 0.5) * pixel_m, (row + 0.5) * pixel_m);
            double least = std::numeric_limits<double>::infinity();
            for (size_t i = 0; i < objects_.size(); ++i) {
                const Planted& object = objects_[i];
                double radius_m = double(ground.planting.models[object.model].tight_radius_m) * double(object.scale);
                double beyond = glm::distance(at, glm::dvec2(object.x_m, object.y_m)) - radius_m;
                if (beyond < least) least = beyond, of_pixel_[size_t(row) * side_px + column] = uint32_t(i);
            }
        }
}

Ldi ObjectMap::only_of_square(const Ldi& ldi, const glm::dvec2& low_m) const {
    std::vector<uint8_t> is_kept;
    for (const Planted& object : objects_) {
        glm::dvec2 from_low = glm::dvec2(object.x_m, object.y_m) - low_m;
        is_kept.push_back(from_low.x >= 0 && from_low.y >= 0 && from_low.x < tile_m_ && from_low.y < tile_m_);
    }
    Ldi kept;
    kept.side_px = ldi.side_px, kept.unseen_share = ldi.unseen_share;
    kept.first.push_back(0);
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        bool is_in = !is_kept.empty() && is_kept[of_pixel_[p]] != 0;
        for (uint32_t s = ldi.first[p]; is_in && s < ldi.first[p + 1]; ++s) {
            kept.heights.push_back(ldi.heights[s]), kept.colours.push_back(ldi.colours[s]);
            if (!ldi.normals.empty()) kept.normals.push_back(ldi.normals[s]);
            if (!ldi.splats.empty()) kept.splats.push_back(ldi.splats[s]);
        }
        kept.first.push_back(kept.sample_count());
    }
    if (kept.sample_count() > 0) kept.palette = ldi.palette;
    return kept;
}

}  // namespace overlook::wang_ldi
