#include "tools/measure/capture.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "formats/srgb.h"

namespace overlook::measure {

Frame captured(const gl::Target& colour, const gl::Target& middle, const view::Camera& camera) {
    assert(colour.width_px() == middle.width_px() && colour.height_px() == middle.height_px() && middle.samples() == 1);
    constexpr uint32_t kGround = kBackground + 1;
    Frame frame;
    frame.width = colour.width_px();
    frame.height = colour.height_px();
    frame.camera = camera;
    frame.rgb = colour.read().pixels;
    frame.depth_m = middle.read_depth();
    frame.ids.resize(frame.depth_m.size());
    for (size_t i = 0; i < frame.depth_m.size(); ++i) {
        bool is_drawn = frame.depth_m[i] > 0;
        frame.depth_m[i] = is_drawn ? float(camera.near_m) / frame.depth_m[i] : std::numeric_limits<float>::infinity();
        frame.ids[i] = is_drawn ? kGround : kBackground;
    }
    return frame;
}

std::vector<uint8_t> mask_of(const gl::Target& target) {
    ImageRgb8 picture = target.read();
    std::vector<uint8_t> mask(size_t(picture.width) * picture.height);
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = picture.pixels[3 * i];
    return mask;
}

ImageRgb8 box_filtered(const ImageRgb8& image, uint32_t factor) {
    assert(factor >= 1 && image.width % factor == 0 && image.height % factor == 0);
    ImageRgb8 small{image.width / factor, image.height / factor, {}};
    small.pixels.resize(size_t(small.width) * small.height * 3);
    const std::array<double, 256>& linear = linear_of_srgb_codes();
    size_t row_bytes = size_t(image.width) * 3;
    parallel_ranges(small.height, 8, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            for (size_t at = 0; at < size_t(small.width) * 3; ++at) {
                size_t column = at / 3, channel = at % 3;
                double sum = 0;
                for (size_t y = row * factor; y < (row + 1) * factor; ++y) {
                    for (size_t x = column * factor; x < (column + 1) * factor; ++x) {
                        sum += linear[image.pixels[y * row_bytes + x * 3 + channel]];
                    }
                }
                double encoded = srgb_from_linear(sum / (double(factor) * factor));
                small.pixels[row * small.width * 3 + at] = uint8_t(std::lround(255 * encoded));
            }
        }
    });
    return small;
}

}  // namespace overlook::measure
