// A picture while it is painted by the fast warper: depth and colour of a pixel in one number, so that what is nearer is less,
// with a margin all round in which splats may end that are only partly in the picture.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "runtime/wang_ldi/brush.h"

namespace overlook::wang_ldi {

// Depth first, of what is equally deep the lower colour. Depths are not negative.
inline int64_t pixel_key(float depth_m, uint32_t colour) {
    return int64_t(uint64_t(std::bit_cast<uint32_t>(depth_m)) << 32 | colour);
}
inline float depth_of_key(int64_t key) {
    return std::bit_cast<float>(uint32_t(uint64_t(key) >> 32));
}
inline uint32_t colour_of_key(int64_t key) {
    return uint32_t(uint64_t(key));
}

class Canvas {
  public:
    static constexpr int64_t kNothing = std::numeric_limits<int64_t>::max();

    // Empties it where it has another size, and leaves it as it is else: whoever reads it out empties it.
    // most_splat_px: as Eye's.
    void fit(uint32_t width_px, uint32_t height_px, int most_splat_px = kMostSplat_px) {
        if (width_px == width_px_ && height_px == height_px_ && most_splat_px == margin_px_) return;
        width_px_ = width_px, height_px_ = height_px, margin_px_ = most_splat_px;
        keys_.assign(size_t(stride()) * (height_px + 2 * uint32_t(margin_px_)), kNothing);
    }
    uint32_t width_px() const { return width_px_; }
    uint32_t height_px() const { return height_px_; }
    int32_t stride() const { return int32_t(width_px_) + 2 * margin_px_; }
    // Of pixel (x, y) from -most_splat_px on: origin + y * stride + x.
    int32_t origin() const { return margin_px_ * stride() + margin_px_; }
    int64_t* keys() { return keys_.data(); }
    int64_t* row(uint32_t y) { return keys_.data() + origin() + ptrdiff_t(y) * stride(); }

  private:
    uint32_t width_px_ = 0, height_px_ = 0;
    int32_t margin_px_ = 0;
    std::vector<int64_t> keys_;
};

// For what is painted there sample by sample.
template <Hiding hiding>
class CanvasTarget {
  public:
    static constexpr bool kIsByDepth = hiding == Hiding::by_depth;
    explicit CanvasTarget(Canvas& canvas) : canvas_(&canvas) {}
    int width_px() const { return int(canvas_->width_px()); }
    int height_px() const { return int(canvas_->height_px()); }

    void put(int x, int y, float depth_m, uint32_t colour) {
        int64_t& pixel = canvas_->row(uint32_t(y))[x];
        int64_t key = pixel_key(depth_m, colour);
        pixel = hiding == Hiding::by_order || key < pixel ? key : pixel;
    }

  private:
    Canvas* canvas_;
};

}  // namespace overlook::wang_ldi
