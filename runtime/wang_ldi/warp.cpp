#include "runtime/wang_ldi/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {
namespace {

template <Hiding hiding>
void warp_all(const view::Camera& camera, const ImageSet& set, std::span<const Drawn> back_to_front, Warped& picture) {
    Eye eye(camera);
    WarpCounts counts;
    using Painting = Brush<PictureTarget<hiding>>;
    Painting brush(eye, PictureTarget<hiding>(picture), counts);
    for (const Drawn& drawn : back_to_front) {
        ImageColumns<Painting> columns(eye, set, *drawn.ldi, drawn.level, {drawn.splat_scale}, glm::dvec2(drawn.origin_m), brush);
        columns.stand_on({drawn.origin_m.z, drawn.slope});
        Columns* all[] = {&columns};
        glm::dvec2 eye_share = glm::dvec2(eye.position_m - drawn.origin_m) / set.tile_m;
        paint_piece({0, columns.side_px, eye_share}, {}, all);
    }
}

}  // namespace

void Warped::clear(uint32_t width, uint32_t height) {
    width_px = width, height_px = height;
    colours.assign(size_t(width) * height, 0);
    depth_m.assign(size_t(width) * height, std::numeric_limits<float>::infinity());
}

ImageRgb8 picture_of(const Warped& warped) {
    ImageRgb8 image{warped.width_px, warped.height_px, {}};
    for (uint32_t colour : warped.colours)
        for (int shift : {0, 8, 16}) image.pixels.push_back(colour == 0 ? 128 : uint8_t(colour >> shift & 0xff));
    return image;
}

void warp(const view::Camera& camera, const ImageSet& set, std::span<const Drawn> back_to_front, Hiding hiding, Warped& picture) {
    if (hiding == Hiding::by_order)
        warp_all<Hiding::by_order>(camera, set, back_to_front, picture);
    else
        warp_all<Hiding::by_depth>(camera, set, back_to_front, picture);
}

void order_of_tiles(const glm::dvec3& eye_m, double tile_m, std::span<Drawn> tiles) {
    // How many tiles off the eye's own row or column; equal ones on both sides of the eye hide nothing of each other.
    auto off = [&](double origin, double eye) { return std::abs(std::floor((eye - origin) / tile_m)); };
    std::stable_sort(tiles.begin(), tiles.end(), [&](const Drawn& a, const Drawn& b) {
        auto key = [&](const Drawn& drawn) { return std::pair(off(drawn.origin_m.y, eye_m.y), off(drawn.origin_m.x, eye_m.x)); };
        return key(a) > key(b);
    });
}

}  // namespace overlook::wang_ldi
