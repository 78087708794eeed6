#include "tools/bake/wang_ldi/textures_opacity.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/wang_ldi/texture_boxes.h"

namespace overlook::wang_ldi {
namespace {

constexpr int kRounds = 8;

// Of one picture: what each box lets through is found for all boxes at once, again and again.
class Picture {
  public:
    Picture(const TextureSet& set, std::span<const Line> lines, std::span<const double> shown, const DirectionalTexture& texture,
            uint32_t level);
    void run();
    // Of a texel, 0..1; negative where no line passes its box.
    double opacity(size_t texel) const { return reached_[texel] > 0 ? opacity_[texel] : -1; }

  private:
    void pass(const Line& line);

    const TextureSet& set_;
    std::span<const Line> lines_;
    std::span<const double> shown_;  // of this picture
    uint32_t side_;
    std::vector<Box> boxes_;
    std::vector<double> opacity_, reached_;  // reached: sum over lines of what comes through to the box
};

Picture::Picture(const TextureSet& set, std::span<const Line> lines, std::span<const double> shown,
                 const DirectionalTexture& texture, uint32_t level)
    : set_(set), lines_(lines), side_(set.side_px >> level) {
    size_t first = texture_level_at(set.side_px, level), count = size_t(side_) * side_;
    shown_ = shown.subspan(first, count);
    for (size_t t = 0; t < count; ++t) boxes_.push_back(box_of(set, texture, first + t));
    opacity_.assign(count, 0), reached_.assign(count, 0);
}

void Picture::pass(const Line& line) {
    glm::dvec3 from(line.from_m), along(line.along);
    glm::dvec2 over = over_tile(from, along, set_.tile_m);
    double through = 1;
    walk_texels(from, along, set_.tile_m, side_, over.x, over.y, [&](uint32_t t, double begin, double end) {
        double a = from.z + begin * along.z, b = from.z + end * along.z;
        if (shown_[t] == 0 || std::max(a, b) < boxes_[t].low_m || std::min(a, b) > boxes_[t].high_m) return true;
        reached_[t] += through, through *= 1 - opacity_[t];
        return through > 1e-4;
    });
}

void Picture::run() {
    for (int round = 0; round < kRounds; ++round) {
        std::fill(reached_.begin(), reached_.end(), 0);
        for (const Line& line : lines_) pass(line);
        for (size_t t = 0; t < opacity_.size(); ++t)
            if (reached_[t] > 0) opacity_[t] = std::min(1.0, shown_[t] * double(lines_.size()) / reached_[t]);
    }
}

}  // namespace

void choose_opacity(const TextureSet& set, std::span<const Line> lines, std::span<const double> shown,
                    DirectionalTexture& texture, uint32_t pictures) {
    for (uint32_t level = std::min(texture_levels(set.side_px), pictures); level-- > 0;) {
        Picture picture(set, lines, shown, texture, level);
        picture.run();
        size_t at = texture_level_at(set.side_px, level), coarse = texture_level_at(set.side_px, level + 1);
        uint32_t side = set.side_px >> level;
        for (uint32_t t = 0; t < side * side; ++t) {
            if (shown[at + t] == 0) continue;
            double opacity = picture.opacity(t);
            // No line came by: as the coarser one.
            if (opacity < 0)
                opacity = side == 1 ? 0 : texture.colours[coarse + size_t(t / side / 2) * (side / 2) + t % side / 2][3] / 255.0;
            texture.colours[at + t][3] = uint8_t(std::clamp(std::round(255 * opacity), 1.0, 255.0));
        }
    }
}

}  // namespace overlook::wang_ldi
