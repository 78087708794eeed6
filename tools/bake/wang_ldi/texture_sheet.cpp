#include "tools/bake/wang_ldi/texture_sheet.h"

#include <cmath>

#include "tools/bake/wang_ldi/texture_boxes.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kMostRows = 6, kMostColumns = 12, kGap_px = 6;
constexpr uint32_t kAbove_px = 128, kAsideWidth_px = 192, kAsideHeight_px = 120, kLinesOfAPixel = 4;
constexpr double kGrey = 0.35;  // linear, behind what is seen

// A picture of pictures, its ground white.
class Pages {
  public:
    Pages(uint32_t rows, uint32_t columns, uint32_t width_px, uint32_t height_px)
        : width_px_(width_px),
          height_px_(height_px),
          picture_{kGap_px + columns * (width_px + kGap_px), kGap_px + rows * (height_px + kGap_px), {}} {
        picture_.pixels.assign(size_t(picture_.width) * picture_.height * 3, 255);
    }
    // row and column of a page; x to the right, y down.
    void set(uint32_t page_row, uint32_t page_column, uint32_t x, uint32_t y, const Seen& seen) {
        size_t at_x = kGap_px + page_column * (width_px_ + kGap_px) + x, at_y = kGap_px + page_row * (height_px_ + kGap_px) + y;
        for (int c = 0; c < 3; ++c) {
            double linear = std::clamp(seen.colour[c] + (1 - seen.coverage) * kGrey, 0.0, 1.0);
            picture_.pixels[3 * (at_y * picture_.width + at_x) + size_t(c)] =
                uint8_t(std::lround(255 * overlook::srgb_from_linear(linear)));
        }
    }
    ImageRgb8 take() { return std::move(picture_); }

  private:
    uint32_t width_px_, height_px_;
    ImageRgb8 picture_;
};

void draw_above(const TextureSet& set, const DirectionalTexture& texture, uint32_t row, uint32_t column, Pages& pages) {
    for (uint32_t y = 0; y < kAbove_px; ++y)
        for (uint32_t x = 0; x < kAbove_px; ++x) {
            size_t texel = size_t((kAbove_px - 1 - y) * set.side_px / kAbove_px) * set.side_px + x * set.side_px / kAbove_px;
            Seen seen;
            seen.coverage = texture.colours[texel][3] / 255.0;
            for (int c = 0; c < 3; ++c) seen.colour[c] = seen.coverage * linear_from_srgb_code(texture.colours[texel][size_t(c)]);
            pages.set(row, column, x, y, seen);
        }
}

// Where an eye stands, and where its picture's corners are: a plane upright through the tile's middle, as wide as its diagonal.
struct Aside {
    glm::dvec3 eye_m, middle_m, right;
    double width_m, height_m;

    Aside(const TextureSet& set, uint32_t direction) {
        double heading = 2 * M_PI * direction / set.direction_count;
        middle_m = {set.tile_m / 2, set.tile_m / 2, set.low_m};
        eye_m = {middle_m.x + set.nearest_m * std::sin(heading), middle_m.y + set.nearest_m * std::cos(heading),
                 (set.eye_low_m + set.eye_high_m) / 2};
        right = {-std::cos(heading), std::sin(heading), 0};
        width_m = set.tile_m * std::sqrt(2.0), height_m = 1.1 * (set.high_m - set.low_m);
    }
    // Of a place on the plane, 0..1 to the right and up.
    glm::dvec3 along(double x, double y) const {
        return middle_m + (x - 0.5) * width_m * right + glm::dvec3(0, 0, y * height_m) - eye_m;
    }
};

void draw_aside(const TextureSet& set, const DirectionalTexture& texture, const Aside& aside, uint32_t row, uint32_t column,
                Pages& pages) {
    for (uint32_t y = 0; y < kAsideHeight_px; ++y)
        for (uint32_t x = 0; x < kAsideWidth_px; ++x) {
            Seen sum;
            for (uint32_t line = 0; line < kLinesOfAPixel; ++line) {
                double at_x = (x + 0.25 + 0.5 * (line % 2)) / kAsideWidth_px,
                       at_y = 1 - (y + 0.25 + 0.5 * (line / 2)) / kAsideHeight_px;
                glm::dvec3 along = aside.along(at_x, at_y);
                glm::dvec2 over = over_tile(aside.eye_m, along, set.tile_m);
                if (over.x >= over.y) continue;
                Seen one = seen_along(set, texture, aside.eye_m, along, over);
                sum.colour += one.colour / double(kLinesOfAPixel), sum.coverage += one.coverage / kLinesOfAPixel;
            }
            pages.set(row, column, x, y, sum);
        }
}

}  // namespace

std::vector<SheetPicture> sheet_of(const TextureSet& set) {
    if (set.textures.empty()) return {};
    uint32_t rows = std::min(set.tile_count, kMostRows), columns = std::min(set.direction_count, kMostColumns);
    Pages above(rows, columns, kAbove_px, kAbove_px), aside(rows, columns, kAsideWidth_px, kAsideHeight_px);
    for (uint32_t tile = 0; tile < rows; ++tile)
        for (uint32_t column = 0; column < columns; ++column) {
            uint32_t direction = column * set.direction_count / columns;
            const DirectionalTexture& texture = set.textures[size_t(set.index_of(0, tile, direction))];
            draw_above(set, texture, tile, column, above);
            draw_aside(set, texture, Aside(set, direction), tile, column, aside);
        }
    std::vector<SheetPicture> sheet;
    sheet.push_back({"textures-above.png", "directional textures from above, a row for each tile", above.take()});
    sheet.push_back({"textures-aside.png", "as far eyes see them", aside.take()});
    return sheet;
}

}  // namespace overlook::wang_ldi
