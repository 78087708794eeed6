#include "runtime/wang_ldi/plant_fill.h"

#include <cstring>

#include "formats/srgb.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kLinearSteps = 8192;
static_assert(12.92 * 255 / (kLinearSteps - 1) < 0.41, "of an 8-bit step, where the curve is steepest");

std::array<uint8_t, kLinearSteps> encoded_table() {
    std::array<uint8_t, kLinearSteps> table{};
    for (size_t i = 0; i < kLinearSteps; ++i)
        table[i] = uint8_t(std::lround(255 * srgb_from_linear(double(i) / (kLinearSteps - 1))));
    return table;
}

constexpr std::array<float, 64> door_table() {
    std::array<float, 64> table{};
    for (uint32_t i = 0; i < 64; ++i) {
        uint32_t x = (i ^ i >> 3) & 7, y = i >> 3, order = 0;
        for (uint32_t bit = 0; bit < 3; ++bit) order = order << 2 | (x >> bit & 1) << 1 | (y >> bit & 1);
        table[i] = (float(order) + 0.5f) / 64;
    }
    return table;
}
constexpr std::array<float, 64> kDoor = door_table();

// Pictures repeat.
inline uint32_t wrapped(int32_t at, uint32_t size) {
    if (uint32_t(at) < size) return uint32_t(at);
    int32_t rest = at % int32_t(size);
    return uint32_t(rest < 0 ? rest + int32_t(size) : rest);
}

inline Four linear_of(const std::array<uint16_t, 4>& texel) {
    using Shorts = uint16_t __attribute__((vector_size(8)));
    using Ints = int32_t __attribute__((vector_size(16)));
    Shorts shorts;
    std::memcpy(&shorts, texel.data(), sizeof shorts);
    return __builtin_convertvector(__builtin_convertvector(shorts, Ints), Four);
}

}  // namespace

bool PlantFill::lets_through(int x, int y) const {
    auto from_below = uint32_t(int(canvas_->height_px()) - 1 - y);
    float at = kDoor[(from_below & 7) << 3 | (uint32_t(x) & 7)];
    return at >= door_.from && at < door_.to;
}

// The one whose texels are as wide as pixels, along the axis of the picture along which they are densest.
const Skin::Level& PlantFill::skin_level(const Skin& skin, const Filled& triangle) {
    const auto& [a, b, c] = triangle.corners;
    if (skin.levels.size() == 1) return skin.levels.front();
    auto wide = float(skin.levels.front().width), high = float(skin.levels.front().height);
    float u1 = (b.u - a.u) * wide, v1 = (b.v - a.v) * high, u2 = (c.u - a.u) * wide, v2 = (c.v - a.v) * high;
    auto x1 = float(b.x - a.x), y1 = float(b.y - a.y), x2 = float(c.x - a.x), y2 = float(c.y - a.y);
    float u_right = u1 * y2 - u2 * y1, v_right = v1 * y2 - v2 * y1, u_down = u2 * x1 - u1 * x2, v_down = v2 * x1 - v1 * x2;
    float most = std::max(u_right * u_right + v_right * v_right, u_down * u_down + v_down * v_down);
    float per_pixel = kCornerSteps / float(triangle.area);
    float squared = most * per_pixel * per_pixel;
    if (!(squared > 0.5f)) return skin.levels.front();
    auto level = std::min<size_t>(size_t(std::max(0, std::ilogb(std::min(2 * squared, 1e12f)) / 2)), skin.levels.size() - 1);
    return skin.levels[level];
}

Four PlantFill::texel(const Skin::Level& level, float u, float v) {
    constexpr float kWhole = 1.0f / 65535, kMost = 1e6f;
    if (level.texels.size() == 1) return kWhole * linear_of(level.texels.front());
    float x = held(u * float(level.width) - 0.5f, kMost), y = held(v * float(level.height) - 0.5f, kMost);
    float left = std::floor(x), top = std::floor(y), right_share = x - left, down_share = y - top;
    uint32_t x0 = wrapped(int32_t(left), level.width), x1 = wrapped(int32_t(left) + 1, level.width);
    uint32_t y0 = wrapped(int32_t(top), level.height), y1 = wrapped(int32_t(top) + 1, level.height);
    const auto* above = level.texels.data() + size_t(y0) * level.width;
    const auto* below = level.texels.data() + size_t(y1) * level.width;
    Four from = linear_of(above[x0]) + right_share * (linear_of(above[x1]) - linear_of(above[x0]));
    Four to = linear_of(below[x0]) + right_share * (linear_of(below[x1]) - linear_of(below[x0]));
    return kWhole * (from + down_share * (to - from));
}

uint32_t PlantFill::encoded(const Four& linear) {
    static const std::array<uint8_t, kLinearSteps> kEncoded = encoded_table();
    auto byte = [&](int lane) {
        float at = std::max(0.0f, held(linear[lane], 1)) * (kLinearSteps - 1) + 0.5f;
        return uint32_t(kEncoded[size_t(at)]);
    };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | 0xff000000u;
}

}  // namespace overlook::wang_ldi
