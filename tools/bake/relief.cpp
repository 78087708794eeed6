#include "tools/bake/relief.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/relief_colour.h"
#include "tools/bake/relief_light.h"

namespace overlook {
namespace {

using relief::Colour;
using relief::Field;

constexpr uint8_t kVoidGrey = 128;
constexpr double kGoodSlope = 0.42;  // tangent that nine tenths of the ground should stay under, after exaggeration
constexpr double kMostExaggeration = 12;

// Heights in metres, the mean of the valid samples of k x k.
Field reduce(const dem::Raster& dem, uint32_t k) {
    Field field{
        (dem.width + k - 1) / k, (dem.height + k - 1) / k, dem.frame.metres_per_column * k, dem.frame.metres_per_row * k, {}};
    field.height_m.assign(size_t(field.width) * field.height, NAN);
    parallel_ranges(field.height, 16, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin); row < end; ++row)
            for (uint32_t column = 0; column < field.width; ++column) {
                double sum = 0;
                uint32_t count = 0;
                for (uint32_t y = row * k; y < std::min(dem.height, (row + 1) * k); ++y)
                    for (uint32_t x = column * k; x < std::min(dem.width, (column + 1) * k); ++x) {
                        float sample = dem.samples[size_t(y) * dem.width + x];
                        if (std::isnan(sample)) continue;
                        sum += sample;
                        ++count;
                    }
                if (count == 0) continue;
                double height_m = dem.height_offset_m + dem.height_scale_m * (sum / count);
                field.height_m[size_t(row) * field.width + column] = float(height_m);
            }
    });
    return field;
}

// Half as many cells each way, for light that is smooth anyway.
Field halve(const Field& field) {
    Field half{(field.width + 1) / 2, (field.height + 1) / 2, field.column_m * 2, field.row_m * 2, {}};
    half.height_m.assign(size_t(half.width) * half.height, NAN);
    for (uint32_t row = 0; row < half.height; ++row)
        for (uint32_t column = 0; column < half.width; ++column) {
            float sum = 0, count = 0;
            for (uint32_t y = row * 2; y < std::min(field.height, row * 2 + 2); ++y)
                for (uint32_t x = column * 2; x < std::min(field.width, column * 2 + 2); ++x)
                    if (!std::isnan(field.at(x, y))) sum += field.at(x, y), count += 1;
            if (count > 0) half.height_m[size_t(row) * half.width + column] = sum / count;
        }
    return half;
}

// Value of a half-sized grid at the middle of a cell of the whole one.
double value_between(const std::vector<float>& half, uint32_t width, uint32_t height, uint32_t column, uint32_t row) {
    double x = std::clamp((column - 0.5) / 2, 0.0, double(width - 1)), y = std::clamp((row - 0.5) / 2, 0.0, double(height - 1));
    uint32_t i = uint32_t(x), j = uint32_t(y), i1 = std::min(i + 1, width - 1), j1 = std::min(j + 1, height - 1);
    double fx = x - i, fy = y - j;
    double top = half[size_t(j) * width + i] * (1 - fx) + half[size_t(j) * width + i1] * fx;
    double bottom = half[size_t(j1) * width + i] * (1 - fx) + half[size_t(j1) * width + i1] * fx;
    return top * (1 - fy) + bottom * fy;
}

// How much to exaggerate heights so that nine tenths of the ground reach a slope that light can show; 1 for
// mountains. Steep and gentle ground are counted in bins of slope.
double exaggeration_of(const Field& field, const relief::Slopes& slopes) {
    std::vector<uint64_t> bins(4096);
    uint64_t count = 0;
    for (size_t i = 0; i < field.height_m.size(); ++i) {
        if (std::isnan(field.height_m[i])) continue;
        double tangent = std::sqrt(double(slopes.right[i]) * slopes.right[i] + double(slopes.up[i]) * slopes.up[i]);
        ++bins[size_t(std::min(4095.0, tangent * 2048))];
        ++count;
    }
    uint64_t below = 0;
    size_t bin = 0;
    while (bin < bins.size() && (below += bins[bin]) * 10 < count * 9) ++bin;
    return std::clamp(kGoodSlope / ((double(bin) + 0.5) / 2048), 1.0, kMostExaggeration);
}

// Everything that decides a pixel.
struct Scene {
    Field field, half;
    relief::Slopes slopes;
    double exaggeration = 1;
    double lowest_m = 0, highest_m = 0;
    relief::Vector sun{};
    std::vector<float> sun_share, half_sky, near_mean_m, far_mean_m;
    std::vector<uint8_t> is_water;
};

Scene look_at(const dem::Raster& dem, const ReliefOptions& options) {
    uint32_t longest = std::max(dem.width, dem.height), limit = std::max(1u, options.max_side_px);
    Scene scene;
    scene.field = reduce(dem, (longest + limit - 1) / limit);
    scene.half = halve(scene.field);
    scene.slopes = relief::slopes_of(scene.field);
    scene.exaggeration = exaggeration_of(scene.field, scene.slopes);
    scene.lowest_m = HUGE_VAL;
    scene.highest_m = -HUGE_VAL;
    for (float height_m : scene.field.height_m) {
        if (std::isnan(height_m)) continue;
        scene.lowest_m = std::min(scene.lowest_m, double(height_m));
        scene.highest_m = std::max(scene.highest_m, double(height_m));
    }
    scene.is_water = relief::find_water(scene.field, 300);
    scene.near_mean_m = relief::local_mean(scene.field, 3);
    scene.far_mean_m = relief::local_mean(scene.field, 24);
    scene.half_sky = relief::sky_visibility(scene.half, scene.exaggeration);
    scene.sun = relief::sun_direction(options.sun_azimuth_deg, options.sun_altitude_deg);
    // Shadows of exaggerated heights under the true sun.
    Field tall = scene.field;
    for (float& height_m : tall.height_m) height_m = float(height_m * scene.exaggeration);
    scene.sun_share = relief::sun_visibility(tall, options.sun_azimuth_deg, options.sun_altitude_deg);
    return scene;
}

relief::Ground ground_at(const Scene& scene, size_t i) {
    double right = scene.slopes.right[i] * scene.exaggeration, up = scene.slopes.up[i] * scene.exaggeration;
    double height_m = scene.field.height_m[i], cell_m = std::sqrt(scene.field.column_m * scene.field.row_m);
    double near = (scene.near_mean_m[i] - height_m) / cell_m * scene.exaggeration;
    double far = (scene.far_mean_m[i] - height_m) / (8 * cell_m) * scene.exaggeration;
    relief::Ground ground;
    ground.relief_m = scene.highest_m - scene.lowest_m;
    ground.height = ground.relief_m > 0 ? (height_m - scene.lowest_m) / ground.relief_m : 0;
    ground.slope = std::sqrt(right * right + up * up);
    ground.hollow = std::clamp(near * 2.5, -1.0, 1.0);
    ground.valley = std::clamp(far * 1.2, -1.0, 1.0);
    ground.is_water = scene.is_water[i] != 0;
    return ground;
}

// Sun and sky on one cell: warm and cool.
Colour light_at(const Scene& scene, uint32_t column, uint32_t row, size_t i) {
    double right = scene.slopes.right[i] * scene.exaggeration, up = scene.slopes.up[i] * scene.exaggeration;
    double length = std::sqrt(1 + right * right + up * up);
    double facing = (scene.sun[2] - right * scene.sun[0] - up * scene.sun[1]) / length;
    double sun = std::max(0.0, facing) * scene.sun_share[i];
    double open = value_between(scene.half_sky, scene.half.width, scene.half.height, column, row);
    double sky = open * open * (0.55 + 0.45 / length);
    double bounce = 0.06 * (1 - open);
    return {1.62 * sun + 0.30 * sky + bounce, 1.46 * sun + 0.38 * sky + bounce, 1.18 * sun + 0.52 * sky + 0.8 * bounce};
}

// Keeps bright snow from clipping: straight below 0.6, bending towards 1 above.
double soften(double value) {
    if (value <= 0.6) return value;
    double over = (value - 0.6) / 0.4;
    return 0.6 + 0.4 * over / (1 + over);
}

}  // namespace

ImageRgb8 shade_relief(const dem::Raster& dem, const ReliefOptions& options) {
    Scene scene = look_at(dem, options);
    ImageRgb8 image{scene.field.width, scene.field.height, {}};
    image.pixels.assign(scene.field.height_m.size() * 3, kVoidGrey);
    parallel_ranges(image.height, 16, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin); row < end; ++row)
            for (uint32_t column = 0; column < image.width; ++column) {
                size_t i = size_t(row) * image.width + column;
                if (std::isnan(scene.field.height_m[i])) continue;
                Colour colour = relief::ground_colour(ground_at(scene, i)), light = light_at(scene, column, row, i);
                for (size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = relief::srgb_from_linear(soften(colour[c] * light[c]));
            }
    });
    return image;
}

}  // namespace overlook
