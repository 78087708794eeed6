#include "runtime/wang_ldi/field_walk.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

// 0 inside.
double distance_to(const Rect& rect, const glm::dvec2& at_m) {
    return glm::length(at_m - glm::clamp(at_m, rect.low_m, rect.high_m));
}

int64_t tile_below(double at_tiles) {
    return int64_t(std::floor(at_tiles));
}

}  // namespace

FieldWalk::FieldWalk(const Field& field, const view::Camera& camera)
    : field_(field),
      images_(*field.parts_.images),
      placement_(*field.parts_.placement),
      sides_(view::sides_of(camera)),
      forward_(view::axes_of(camera).forward),
      eye_m_(camera.position_m),
      near_m_(camera.near_m) {}

void FieldWalk::run(FieldCounts& counts, const std::function<void(const Found&)>& take) {
    counts_ = &counts, take_ = &take;
    double tile_m = images_.tile_m;
    const Rect& extent = placement_.ground().extent();
    glm::dvec2 eye(eye_m_), low = glm::max(extent.low_m, eye - field_.reach_m_) / tile_m;
    glm::dvec2 high = glm::min(extent.high_m, eye + field_.reach_m_) / tile_m;
    if (!(low.x < high.x && low.y < high.y)) return;
    int64_t left = tile_below(low.x), right = tile_below(high.x), bottom = tile_below(low.y), top = tile_below(high.y);
    uint8_t log2 = 0;
    while ((int64_t(1) << log2) <= std::max(right - left, top - bottom)) ++log2;
    // So that there are two roots each way at most.
    glm::dvec2 cut = placement_.rect_of((right >> log2) << log2, (top >> log2) << log2).low_m;
    for (auto [x, y] : quarters_towards(eye, cut)) {
        int64_t i = (right >> log2) - 1 + x, j = (top >> log2) - 1 + y;
        if (i >= left >> log2 && j >= bottom >> log2) visit(i * (int64_t(1) << log2), j * (int64_t(1) << log2), log2);
    }
}

void FieldWalk::visit(int64_t i, int64_t j, uint8_t log2) {
    int64_t tiles = int64_t(1) << log2;
    Rect rect = placement_.rect_of(i, j, tiles);
    (log2 == 0 ? counts_->tiles_tested : counts_->blocks_tested)++;
    double ground_m = distance_to(rect, glm::dvec2(eye_m_));
    if (ground_m >= field_.reach_m_) return;
    GroundRange bound = placement_.ground().bound(rect);
    if (bound.is_empty() || !is_in_sight(rect, bound)) return;
    Placement::Coverage coverage = placement_.coverage(rect, bound);
    if (log2 == 0) return (*take_)({i, j, 0, coverage, 0});
    if (coverage == Placement::Coverage::none) return;
    double near_m = field_.distance_m({ground_m, 0}, eye_m_.z - bound.high_m);
    if (near_m >= field_.blocks_from_m_ && double(tiles) * images_.tile_m <= field_.options_.block_share * near_m)
        return (*take_)({i, j, log2, coverage, near_m});
    int64_t half = tiles / 2;
    for (auto [x, y] : quarters_towards(glm::dvec2(eye_m_), (rect.low_m + rect.high_m) / 2.0))
        visit(i + x * half, j + y * half, uint8_t(log2 - 1));
}

// Whether some of a rectangle with what is planted on it may be: a box behind one of the sides is not. Geometry reaches over
// its edges, images do not.
bool FieldWalk::is_in_sight(const Rect& rect, const GroundRange& ground) const {
    glm::dvec3 low = glm::dvec3(rect.low_m - field_.overhang_m_, ground.low_m + images_.low_m) - eye_m_;
    glm::dvec3 high = glm::dvec3(rect.high_m + field_.overhang_m_, ground.high_m + field_.highest_m_) - eye_m_;
    auto farthest = [&](const glm::dvec3& along) {
        return std::max(along.x * low.x, along.x * high.x) + std::max(along.y * low.y, along.y * high.y) +
               std::max(along.z * low.z, along.z * high.z);
    };
    for (const glm::dvec3& side : sides_)
        if (farthest(side) < 0) return false;
    return farthest(forward_) >= near_m_;
}

}  // namespace overlook::wang_ldi
