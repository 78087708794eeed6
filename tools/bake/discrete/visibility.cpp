#include "tools/bake/discrete/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "formats/discrete_layout.h"
#include "tools/bake/discrete/visibility_optimised.h"
#include "tools/bake/discrete/volume.h"
#include "tools/bake/images.h"

namespace overlook::discrete {
namespace {

constexpr uint32_t kSide = 64;
constexpr std::array<std::string_view, 6> kNames{"noise", "blue-noise", "checkerboard", "centre", "optimised", "none"};

Visibility picture(uint32_t width, uint32_t height, const VisibilityOptions& options) {
    return {Visibility::Lookup::paper, width, height, 1, float(options.period_m), std::vector<uint8_t>(size_t(width) * height)};
}

Result<Visibility> from_file(const std::string& path, const VisibilityOptions& options) {
    auto image = read_image_rgb8(path);
    if (!image) return tl::unexpected(image.error());
    if (image->width > kMostSide || image->height > kMostSide || image->width == 0 || image->height == 0)
        return bad_input("{}: is {} x {} pixels, at most {} a side are visibility", path, image->width, image->height, kMostSide);
    Visibility visibility = picture(image->width, image->height, options);
    for (size_t i = 0; i < visibility.values.size(); ++i) {
        const uint8_t* rgb = image->pixels.data() + 3 * i;
        visibility.values[i] = uint8_t((54u * rgb[0] + 183u * rgb[1] + 19u * rgb[2] + 128) / 256);
    }
    return visibility;
}

}  // namespace

std::string visibility_names() {
    std::string names;
    for (std::string_view name : kNames) names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

Visibility white_noise(const VisibilityOptions& options) {
    Visibility noise = picture(kSide, kSide, options);
    std::mt19937_64 random(options.seed);
    for (uint8_t& value : noise.values) value = uint8_t(random() >> 56);
    return noise;
}

Visibility checkerboard(const VisibilityOptions& options) {
    constexpr uint32_t kSquare = kSide / 8, kSteps = 16;
    Visibility board = picture(kSide, kSide, options);
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            bool is_white = (x / kSquare + y / kSquare) % 2 == 1;
            // Within its kind a square comes by its place along the board's diagonals.
            uint32_t step = (x / kSquare + 2 * (y / kSquare)) % kSteps;
            board.values[y * kSide + x] = uint8_t((is_white ? 128 : 0) + step * 127 / (kSteps - 1));
        }
    return board;
}

Visibility from_centre(const Chain& chain) {
    constexpr uint32_t kCells = 32;
    VolumeFrame frame = frame_of(chain, kCells);
    std::vector<double> order(size_t(kCells) * kCells * kCells, std::nan("")), weight(order.size(), 0);
    for (const Level& level : chain.levels)
        for (const SurfacePoint& point : surface_points(chain, level, 1 << 15)) {
            size_t cell = frame.cell_of(point.at_m);
            weight[cell] += point.area_m2;
            order[cell] = glm::distance(frame.middle_m(cell), chain.middle_m);
        }
    return volume_by_order(frame, std::move(order), weight);
}

Result<void> set_visibility(Chain& chain, const std::string& name, const VisibilityOptions& options) {
    chain.visibility.clear();
    if (name == "none") return {};
    if (name == "optimised") {
        for (size_t k = 0; k + 1 < chain.levels.size(); ++k) chain.visibility.push_back(optimised_visibility(chain, k));
        return {};
    }
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
        auto read = from_file(name, options);
        if (!read) return tl::unexpected(read.error());
        chain.visibility.push_back(std::move(*read));
        return {};
    }
    chain.visibility.push_back(name == "noise"          ? white_noise(options)
                               : name == "blue-noise"   ? blue_noise(options)
                               : name == "checkerboard" ? checkerboard(options)
                                                        : from_centre(chain));
    return {};
}

}  // namespace overlook::discrete
