#include "runtime/wang_ldi/tile_error.h"

#include <algorithm>
#include <cmath>

#include "runtime/view/box_error.h"

namespace overlook::wang_ldi {
namespace {

// Metres of distance for a metre of error that is to be so many pixels at most: depth is no less than the distance times the
// cosine of the picture's corner, and less by the error itself.
double distance_per_m(const view::Camera& camera, double error_px, double fade_share) {
    double secant = view::corner_secant(camera);
    return (view::focal_px(camera) * secant * secant / error_px + secant) / (1 - fade_share);
}

// Of textures and colours, wherever they are shown: their texels grow with their distance.
double far_error_px(const Field& field, const view::Camera& camera) {
    const FieldOptions& options = field.options();
    double half_texel_m = std::sqrt(0.5) * field.parts().images->tile_m / options.texture_side_px;
    double rim_m = std::sqrt(0.5) * field.parts().images->tile_m;  // of a tile, whose middle is so far away
    double from_m = options.ladder.texel_from_m * (1 - options.ladder.fade_share) - rim_m, secant = view::corner_secant(camera);
    if (!(from_m > half_texel_m * secant)) return INFINITY;
    return view::focal_px(camera) * half_texel_m * secant / (from_m / secant - half_texel_m);
}

}  // namespace

double sample_error_m(const ImageSet& images, uint32_t level, double slope) {
    const Level& of = images.levels[level];
    double aside_m = std::sqrt(0.5) * images.tile_m / of.side_px;
    return std::hypot(aside_m, slope * aside_m + double(of.height_step_m) / 2);
}

double steepest(std::span<const Half> halves) {
    double slope = 0;
    for (const Half& half : halves) slope = std::max(slope, glm::length(half.plane.slope));
    return slope;
}

double planting_error_px(const Field& field, const FieldList& list, const view::Camera& camera) {
    const ImageSet& images = *field.parts().images;
    view::BoxErrorBound bound(camera);
    bool has_far = false, has_blocks = false;
    double error_px = 0;
    for (const Item& item : list.items) {
        has_blocks |= item.tiles_log2 > 0, has_far |= item.texels_px > 0;
        double error_m = 0, slope = steepest(list.halves_of(item));
        for (const Shown& shown : list.shown_of(item)) {
            const Rung& rung = field.ladder().rungs[shown.rung];
            if (rung.stage == Stage::ldi)
                error_m = std::max(error_m, sample_error_m(images, rung.level, slope) + item.displacement_m);
        }
        if (error_m == 0) continue;
        Rect rect = field.parts().placement->rect_of(item.i, item.j);
        auto sight = bound.of(glm::dvec3(rect.low_m, item.low_m), glm::dvec3(rect.high_m, item.high_m));
        error_px = std::max(error_px, bound.pixels(sight, error_m));
    }
    if (has_far) error_px = std::max(error_px, far_error_px(field, camera) + (has_blocks ? kStrip_px : 0));
    return error_px;
}

double texels_from(const view::Camera& camera, double error_px, double fade_share) {
    double of_texels_px = error_px - std::min(kStrip_px, error_px / 2);
    return std::sqrt(0.5) * distance_per_m(camera, of_texels_px, fade_share);
}

double samples_from(const view::Camera& camera, double error_px, double fade_share) {
    return distance_per_m(camera, error_px, fade_share);
}

}  // namespace overlook::wang_ldi
