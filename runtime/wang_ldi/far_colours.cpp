#include "runtime/wang_ldi/far_colours.h"

#include <cmath>

#include "formats/srgb.h"

namespace overlook::wang_ldi {
namespace {

uint32_t mean_colour(const Ldi& ldi) {
    if (ldi.sample_count() == 0) return 0;
    std::vector<uint64_t> uses(ldi.palette.size());
    for (uint8_t colour : ldi.colours) ++uses[colour];
    uint32_t mean = 0xff000000u;
    for (size_t channel = 0; channel < 3; ++channel) {
        double light = 0;
        for (size_t c = 0; c < uses.size(); ++c) light += double(uses[c]) * linear_from_srgb(ldi.palette[c][channel] / 255.0);
        mean |= uint32_t(std::lround(255 * srgb_from_linear(light / ldi.sample_count()))) << (8 * channel);
    }
    return mean;
}

}  // namespace

FarColours FarColours::of(const ImageSet& set, const ImageAt& image_at) {
    FarColours made;
    made.direction_count_ = set.direction_count;
    auto coarsest = uint32_t(set.levels.size() - 1);
    uint64_t steps = 0, samples = 0;
    for (uint32_t tile = 0; tile < set.tile_count; ++tile)
        for (uint32_t direction = 0; direction < set.direction_count; ++direction) {
            const Ldi* ldi = image_at(index_of(set, {0, tile, coarsest, direction}));
            made.texels_.push_back({ldi != nullptr ? mean_colour(*ldi) : 0, 0});
            if (ldi == nullptr) continue;
            for (uint16_t height : ldi->heights) steps += height;
            samples += ldi->sample_count();
        }
    if (samples == 0) return made;
    double mean_m = set.low_m + double(set.levels[coarsest].height_step_m) * double(steps) / double(samples);
    for (FarTexel& texel : made.texels_) texel.height_m = float(mean_m);
    return made;
}

}  // namespace overlook::wang_ldi
