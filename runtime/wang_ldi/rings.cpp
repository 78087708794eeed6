#include "runtime/wang_ldi/rings.h"

#include <cmath>
#include <utility>

namespace overlook::wang_ldi {
namespace {

constexpr double kOwnShare = 0.45;  // of an image's own light in its ring's colour

}  // namespace

std::array<uint8_t, 3> ring_colour(uint32_t level, uint32_t direction) {
    constexpr std::array<std::array<uint8_t, 3>, 7> kHues = {
        {{214, 69, 65}, {235, 149, 50}, {240, 210, 70}, {90, 175, 80}, {60, 160, 190}, {70, 95, 190}, {150, 85, 180}}};
    std::array<uint8_t, 3> colour = kHues[level % kHues.size()];
    if (direction % 2 == 1)
        for (uint8_t& channel : colour) channel = uint8_t(channel * 5 / 8);
    return colour;
}

Ldi ring_image(const Ldi& ldi, uint32_t level, uint32_t direction) {
    Ldi image = ldi;
    std::array<uint8_t, 3> ring = ring_colour(level, direction);
    for (auto& colour : image.palette) {
        double own = (colour[0] + colour[1] + colour[2]) / (3 * 128.0);
        for (size_t c = 0; c < 3; ++c)
            colour[c] = uint8_t(std::lround(std::min(255.0, ring[c] * (1 - kOwnShare + kOwnShare * own))));
    }
    return image;
}

void RingImages::take(const Field& field, const FieldList& list, const ImageStore& images) {
    std::map<uint64_t, StoredImage> before = std::exchange(images_, {});
    const stream::Counts& counts = images.counts();
    uint64_t taken = counts.resident_bytes + counts.on_the_way_bytes, budget = images.settings().residency_budget_bytes;
    uint64_t room = budget > taken ? budget - taken : 0;
    uint64_t all_bytes = 0;
    for (const Item& item : list.items)
        for (const Shown& shown : list.shown_of(item)) {
            const Rung& rung = field.ladder().rungs[shown.rung];
            if (rung.stage != Stage::ldi) continue;
            uint64_t index = field.image_of(item, shown);
            const StoredImage* image = images_.contains(index) ? nullptr : images.at(index);
            uint64_t bytes = image == nullptr ? 0 : images.bytes_of(index);
            if (image == nullptr || all_bytes + bytes > room) continue;
            all_bytes += bytes;
            if (auto kept = before.extract(index))
                images_.insert(std::move(kept));
            else
                images_.emplace(index, StoredImage::of(ring_image(image->ldi, rung.level, shown.direction)));
        }
}

const StoredImage* RingImages::at(uint64_t index) const {
    auto found = images_.find(index);
    return found == images_.end() ? nullptr : &found->second;
}

}  // namespace overlook::wang_ldi
