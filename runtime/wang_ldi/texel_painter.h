// Tiles so far away that they are drawn as texels laid over the ground: single tiles, and blocks of many whose tiles are asked
// for place by place.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "runtime/wang_ldi/far_colours.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {

constexpr double kDiagonal = 1.4142135623730951;  // of a square: so wide a texel leaves no gap, whichever way it is turned

// The texels of an item, [texels_px, texels_px] of it.
template <class Brush>
class TexelPainter {
  public:
    TexelPainter(const Eye& eye, const Field& field, const FarColours& far, const Item& item, Brush& brush)
        : eye_(eye), field_(field), far_(far), item_(item), brush_(brush) {
        rect_ = field.parts().placement->rect_of(item.i, item.j, int64_t(1) << item.tiles_log2);
        texel_m_ = (rect_.high_m.x - rect_.low_m.x) / item.texels_px;
        uint32_t tiles = 1u << item.tiles_log2;
        in_tile_px_ = std::max(item.texels_px / tiles, 1u);
        if (tiles > 1 && in_tile_px_ > 1) known_.assign(size_t(tiles) * tiles, kUnknown);
    }

    // From which tile a texel is, and what decides there between rungs and between directions.
    struct Place {
        glm::dvec2 at_m;
        int64_t i = 0, j = 0;
        uint32_t column = 0, row = 0;  // of in_tile_px along the tile's side

        uint32_t decides_rung(uint32_t side_px) const {
            return rung_threshold(Field::fade_number(i, j), column, row, side_px, side_px);
        }
        uint32_t decides_direction() const { return direction_threshold(Field::fade_number(i, j), column, row); }
    };
    Place place(uint32_t column, uint32_t row) const {
        Place found{rect_.low_m + texel_m_ * (glm::dvec2(column, row) + 0.5), item_.i, item_.j, 0, 0};
        // Halves of texels from the item's corner, so that a tile's number is whole.
        uint64_t tiles = uint64_t(1) << item_.tiles_log2, across = uint64_t(2) * item_.texels_px;
        uint64_t x = (uint64_t(2) * column + 1) * tiles, y = (uint64_t(2) * row + 1) * tiles;
        found.i += int64_t(x / across), found.j += int64_t(y / across);
        found.column = uint32_t(x % across * in_tile_px_ / across), found.row = uint32_t(y % across * in_tile_px_ / across);
        return found;
    }

    void draw(const Place& place, uint32_t direction) {
        std::optional<uint8_t> tile = tile_at(place);
        if (!tile) return;
        FarTexel texel = far_.at(*tile, direction);
        if (texel.colour == 0) return;
        double ground_m = field_.parts().placement->ground().height_m(place.at_m);
        if (!std::isfinite(ground_m)) return;
        glm::dvec3 at(place.at_m, ground_m + double(texel.height_m));
        brush_.splat(eye_.seen(at - eye_.position_m), float(eye_.focal_px * kDiagonal * texel_m_), texel.colour);
    }

    // The whole item, of which nothing but texels is shown.
    void draw_all(std::span<const Shown> shown, const glm::dvec2& eye_share) {
        uint32_t side = item_.texels_px;
        bool is_one = shown.size() == 1 && shown[0].by_rung == Thresholds{} && shown[0].by_direction == Thresholds{};
        int64_t eye_column = cell_at(eye_share.x, side), eye_row = cell_at(eye_share.y, side);
        for (uint32_t j = 0; j < side; ++j)
            for (uint32_t i = 0, row = towards(j, eye_row, side); i < side; ++i) {
                Place here = place(towards(i, eye_column, side), row);
                if (is_one && is_drawn(shown[0])) draw(here, shown[0].direction);
                if (!is_one) draw_one_of(shown, here);
            }
    }

  private:
    void draw_one_of(std::span<const Shown> shown, const Place& here) {
        uint32_t by_rung = here.decides_rung(in_tile_px_), by_direction = here.decides_direction();
        for (const Shown& one : shown)
            if (is_drawn(one) && one.by_rung.contains(by_rung) && one.by_direction.contains(by_direction))
                draw(here, one.direction);
    }
    bool is_drawn(const Shown& shown) const {
        Stage stage = field_.ladder().rungs[shown.rung].stage;
        return stage == Stage::texture || stage == Stage::colour;
    }

    // None where nothing is planted.
    std::optional<uint8_t> tile_at(const Place& place) {
        if (item_.tiles_log2 == 0) return item_.tile;
        if (in_tile_px_ == 1) return asked_tile(place);
        int16_t& known = known_[size_t(place.j - item_.j) << item_.tiles_log2 | size_t(place.i - item_.i)];
        if (known == kUnknown) {
            auto tile = asked_tile(place);
            known = tile ? *tile : kBare;
        }
        return known == kBare ? std::nullopt : std::optional(uint8_t(known));
    }
    std::optional<uint8_t> asked_tile(const Place& place) const {
        const FieldParts& parts = field_.parts();
        if (!item_.is_planted_throughout && !parts.placement->is_planted(place.i, place.j)) return std::nullopt;
        return parts.tiling->at(place.i, place.j);
    }

    static constexpr int16_t kUnknown = -2, kBare = -1;
    const Eye& eye_;
    const Field& field_;
    const FarColours& far_;
    const Item& item_;
    Brush& brush_;
    Rect rect_;
    double texel_m_ = 0;
    uint32_t in_tile_px_ = 1;
    std::vector<int16_t> known_;  // tiles of a block of which there are several texels each
};

// The texels of a tile that images of it give way to.
template <class Brush>
class TexelColumns final : public Columns {
  public:
    TexelColumns(TexelPainter<Brush>& painter, uint32_t texels_px, uint32_t direction)
        : painter_(painter), direction_(direction) {
        side_px = texels_px;
    }
    void stand_on(const Plane&) override {}  // texels lie on the ground itself
    void draw(uint32_t column, uint32_t row) override { painter_.draw(painter_.place(column, row), direction_); }

  private:
    TexelPainter<Brush>& painter_;
    uint32_t direction_;
};

}  // namespace overlook::wang_ldi
