#include "runtime/view/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "formats/parallel.h"
#include "runtime/view/flip_colour.h"
#include "runtime/view/flip_filters.h"

namespace overlook::view {
namespace {

constexpr uint32_t kRowsAtOnce = 16;

struct Kernels {
    EyeKernels eye;
    FeatureKernels feature;

    explicit Kernels(double pixels_per_degree)
        : eye(eye_kernels(pixels_per_degree)), feature(feature_kernels(pixels_per_degree)) {}
};

// The pictures of a picture filtered along its rows, one per first half of a separated filter.
enum Half { kBrightness, kRedGreen, kYellowBlueNarrow, kYellowBlueWide, kSmooth, kEdge, kPoint, kHalves };

struct HalfFiltered {
    uint32_t width = 0, height = 0;
    std::array<std::vector<float>, kHalves> planes;  // [height, width] each

    const float* row(Half half, int64_t y) const {
        return planes[half].data() + size_t(std::clamp<int64_t>(y, 0, int64_t(height) - 1)) * width;
    }
    float* row(Half half, size_t y) { return planes[half].data() + y * width; }
};

// A row whose outer pixels go on as far as any kernel reaches.
struct WideRow {
    size_t width, reach;
    std::vector<float> values;

    WideRow(size_t width_px, size_t reach_px) : width(width_px), reach(reach_px), values(width_px + 2 * reach_px) {}
    float* begin() { return values.data() + reach; }
    void continue_outwards() {
        std::fill_n(values.begin(), reach, values[reach]);
        std::fill_n(values.end() - ptrdiff_t(reach), reach, values[reach + width - 1]);
    }
};

void filter_along(const Kernel& kernel, WideRow& row, float* out) {
    std::vector<const float*> taps;
    for (int k = -kernel.radius(); k <= kernel.radius(); ++k) taps.push_back(row.begin() + k);
    weighted_sum(kernel, taps.data(), row.width, out);
}

HalfFiltered filter_rows(const Rgb8View& picture, const Kernels& kernels) {
    HalfFiltered half;
    half.width = picture.width;
    half.height = picture.height;
    for (std::vector<float>& plane : half.planes) plane.resize(size_t(picture.width) * picture.height);
    const std::array<const Kernel*, kHalves> kernel_of = {
        &kernels.eye.brightness, &kernels.eye.red_green, &kernels.eye.yellow_blue_narrow, &kernels.eye.yellow_blue_wide,
        &kernels.feature.smooth, &kernels.feature.edge,  &kernels.feature.point};
    int reach = 0;
    for (const Kernel* kernel : kernel_of) reach = std::max(reach, kernel->radius());

    parallel_ranges(picture.height, kRowsAtOnce, [&](size_t begin, size_t end) {
        WideRow y(picture.width, size_t(reach)), red_green = y, yellow_blue = y;
        const std::array<WideRow*, kHalves> source_of = {&y, &red_green, &yellow_blue, &yellow_blue, &y, &y, &y};
        for (size_t row = begin; row < end; ++row) {
            opponent_from_srgb(picture.rgb.data() + row * picture.width * 3, picture.width,
                               {y.begin(), red_green.begin(), yellow_blue.begin()});
            for (WideRow* channel : {&y, &red_green, &yellow_blue}) channel->continue_outwards();
            for (int i = 0; i < kHalves; ++i) filter_along(*kernel_of[size_t(i)], *source_of[size_t(i)], half.row(Half(i), row));
        }
    });
    return half;
}

void filter_across(const Kernel& kernel, const HalfFiltered& picture, Half half, size_t y, float* out) {
    std::vector<const float*> taps;
    for (int k = -kernel.radius(); k <= kernel.radius(); ++k) taps.push_back(picture.row(half, int64_t(y) + k));
    weighted_sum(kernel, taps.data(), picture.width, out);
}

// One row of a picture as the eye sees it.
struct SeenRow {
    std::vector<float> l, a, b, edge, point, spare;

    explicit SeenRow(size_t width) : l(width), a(width), b(width), edge(width), point(width), spare(width) {}
};

void see_colours(const HalfFiltered& picture, const Kernels& kernels, size_t y, SeenRow& out) {
    filter_across(kernels.eye.brightness, picture, kBrightness, y, out.l.data());
    filter_across(kernels.eye.red_green, picture, kRedGreen, y, out.a.data());
    filter_across(kernels.eye.yellow_blue_narrow, picture, kYellowBlueNarrow, y, out.b.data());
    filter_across(kernels.eye.yellow_blue_wide, picture, kYellowBlueWide, y, out.spare.data());
    for (size_t i = 0; i < picture.width; ++i)
        out.b[i] = kernels.eye.narrow_share * out.b[i] + kernels.eye.wide_share * out.spare[i];
    hunt_from_opponent({out.l.data(), out.a.data(), out.b.data()}, picture.width, {out.l.data(), out.a.data(), out.b.data()});
}

// Strength of an edge or a point: its two directions' length.
void see_feature(const HalfFiltered& picture, const Kernels& kernels, const Kernel& detector, Half along, size_t y,
                 std::vector<float>& spare, std::vector<float>& out) {
    filter_across(kernels.feature.smooth, picture, along, y, out.data());
    filter_across(detector, picture, kSmooth, y, spare.data());
    for (size_t i = 0; i < picture.width; ++i) out[i] = std::sqrt(out[i] * out[i] + spare[i] * spare[i]);
}

void see(const HalfFiltered& picture, const Kernels& kernels, size_t y, SeenRow& out) {
    see_colours(picture, kernels, y, out);
    see_feature(picture, kernels, kernels.feature.edge, kEdge, y, out.spare, out.edge);
    see_feature(picture, kernels, kernels.feature.point, kPoint, y, out.spare, out.point);
}

// Colour difference ^ (1 - feature difference), the latter (greatest difference / sqrt 2) ^ 0.5.
void difference_of(SeenRow& a, SeenRow& b, size_t width, float* out) {
    colour_difference({a.l.data(), a.a.data(), a.b.data()}, {b.l.data(), b.a.data(), b.b.data()}, width, out);
    for (size_t i = 0; i < width; ++i) {
        float feature = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
        a.spare[i] = 1 - std::min(1.0f, std::sqrt(feature * 0.70710678f));
    }
    for (size_t i = 0; i < width; ++i) out[i] = std::pow(out[i], a.spare[i]);
}

}  // namespace

std::vector<float> flip_map(const Rgb8View& test, const Rgb8View& reference, double pixels_per_degree) {
    assert(test.width == reference.width && test.height == reference.height && test.rgb.size() == reference.rgb.size());
    assert(!test.rgb.empty() && pixels_per_degree >= 1 && pixels_per_degree <= 1000);
    const Kernels kernels(pixels_per_degree);
    const HalfFiltered half_test = filter_rows(test, kernels), half_reference = filter_rows(reference, kernels);

    std::vector<float> map(size_t(test.width) * test.height);
    parallel_ranges(test.height, kRowsAtOnce, [&](size_t begin, size_t end) {
        SeenRow seen_test(test.width), seen_reference(test.width);
        for (size_t y = begin; y < end; ++y) {
            see(half_test, kernels, y, seen_test);
            see(half_reference, kernels, y, seen_reference);
            difference_of(seen_test, seen_reference, test.width, map.data() + y * test.width);
        }
    });
    return map;
}

}  // namespace overlook::view
