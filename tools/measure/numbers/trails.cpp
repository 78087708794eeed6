#include "tools/measure/numbers/trails.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace overlook::measure {
namespace {

// The colours of a window of the truth, and whether something moving is in it.
struct Window {
    std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};
    bool has_moving = false;
};

Window window_of(const Frame& truth, std::span<const uint8_t> is_moving, uint32_t x, uint32_t y, uint32_t margin_px) {
    Window window;
    uint32_t left = x - std::min(x, margin_px), right = std::min(x + margin_px, truth.width - 1);
    uint32_t top = y - std::min(y, margin_px), bottom = std::min(y + margin_px, truth.height - 1);
    for (uint32_t row = top; row <= bottom; ++row) {
        for (uint32_t column = left; column <= right; ++column) {
            size_t i = size_t(row) * truth.width + column;
            window.has_moving |= truth.ids[i] < is_moving.size() && is_moving[truth.ids[i]] != 0;
            for (size_t c = 0; c < 3; ++c) {
                int value = truth.rgb[3 * i + c];
                window.low[c] = std::min(window.low[c], value), window.high[c] = std::max(window.high[c], value);
            }
        }
    }
    return window;
}

}  // namespace

TrailErrors trail_errors(const ImageRgb8& test, const Frame& truth, std::span<const std::vector<uint32_t>> ids_before,
                         std::span<const uint8_t> is_moving, uint32_t margin_px) {
    size_t count = size_t(truth.width) * truth.height;
    assert(test.pixels.size() == 3 * count && truth.ids.size() == count);
    auto was_moving = [&](size_t i) {
        return std::any_of(ids_before.begin(), ids_before.end(),
                           [&](const auto& ids) { return ids[i] < is_moving.size() && is_moving[ids[i]] != 0; });
    };
    TrailErrors errors;
    errors.is_ghost.resize(count);
    for (size_t i = 0; i < count; ++i) {
        if (!was_moving(i)) continue;
        Window window = window_of(truth, is_moving, uint32_t(i % truth.width), uint32_t(i / truth.width), margin_px);
        if (window.has_moving) continue;
        ++errors.trail_px;
        for (size_t c = 0; c < 3; ++c) {
            int value = test.pixels[3 * i + c];
            if (value < window.low[c] - kGhostGrey || value > window.high[c] + kGhostGrey) errors.is_ghost[i] = 1;
        }
        errors.ghost_px += errors.is_ghost[i];
    }
    return errors;
}

}  // namespace overlook::measure
