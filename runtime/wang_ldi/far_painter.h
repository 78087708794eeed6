// Tiles so far away that they are drawn by points laid over the ground: single ones, and blocks of them whose places are asked
// for one by one, each as if it were listed by itself.
#pragma once

#include <cmath>
#include <utility>

#include "runtime/wang_ldi/far_view.h"
#include "runtime/wang_ldi/field_walk.h"
#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {

template <class Brush>
class FarPainter {
  public:
    // All must outlive this.
    FarPainter(const Eye& eye, const PictureBounds& bounds, const Field& field, const FieldList& list, const FarImages& far,
               Brush& brush)
        : eye_(eye),
          view_(eye, bounds, field),
          field_(field),
          list_(list),
          parts_(field.parts()),
          ground_(parts_.placement->ground()),
          far_(far),
          brush_(brush),
          tile_m_(parts_.images->tile_m) {}

    // An item that shows nothing but textures and colours, from back to front.
    void draw(const Item& item) {
        begin(item);
        const std::vector<Rung>& rungs = field_.ladder().rungs;
        coarsest_log2_ = 0, widest_m_ = 1.5 * tile_m_;
        if (item.tiles_log2 > 0 && rungs[item.last_rung].stage == Stage::colour) coarsest_log2_ = rungs[item.last_rung].level;
        widest_m_ = std::ldexp(widest_m_, int(coarsest_log2_));
        FarBlock block;
        block.is_planted = item.is_planted_throughout;
        visit(item.i, item.j, item.tiles_log2, block);
    }

    // For drawing a tile texel by texel, beside images of it.
    void begin(const Item& item) { item_ = &item; }
    const FarPicture& picture(const Shown& shown) const {
        return far_.picture(item_->context, item_->tile, shown.direction,
                            field_.texture_level(field_.ladder().rungs[shown.rung]));
    }
    FarPlace place() const { return view_.place_of(item_->i, item_->j, 0); }
    double share_of(const FarPicture& picture, const FarPlace& place) const {
        return view_.share_of(picture, place, view_.rise_at(place));
    }
    void draw_texel(const FarPicture& picture, const FarPlace& place, double share, uint32_t column, uint32_t row) {
        size_t texel = size_t(row) * picture.side_px + column;
        draw_samples(picture, place, picture.first[texel], picture.first[texel + 1], share);
    }
    // All of its texels that the tile's places show.
    void draw_shown(const Shown& shown) {
        const FarPicture& one = picture(shown);
        FarPlace place = this->place();
        Fades fades{Field::fade_number(item_->i, item_->j), item_->coarser_px, shown.by_rung, shown.by_direction};
        draw_picture(one, place, share_of(one, place), fades);
    }

  private:
    static constexpr uint32_t kLooked_log2 = 2;  // before a square is looked at, the texels in it are asked if they draw anything

    // A square of tiles: as one texel, or in strips, or its quarters, as the rung of its middle says and how flat it looks.
    // block: of a square that it is part of.
    void visit(int64_t i, int64_t j, uint32_t log2, FarBlock block) {
        if (log2 == 0) return draw_tile(i, j, 0, block);
        if (block.is_of_one && block.tiles_log2 > 0 && log2 <= block.tiles_log2 + kLooked_log2) {
            if (log2 == block.tiles_log2) return void(draw_square({i, j, log2}, block));
            if (!may_draw(i, j, log2, block)) return;
        }
        Rect rect = parts_.placement->rect_of(i, j, int64_t(1) << log2);
        GroundRange range = ground_.bound(rect);
        if (!block.is_planted) {
            Placement::Coverage coverage = parts_.placement->coverage(rect, range);
            if (coverage == Placement::Coverage::none) return;
            block.is_planted = coverage == Placement::Coverage::all;
        }
        if (log2 < item_->tiles_log2) {  // the item itself was asked about as it was listed
            if (range.is_empty() || !view_.may_be_seen(rect, range, widest_m_)) return;
            if (field_.is_hidden(list_, rect, range.high_m, widest_m_)) return;
        }
        if (!block.is_of_one || log2 > block.tiles_log2 + 1) block = view_.looked_closer(block, rect, range, far_);
        block.is_of_one &= log2 >= block.tiles_log2;  // a field may list squares that are smaller than texels
        if (log2 <= coarsest_log2_ && !(block.is_of_one && log2 > block.tiles_log2) && draw_square({i, j, log2}, block)) return;
        if (view_.is_flat(rect, range) && draw_strips(i, j, log2, block)) return;
        int64_t half = int64_t(1) << (log2 - 1);
        glm::dvec2 middle = parts_.placement->rect_of(i + half, j + half).low_m;
        for (auto [x, y] : quarters_towards(glm::dvec2(eye_.position_m), middle))
            visit(i + x * half, j + y * half, log2 - 1, block);
    }
    // Whether some square of a texel's size may draw a point, of a block of colours of one such size.
    static bool may_draw(int64_t i, int64_t j, uint32_t log2, const FarBlock& block) {
        int64_t side = int64_t(1) << (log2 - block.tiles_log2), column = i >> block.tiles_log2, row = j >> block.tiles_log2;
        for (int64_t y = row; y < row + side; ++y)
            for (int64_t x = column; x < column + side; ++x)
                if (double(spread_at(x, y)) < block.share_most) return true;
        return false;
    }

    // The level of a rung in tiles along a texel's side (their logarithm); of what is bare as of the coarsest.
    uint32_t log2_of(const Rung& rung) const {
        if (rung.stage == Stage::bare) return coarsest_log2_;
        return rung.stage == Stage::colour ? rung.level : 0;
    }
    // 2^log2 tiles along each side, from (i, j) on.
    struct Square {
        int64_t i = 0, j = 0;
        uint32_t log2 = 0;

        uint64_t number() const { return hash_of(log2, 0x6661, i >> log2, j >> log2); }
        double spread() const { return double(spread_at(i >> log2, j >> log2)); }
    };
    // Whether the square is shown as one texel (or not at all).
    bool draw_square(const Square& square, const FarBlock& block) {
        if (block.is_of_one && square.spread() >= block.square_share_most) return true;
        FarPlace place = view_.place_of(square.i, square.j, square.log2);
        if (std::isnan(place.ground_m)) return false;
        Chosen chosen = view_.chosen_at(place, block);
        uint64_t number = square.number();
        const Rung& rung = field_.ladder().rungs[rung_of(chosen, uint32_t(mixed(number) >> 56))];
        if (log2_of(rung) < square.log2) return false;
        if (rung.stage != Stage::bare) draw_mean(square, place, direction_of(chosen, uint32_t(number >> 56)), square.log2, block);
        return true;
    }
    // The quarter that a strip goes through, `side` of its two halves across, and in which of the others its one place lies.
    static Square within(const Square& square, uint32_t side, bool is_along_y) {
        uint32_t log2 = square.log2 - 1, along = uint32_t(mixed(square.number()) >> 63);
        int64_t x = is_along_y ? side : along, y = is_along_y ? along : side;
        return {square.i + x * (int64_t(1) << log2), square.j + y * (int64_t(1) << log2), log2};
    }

    // A square so flat that its rows fall on each other: of each strip of texels across it one, as opaque as all of them. False
    // if texels are as wide as it is.
    bool draw_strips(int64_t i, int64_t j, uint32_t log2, const FarBlock& block) {
        FarPlace place = view_.place_of(i, j, log2);
        Chosen chosen = view_.chosen_at(place, block);
        const std::vector<Rung>& rungs = field_.ladder().rungs;
        if (std::isnan(place.ground_m) || rungs[chosen.rungs.second].stage == Stage::bare) return false;
        uint32_t coarser = log2_of(rungs[chosen.rungs.second]), finer = log2_of(rungs[chosen.rungs.first]);
        if (coarser >= log2) return false;
        glm::dvec2 away = glm::abs(place.middle_m - glm::dvec2(eye_.position_m));
        bool is_along_y = away.y > away.x;
        for (uint32_t strip = 0; strip < 1u << (log2 - coarser); ++strip) {
            Square square{i, j, log2};
            while (square.log2 > coarser) square = within(square, strip >> (square.log2 - 1 - coarser) & 1, is_along_y);
            bool is_coarser = coarser == finer || !first_of(chosen.rungs).contains(uint32_t(mixed(square.number()) >> 56));
            if (is_coarser) {
                draw_strip(square, log2, block);
            } else {
                for (uint32_t side : {0, 1}) draw_strip(within(square, side, is_along_y), log2, block);
            }
        }
        return true;
    }
    void draw_strip(const Square& square, uint32_t rows_log2, const FarBlock& block) {
        if (square.log2 == 0) return draw_tile(square.i, square.j, rows_log2, block);
        FarPlace place = view_.place_of(square.i, square.j, square.log2);
        if (std::isnan(place.ground_m)) return;
        draw_mean(square, place, direction_of(view_.chosen_at(place, block), uint32_t(square.number() >> 56)), rows_log2, block);
    }
    static uint32_t rung_of(const Chosen& chosen, uint32_t decides) {
        return first_of(chosen.rungs).contains(decides) ? chosen.rungs.first : chosen.rungs.second;
    }
    static uint32_t direction_of(const Chosen& chosen, uint32_t decides) {
        return first_of(chosen.directions).contains(decides) ? chosen.directions.first : chosen.directions.second;
    }

    // As one of its tiles, as opaque as 2^rows_log2 of them behind each other.
    void draw_mean(const Square& square, const FarPlace& place, uint32_t direction, uint32_t rows_log2, const FarBlock& block) {
        double wide_m = place.side_m * far_.breadth(direction), spread = square.spread();
        double shrunk = view_.shrunk(wide_m, place), deep_m = std::ldexp(tile_m_, int(rows_log2));
        if (spread >= shrunk) return;
        double rising_m = kOverlap * deep_m * view_.rise_at(place);
        auto share_of = [&](float opacity, float half_m) {
            double high_m = 2 * double(half_m) + rising_m;
            return behind_each_other(double(opacity), rows_log2) * std::min(1.0, high_m / wide_m) * shrunk;
        };
        if (spread >= share_of(1, far_.most_half_m())) return;  // of whichever tile
        uint64_t number = square.number();
        int64_t x = square.i + int64_t(below(number, 1u << square.log2)),
                y = square.j + int64_t(below(mixed(number), 1u << square.log2));
        if (!is_planted(x, y, block)) return;
        const FarMean& mean = far_.mean(0, parts_.tiling->at(x, y), direction);
        if (mean.colour == 0 || spread >= share_of(mean.opacity, mean.half_m)) return;
        put({place.middle_m, place.ground_m + double(mean.middle_m)}, wide_m, mean.colour);
    }
    bool is_planted(int64_t i, int64_t j, const FarBlock& block) const {
        return block.is_planted || parts_.placement->is_planted(i, j);
    }

    // Of a tile by itself, or in place of 2^rows_log2, of which then the block's shares say nothing.
    void draw_tile(int64_t i, int64_t j, uint32_t rows_log2, const FarBlock& block) {
        if (!is_planted(i, j, block)) return;
        uint32_t tile = item_->tiles_log2 == 0 ? item_->tile : parts_.tiling->at(i, j);
        if (block.is_of_one && block.tiles_log2 == 0 && rows_log2 == 0 &&
            double(far_.least_need(tile, field_.texture_level(field_.ladder().rungs[block.rung]))) >= block.share_most)
            return;
        FarPlace place = view_.place_of(i, j, 0);
        if (std::isnan(place.ground_m)) return;
        Chosen chosen = view_.chosen_at(place, block);
        double rise = view_.rise_at(place);
        uint32_t context = context_of(i, j);
        for (auto [rung, by_rung] :
             {std::pair(chosen.rungs.first, first_of(chosen.rungs)), {chosen.rungs.second, second_of(chosen.rungs)}}) {
            if (by_rung.share() == 0) continue;
            draw_rung({i, j, tile, context, rows_log2, rise}, place, chosen, rung, by_rung);
        }
    }
    struct OneTile {
        int64_t i, j;
        uint32_t tile, context, rows_log2;
        double rise;  // as FarView::rise_at
    };
    void draw_rung(const OneTile& one, const FarPlace& place, const Chosen& chosen, uint32_t rung, const Thresholds& by_rung) {
        const std::vector<Rung>& rungs = field_.ladder().rungs;
        Stage stage = rungs[rung].stage;
        if (stage != Stage::texture && stage != Stage::colour) return;
        auto side_of = [&](uint32_t r) { return uint32_t(std::max(1.0, field_.texels_of(rungs[r]))); };
        uint32_t coarser_px = side_of(rungs[chosen.rungs.second].stage == Stage::bare ? chosen.rungs.first : chosen.rungs.second);
        for (auto [direction, by_direction] : {std::pair(chosen.directions.first, first_of(chosen.directions)),
                                               {chosen.directions.second, second_of(chosen.directions)}}) {
            if (by_direction.share() == 0) continue;
            const FarPicture& picture = far_.picture(one.context, one.tile, direction, field_.texture_level(rungs[rung]));
            double share = view_.share_of(picture, place, one.rise),
                   opacity = double(far_.mean(one.context, one.tile, direction).opacity);
            if (one.rows_log2 > 0 && opacity > 0)
                share *= std::min(kMostRows, behind_each_other(opacity, one.rows_log2) / opacity);
            draw_picture(picture, place, share, {Field::fade_number(one.i, one.j), coarser_px, by_rung, by_direction});
        }
    }

    // As the field lists it for a tile by itself.
    uint32_t context_of(int64_t i, int64_t j) const {
        if (item_->tiles_log2 == 0 || parts_.images->context_count < 2) return item_->context;
        int64_t last = (int64_t(1) << item_->tiles_log2) - 1, x = i - item_->i, y = j - item_->j;
        bool is_inside = item_->is_planted_throughout && std::min(x, y) > 0 && std::max(x, y) < last;
        return !is_inside && parts_.placement->is_at_edge(i, j);
    }

    // Those points that thresholds let be seen, in the order of texels towards the eye.
    struct Fades {
        uint64_t number;
        uint32_t coarser_px;
        Thresholds by_rung, by_direction;
    };
    void draw_picture(const FarPicture& picture, const FarPlace& place, double share, const Fades& fades);

    void draw_samples(const FarPicture& picture, const FarPlace& place, uint32_t from, uint32_t to, double share) {
        for (uint32_t s = from; s < to; ++s)
            if (double(picture.samples[s].needs) < share) draw_sample(picture, place, picture.samples[s]);
    }
    void draw_sample(const FarPicture& picture, const FarPlace& place, const FarSample& sample) {
        glm::dvec2 at_m = place.low_m + glm::dvec2(sample.x_m, sample.y_m);
        double ground_m = ground_.height_m(at_m, asked_);
        if (!std::isnan(ground_m)) put({at_m, ground_m + double(sample.height_m)}, double(picture.wide_m), sample.colour);
    }
    void put(const glm::dvec3& at_m, double wide_m, uint32_t colour) {
        brush_.splat(eye_.seen(at_m - eye_.position_m), float(eye_.focal_px * wide_m), colour);
    }

    const Eye& eye_;
    FarView view_;
    const Field& field_;
    const FieldList& list_;
    const FieldParts parts_;
    const Ground& ground_;
    const FarImages& far_;
    Brush& brush_;
    double tile_m_;
    Ground::Asked asked_;
    const Item* item_ = nullptr;
    uint32_t coarsest_log2_ = 0;
    double widest_m_ = 0;
};

template <class Brush>
void FarPainter<Brush>::draw_picture(const FarPicture& picture, const FarPlace& place, double share, const Fades& fades) {
    uint32_t side = picture.side_px;
    auto is_shown = [&](uint32_t column, uint32_t row) {
        const auto& [number, coarser_px, by_rung, by_direction] = fades;
        if (by_rung.share() < kWhole && !by_rung.contains(rung_threshold(number, column, row, side, coarser_px))) return false;
        return by_direction.share() == kWhole || by_direction.contains(direction_threshold(number, column, row));
    };
    if (Brush::kIsByDepth) {
        for (const FarSample& sample : picture.by_need) {
            if (!(double(sample.needs) < share)) return;
            if (is_shown(sample.column, sample.row)) draw_sample(picture, place, sample);
        }
        return;
    }
    glm::dvec2 eye = (glm::dvec2(eye_.position_m) - place.low_m) / place.side_m;
    int64_t eye_column = cell_at(eye.x, side), eye_row = cell_at(eye.y, side);
    for (uint32_t j = 0; j < side; ++j)
        for (uint32_t i = 0, row = towards(j, eye_row, side); i < side; ++i) {
            uint32_t column = towards(i, eye_column, side);
            size_t texel = size_t(row) * side + column;
            if (picture.first[texel] == picture.first[texel + 1] || !is_shown(column, row)) continue;
            draw_samples(picture, place, picture.first[texel], picture.first[texel + 1], share);
        }
}

// The texels of a tile that images of it give way to.
template <class Brush>
class FarColumns final : public Columns {
  public:
    // Of the item that the painter has begun.
    FarColumns(FarPainter<Brush>& painter, const FarPicture& picture)
        : painter_(painter), picture_(picture), place_(painter.place()), share_(painter.share_of(picture, place_)) {
        side_px = picture.side_px;
    }
    void stand_on(const Plane&) override {}  // texels lie on the ground itself
    void draw(uint32_t column, uint32_t row) override { painter_.draw_texel(picture_, place_, share_, column, row); }

  private:
    FarPainter<Brush>& painter_;
    const FarPicture& picture_;
    FarPlace place_;
    double share_;
};

}  // namespace overlook::wang_ldi
