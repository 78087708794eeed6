#include "tools/bake/discrete/picture_pack.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overlook::discrete {
namespace {

constexpr uint32_t kApart = 4, kMostSide = 8192, kWhite = 4;

// Where rectangles lie in rows of a width, the first in the corner for what is white; returns the height.
uint32_t lay_out(std::span<const Card> cards, const std::vector<uint32_t>& order, uint32_t width,
                 std::vector<PackedPicture::Place>& places) {
    uint32_t x = kApart + kWhite + kApart, y = kApart, row = kWhite;
    for (uint32_t i : order) {
        if (x + cards[i].width + kApart > width) x = kApart, y += row + kApart, row = 0;
        places[i] = {x, y};
        x += cards[i].width + kApart, row = std::max(row, cards[i].height);
    }
    return y + row + kApart;
}

void put(PictureRgba8& picture, int64_t x, int64_t y, const glm::dvec3& linear, uint8_t opacity) {
    if (x < 0 || y < 0 || x >= int64_t(picture.width) || y >= int64_t(picture.height)) return;
    glm::dvec3 encoded = srgb_of_linear(glm::clamp(linear, glm::dvec3(0), glm::dvec3(1)));
    uint8_t* to = picture.pixels.data() + 4 * (size_t(y) * picture.width + size_t(x));
    for (int c = 0; c < 3; ++c) to[c] = uint8_t(std::lround(255 * encoded[c]));
    to[3] = opacity;
}

// With its colours half way to its neighbours.
void draw(const Card& card, const PackedPicture::Place& place, PictureRgba8& picture) {
    constexpr int64_t kBeyond = kApart / 2;
    auto width = int64_t(card.width), height = int64_t(card.height);
    for (int64_t y = -kBeyond; y < height + kBeyond; ++y)
        for (int64_t x = -kBeyond; x < width + kBeyond; ++x) {
            size_t from = size_t(std::clamp<int64_t>(y, 0, height - 1) * width + std::clamp<int64_t>(x, 0, width - 1));
            bool is_within = x >= 0 && y >= 0 && x < width && y < height;
            put(picture, int64_t(place.left) + x, int64_t(place.top) + y, card.colour[from],
                is_within && card.is_opaque[from] != 0 ? 255 : 0);
        }
}

}  // namespace

Result<PackedPicture> pack(std::span<const Card> cards) {
    std::vector<uint32_t> order(cards.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return cards[a].height > cards[b].height; });
    uint32_t widest = kWhite;
    double area = 0;
    for (const Card& card : cards) {
        widest = std::max(widest, card.width);
        area += double(card.width + kApart) * (card.height + kApart);
    }
    PackedPicture packed;
    packed.places.resize(cards.size());
    uint32_t width = std::max(widest + 2 * kApart, uint32_t(std::ceil(std::sqrt(area) * 1.05)) + kWhite + 2 * kApart);
    width = (width + 3) / 4 * 4;
    uint32_t height = (lay_out(cards, order, width, packed.places) + 3) / 4 * 4;
    if (width > kMostSide || height > kMostSide)
        return impossible("the billboards' picture has {} x {} texels, {} a side fit", width, height, kMostSide);
    packed.picture = {width, height, std::vector<uint8_t>(4 * size_t(width) * height, 0)};
    for (size_t i = 0; i < cards.size(); ++i) draw(cards[i], packed.places[i], packed.picture);
    for (uint32_t y = 0; y < kWhite; ++y)
        for (uint32_t x = 0; x < kWhite; ++x) put(packed.picture, kApart + x, kApart + y, glm::dvec3(1), 255);
    packed.white = glm::dvec2(kApart + kWhite / 2.0) / glm::dvec2(width, height);
    packed.mask = {width, height, {}, true};
    for (size_t i = 0; i < size_t(width) * height; ++i) packed.mask.is_opaque.push_back(packed.picture.pixels[4 * i + 3] == 255);
    return packed;
}

}  // namespace overlook::discrete
