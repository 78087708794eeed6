#include "tools/bake/wang_ldi/sheet.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/wang_ldi/canvas.h"
#include "tools/bake/wang_ldi/periodicity.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {
namespace {

constexpr Colour kBlack{20, 20, 20}, kGround{246, 243, 236}, kInterior{96, 150, 84}, kFrame{120, 120, 120};
constexpr uint32_t kVerticalHues = 2;  // so that horizontal and vertical colours differ in the picture

Colour horizontal_colour(uint8_t colour) {
    return colour_of(2u * colour);
}
Colour vertical_colour(uint8_t colour) {
    return colour_of(2u * colour + kVerticalHues - 1);
}

uint32_t columns_for(size_t count) {
    return uint32_t(std::ceil(std::sqrt(double(count) * 1.5)));
}

ImageRgb8 tiles_picture(const TileSet& set) {
    constexpr uint32_t kSide = 96, kGap = 16;
    uint32_t columns = columns_for(set.tiles.size()), rows = (uint32_t(set.tiles.size()) + columns - 1) / columns;
    Canvas canvas(kGap + columns * (kSide + kGap), kGap + rows * (kSide + kGap));
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        double x = kGap + double(t % columns) * (kSide + kGap), y = kGap + double(rows - 1 - t / columns) * (kSide + kGap);
        std::array<double, 2> middle{x + kSide / 2.0, y + kSide / 2.0}, sw{x, y}, se{x + kSide, y}, nw{x, y + kSide},
            ne{x + kSide, y + kSide};
        const Tile& tile = set.tiles[t];
        canvas.triangle(sw, se, middle, horizontal_colour(tile.south)),
            canvas.triangle(nw, ne, middle, horizontal_colour(tile.north));
        canvas.triangle(sw, nw, middle, vertical_colour(tile.west)), canvas.triangle(se, ne, middle, vertical_colour(tile.east));
        std::array<uint8_t, 4> corners = corners_of(set, tile);
        canvas.clip(x, y, x + kSide, y + kSide);
        for (size_t c = 0; c < 4 && set.corner_density.size() > 1; ++c) {
            auto shade = uint8_t(255 * (1 - set.corner_density[corners[c]]));
            canvas.disc(x + double(c & 1) * kSide, y + double(c >> 1) * kSide, kSide / 6.0, kBlack);
            canvas.disc(x + double(c & 1) * kSide, y + double(c >> 1) * kSide, kSide / 6.0 - 2,
                        {shade, shade, uint8_t(40 * corners[c])});
        }
        canvas.clip_nothing();
        canvas.frame(x, y, x + kSide, y + kSide, 2, kBlack);
    }
    return canvas.picture();
}

ImageRgb8 tiling_picture(const Tiling& tiling, uint32_t side, uint32_t pixels) {
    ImageRgb8 picture{side * pixels, side * pixels, {}};
    for (uint32_t y = 0; y < side * pixels; ++y)
        for (uint32_t x = 0; x < side * pixels; ++x) {
            Colour colour = colour_of(tiling.at(x / pixels, side - 1 - y / pixels));
            picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
        }
    return picture;
}

ImageRgb8 spectrum_picture(const Tiling& tiling, size_t tile_count) {
    constexpr uint32_t kSide = 256;
    Spectrum spectrum = spectrum_of(tiling, tile_count, kSide);
    ImageRgb8 picture{kSide, kSide, {}};
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            double power = spectrum.power[size_t((y + kSide / 2) % kSide) * kSide + (x + kSide / 2) % kSide];
            // 0.1 of the mean is black, 1,000 times it white.
            auto grey = uint8_t(255 * std::clamp((std::log10(std::max(power, 1e-9)) + 1) / 4, 0.0, 1.0) + 0.5);
            picture.pixels.insert(picture.pixels.end(), {grey, grey, grey});
        }
    return picture;
}

// Draws objects of a tile whose south-west corner is at (x, y).
class PlotPainter {
  public:
    PlotPainter(Canvas& canvas, const PlantedTiles& ground, double pixels_per_m)
        : canvas_(canvas), ground_(ground), scale_(pixels_per_m) {}

    void plant(size_t tile, const std::vector<Planted>& objects, double x, double y) {
        for (bool is_tight : {false, true})
            for (const Planted& object : objects) {
                const Model& model = ground_.planting.models[object.model];
                double radius_m = double(is_tight ? model.tight_radius_m : model.packing_radius_m) * double(object.scale);
                Colour colour = owner_colour(ground_.set.tiles[tile], object);
                canvas_.disc(x + double(object.x_m) * scale_, y + double(object.y_m) * scale_, radius_m * scale_,
                             is_tight ? colour : lighter(colour, 0.65));
            }
    }
    void frame(size_t tile, double x, double y, double width) {
        const Tile& t = ground_.set.tiles[tile];
        double side = ground_.planting.tile_size_m * scale_, half = width / 2;
        canvas_.box(x, y - half, x + side, y + half, horizontal_colour(t.south));
        canvas_.box(x, y + side - half, x + side, y + side + half, horizontal_colour(t.north));
        canvas_.box(x - half, y, x + half, y + side, vertical_colour(t.west));
        canvas_.box(x + side - half, y, x + side + half, y + side, vertical_colour(t.east));
    }

  private:
    Colour owner_colour(const Tile& tile, const Planted& object) const {
        double half_m = ground_.planting.tile_size_m / 2;
        if (object.owner == Owner::corner) return kBlack;
        if (object.owner == Owner::horizontal_edge)
            return horizontal_colour(double(object.y_m) < half_m ? tile.south : tile.north);
        if (object.owner == Owner::vertical_edge) return vertical_colour(double(object.x_m) < half_m ? tile.west : tile.east);
        return kInterior;
    }

    Canvas& canvas_;
    const PlantedTiles& ground_;
    double scale_;
};

ImageRgb8 plots_picture(const PlantedTiles& ground) {
    constexpr double kSide = 170, kMargin = 34;
    size_t count = ground.set.tiles.size();
    uint32_t columns = columns_for(count), rows = (uint32_t(count) + columns - 1) / columns;
    double cell = kSide + 2 * kMargin;
    Canvas canvas(uint32_t(columns * cell), uint32_t(rows * cell));
    PlotPainter painter(canvas, ground, kSide / ground.planting.tile_size_m);
    for (size_t t = 0; t < count; ++t) {
        double x = double(t % columns) * cell, y = double(rows - 1 - t / columns) * cell;
        canvas.clip(x + 4, y + 4, x + cell - 4, y + cell - 4);
        canvas.box(x + kMargin, y + kMargin, x + kMargin + kSide, y + kMargin + kSide, kGround);
        painter.plant(t, overhang(ground.set, ground.planting, t), x + kMargin, y + kMargin);
        painter.plant(t, ground.planting.tiles[t], x + kMargin, y + kMargin);
        painter.frame(t, x + kMargin, y + kMargin, 3);
    }
    return canvas.picture();
}

// Rows of pairs: each tile with one east colour, beside each that has it to the west; at most 6 x 6.
ImageRgb8 neighbours_picture(const PlantedTiles& ground) {
    constexpr double kSide = 120, kGap = 14;
    std::vector<size_t> left, right;
    uint8_t colour = ground.set.tiles[0].east;
    for (size_t t = 0; t < ground.set.tiles.size(); ++t) {
        if (ground.set.tiles[t].east == colour && left.size() < 6) left.push_back(t);
        if (ground.set.tiles[t].west == colour && right.size() < 6) right.push_back(t);
    }
    double width = 2 * kSide + kGap, height = kSide + kGap;
    Canvas canvas(uint32_t(kGap + double(right.size()) * width), uint32_t(kGap + double(left.size()) * height));
    PlotPainter painter(canvas, ground, kSide / ground.planting.tile_size_m);
    for (size_t row = 0; row < left.size(); ++row)
        for (size_t column = 0; column < right.size(); ++column) {
            double x = kGap + double(column) * width, y = kGap + double(left.size() - 1 - row) * height;
            canvas.clip(x, y, x + 2 * kSide, y + kSide);
            canvas.box(x, y, x + 2 * kSide, y + kSide, kGround);
            // Both with what is there of the other's edge, so that discs go on across it.
            painter.plant(left[row], ground.planting.tiles[left[row]], x, y);
            painter.plant(right[column], ground.planting.tiles[right[column]], x + kSide, y);
            painter.plant(left[row], overhang(ground.set, ground.planting, left[row]), x, y);
            painter.plant(right[column], overhang(ground.set, ground.planting, right[column]), x + kSide, y);
            painter.frame(left[row], x, y, 2), painter.frame(right[column], x + kSide, y, 2);
        }
    return canvas.picture();
}

ImageRgb8 planting_picture(const PlantedTiles& ground, const Tiling& tiling) {
    constexpr uint32_t kTiles = 6;
    constexpr double kSide = 128;
    Canvas canvas(uint32_t(kTiles * kSide), uint32_t(kTiles * kSide), kGround);
    PlotPainter painter(canvas, ground, kSide / ground.planting.tile_size_m);
    for (uint32_t y = 0; y < kTiles; ++y)
        for (uint32_t x = 0; x < kTiles; ++x)
            painter.plant(tiling.at(x, y), ground.planting.tiles[tiling.at(x, y)], x * kSide, y * kSide);
    for (uint32_t y = 0; y < kTiles; ++y)
        for (uint32_t x = 0; x < kTiles; ++x) canvas.frame(x * kSide, y * kSide, (x + 1) * kSide, (y + 1) * kSide, 0.7, kFrame);
    return canvas.picture();
}

// Robinson's by its formula; of sets with bare corners, ground that is planted here and there.
Result<Tiling> sheet_tiling(const TileSet& set, uint64_t seed) {
    constexpr uint32_t kSide = 256;
    TileSet robinson = robinson_set();
    std::vector<Tile> prototiles;  // variants stand beside each other
    for (const Tile& tile : set.tiles)
        if (prototiles.empty() || !(prototiles.back() == tile)) prototiles.push_back(tile);
    if (prototiles == robinson.tiles && set.horizontal == robinson.horizontal) return robinson_tiling(set, kSide, kSide, seed);
    TilingOptions options;
    options.seed = seed;
    if (std::count(set.corner_density.begin(), set.corner_density.end(), 0.0f) > 0)
        options.corner_at = corners_of_density(
            set,
            [](int64_t x, int64_t y) { return std::clamp(0.5 + std::sin(double(x) / 3) * std::cos(double(y) / 4), 0.0, 1.0); },
            seed);
    for (bool avoids : {true, false}) {
        options.avoids_equal_neighbours = avoids;
        auto tiling = tile_row_by_row(set, kSide, kSide, options);
        if (tiling || !avoids) return tiling;
    }
    return Tiling{};
}

}  // namespace

Result<std::vector<SheetPicture>> sheet_of(const PlantedTiles& ground, uint64_t seed) {
    auto tiling = sheet_tiling(ground.set, seed);
    if (!tiling) return tl::unexpected(tiling.error());
    TileSet robinson = robinson_set();
    Tiling plaid = robinson_tiling(robinson, 256, 256, seed);
    std::vector<SheetPicture> sheet;
    sheet.push_back({"tiles.png", "the set (figure 3)", tiles_picture(ground.set)});
    sheet.push_back({"tiling-32.png", "32 x 32 tiles (figure 4a)", tiling_picture(*tiling, 32, 16)});
    sheet.push_back({"tiling-256.png", "256 x 256 tiles (figure 4b)", tiling_picture(*tiling, 256, 2)});
    sheet.push_back({"robinson-32.png", "Robinson's sixteen, 32 x 32 (figure 4c)", tiling_picture(plaid, 32, 16)});
    sheet.push_back({"robinson-256.png", "Robinson's sixteen, 256 x 256 (figure 4d)", tiling_picture(plaid, 256, 2)});
    sheet.push_back({"spectrum.png", "spectrum of the tiling", spectrum_picture(*tiling, ground.set.tiles.size())});
    sheet.push_back({"robinson-spectrum.png", "spectrum of Robinson's", spectrum_picture(plaid, robinson.tiles.size())});
    sheet.push_back({"planting-neighbours.png", "planting across an edge (figure 5)", neighbours_picture(ground)});
    sheet.push_back({"planting-tiles.png", "tiles with what stands over their edges (figure 6)", plots_picture(ground)});
    sheet.push_back({"planting.png", "6 x 6 tiles from above", planting_picture(ground, *tiling)});
    return sheet;
}

}  // namespace overlook::wang_ldi
