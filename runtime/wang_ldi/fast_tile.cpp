#include "runtime/wang_ldi/fast_tile.h"

#include "runtime/wang_ldi/list_parts.h"

namespace overlook::wang_ldi {
namespace {

constexpr Thresholds kAll;

inline uint32_t all_bits(const Thresholds& by, uint32_t value) {
    return value - by.from < by.to - by.from ? ~0u : 0u;
}

bool is_whole(const Columns& columns) {
    return columns.by_rung == kAll && columns.by_direction == kAll;
}

}  // namespace

void TileFades::mask_rungs(const Columns& columns, uint32_t row, const Span& span, uint32_t* shown) {
    uint32_t side = columns.side_px, cells = coarser_px_;
    FadeRow fades(tile_, Decides::rungs, cell_of(row, side, cells));
    Thresholds by = columns.by_rung;
    if (side == cells) {
        for (uint32_t column = span.from; column < span.to; ++column) shown[column] = all_bits(by, fades.at(column));
        return;
    }
    if (cell_of_column_.size() != side || cells_ != cells) {
        cell_of_column_.resize(side), cells_ = cells;
        for (uint32_t column = 0; column < side; ++column) cell_of_column_[column] = cell_of(column, side, cells);
    }
    are_cells_shown_.resize(cells);
    uint32_t* of_cell = are_cells_shown_.data();
    const uint32_t* cell_of_column = cell_of_column_.data();
    uint32_t last = cell_of_column[span.to - 1];
    for (uint32_t cell = cell_of_column[span.from]; cell <= last; ++cell) of_cell[cell] = all_bits(by, fades.at(cell));
    for (uint32_t column = span.from; column < span.to; ++column) shown[column] = of_cell[cell_of_column[column]];
}

void TileFades::mask(const Columns& columns, uint32_t row, const Span& span, std::vector<uint32_t>& shown) {
    shown.resize(std::max(shown.size(), size_t(columns.side_px)));
    uint32_t* of_column = shown.data();
    bool has_rungs = !(columns.by_rung == kAll);
    if (has_rungs) mask_rungs(columns, row, span, of_column);
    if (columns.by_direction == kAll) return;
    FadeRow fades(tile_, Decides::directions, row);
    Thresholds by = columns.by_direction;
    if (!has_rungs) {
        for (uint32_t column = span.from; column < span.to; ++column) of_column[column] = all_bits(by, fades.at(column));
        return;
    }
    for (uint32_t column = span.from; column < span.to; ++column) of_column[column] &= all_bits(by, fades.at(column));
}

template <Hiding hiding>
void FastTile<hiding>::draw(const Item& item) {
    const Field& field = scene_.field;
    double side_m = field.parts().images->tile_m * double(int64_t(1) << item.tiles_log2);
    glm::dvec2 corner_m = field.parts().placement->rect_of(item.i, item.j).low_m;
    glm::dvec3 low_m(corner_m, item.low_m), high_m(corner_m + side_m, item.high_m + scene_.highest_step_m);
    double wide = scene_.eye.focal_px * widest_splat_m(field, scene_.list, item);
    if (!scene_.bounds.may_hold(low_m, high_m, wide)) return;
    glm::dvec2 eye_share = (glm::dvec2(scene_.eye.position_m) - corner_m) / side_m;
    if (item.half_count == 0) {
        if (far_ && item.texels_px > 0) far_->draw(item);
        return;
    }
    choose(item, corner_m);
    bool is_inside = scene_.bounds.holds_all(low_m, high_m, wide);
    for (FastColumns<hiding>& columns : images_) columns.is_inside = is_inside;
    for (const Half& half : scene_.list.halves_of(item)) draw_half(item, half, eye_share);
}

// What the item is painted from.
template <Hiding hiding>
void FastTile<hiding>::choose(const Item& item, const glm::dvec2& corner_m) {
    const Field& field = scene_.field;
    images_.clear(), textures_.clear(), all_.clear();
    if (far_) far_->begin(item);
    for (const Shown& shown : scene_.list.shown_of(item)) {
        const Rung& rung = field.ladder().rungs[shown.rung];
        if (rung.stage == Stage::ldi) {
            const PreparedLdi* ldi = scene_.image_at(field.image_of(item, shown));
            tools_.counts.images_missing += ldi == nullptr;
            if (ldi == nullptr) continue;
            SplatRule rule{1, field.options().widens_splats};
            all_.push_back(&images_.emplace_back(scene_.eye, *field.parts().images, *ldi, rung.level, rule, corner_m, tools_));
        } else if (rung.stage != Stage::geometry && far_ && hiding == Hiding::by_depth) {
            far_->draw_shown(shown);
            continue;
        } else if (rung.stage != Stage::geometry && far_) {
            all_.push_back(&textures_.emplace_back(*far_, far_->picture(shown)));
        } else {
            continue;
        }
        all_.back()->by_rung = shown.by_rung, all_.back()->by_direction = shown.by_direction;
    }
    bool is_mixed = false;
    for (const Columns* columns : all_) is_mixed |= !is_whole(*columns);
    if (is_mixed) fades_.begin(Field::fade_number(item.i, item.j), item.coarser_px);
}

template <Hiding hiding>
void FastTile<hiding>::draw_half(const Item& item, const Half& half, const glm::dvec2& eye_share) {
    for (Columns* columns : all_) columns->stand_on(half.plane);
    Piece piece{half.column, half.row, 1u << item.pieces_log2, false, half.half, half.diagonal};
    TilePlaces places{Field::fade_number(item.i, item.j), item.coarser_px, eye_share};
    if (hiding == Hiding::by_order && (all_.size() != 1 || images_.empty() || !is_whole(*all_[0])))
        return paint_piece(places, piece, all_);  // so that the order holds between images too
    for (FastColumns<hiding>& columns : images_) draw_rows(columns, piece, eye_share);
}

template <Hiding hiding>
void FastTile<hiding>::draw_rows(FastColumns<hiding>& columns, const Piece& piece, const glm::dvec2& eye_share) {
    uint32_t side = columns.side_px;
    Span rows = rows_of(piece, side);
    int64_t eye_row = cell_at(eye_share.y, side);
    bool all_shown = is_whole(columns);
    for (uint32_t j = 0; rows.from + j < rows.to; ++j) {
        uint32_t row = towards(j, eye_row, rows);
        Span span = columns_of(piece, row, side);
        if (span.is_empty() || !columns.may_show(row, span)) continue;
        if (!all_shown) fades_.mask(columns, row, span, tools_.shown);
        columns.draw_row(row, span, all_shown ? nullptr : tools_.shown.data());
    }
    columns.finish();
}

template class FastTile<Hiding::by_order>;
template class FastTile<Hiding::by_depth>;

}  // namespace overlook::wang_ldi
