#include "runtime/wang_ldi/tile_painter.h"

#include <limits>

namespace overlook::wang_ldi {
namespace {

constexpr Thresholds kAll;

// The piece's pixels in one coarse cell, towards the eye, from columns of one grid.
void paint_cell(const TilePlaces& places, const Piece& piece, uint32_t cell_column, uint32_t cell_row,
                std::span<Columns* const> alike) {
    uint32_t side = alike[0]->side_px;
    Span cell = pixels_of(cell_column, places.coarser_px, side), rows = pixels_of(cell_row, places.coarser_px, side);
    Span piece_rows = rows_of(piece, side);
    rows = {std::max(rows.from, piece_rows.from), std::min(rows.to, piece_rows.to)};
    if (rows.is_empty()) return;
    int64_t eye_column = cell_at(places.eye_share.x, side), eye_row = cell_at(places.eye_share.y, side);
    for (uint32_t j = 0; j < rows.to - rows.from; ++j) {
        uint32_t row = towards(j, eye_row, rows);
        Span span = columns_of(piece, row, side);
        span = {std::max(span.from, cell.from), std::min(span.to, cell.to)};
        for (uint32_t i = 0; span.from + i < span.to; ++i) {
            uint32_t column = towards(i, eye_column, span), decides = direction_threshold(places.fade_number, column, row);
            for (Columns* shown : alike)
                if (shown->by_direction.contains(decides)) shown->draw(column, row);
        }
    }
}

// How many from the first on have the same grid and are shown in the same cells.
size_t alike(std::span<Columns* const> all) {
    size_t count = 1;
    while (count < all.size() && all[count]->side_px == all[0]->side_px && all[count]->by_rung == all[0]->by_rung) ++count;
    return count;
}

// The coarse cells that hold pixels of a piece, along one side of the tile.
Span cells_of(uint32_t piece, uint32_t pieces, uint32_t cells, std::span<Columns* const> all) {
    Span found{std::numeric_limits<uint32_t>::max(), 0};
    for (const Columns* columns : all) {
        Span pixels = pixels_of(piece, pieces, columns->side_px);
        if (pixels.is_empty()) continue;
        found.from = std::min(found.from, cell_of(pixels.from, columns->side_px, cells));
        found.to = std::max(found.to, cell_of(pixels.to - 1, columns->side_px, cells) + 1);
    }
    return found;
}

// One image that is shown wherever there is something: its pixels row by row.
void paint_alone(const TilePlaces& places, const Piece& piece, Columns& columns) {
    uint32_t side = columns.side_px;
    Span rows = rows_of(piece, side);
    int64_t eye_column = cell_at(places.eye_share.x, side), eye_row = cell_at(places.eye_share.y, side);
    for (uint32_t j = 0; rows.from + j < rows.to; ++j) {
        uint32_t row = towards(j, eye_row, rows);
        Span span = columns_of(piece, row, side);
        for (uint32_t i = 0; span.from + i < span.to; ++i) columns.draw(towards(i, eye_column, span), row);
    }
}

}  // namespace

void paint_piece(const TilePlaces& places, const Piece& piece, std::span<Columns* const> all) {
    if (all.size() == 1 && all[0]->by_rung == kAll && all[0]->by_direction == kAll) return paint_alone(places, piece, *all[0]);
    uint32_t cells = places.coarser_px;
    Span rows = cells_of(piece.row, piece.pieces, cells, all), columns = cells_of(piece.column, piece.pieces, cells, all);
    if (rows.is_empty() || columns.is_empty()) return;
    int64_t eye_column = cell_at(places.eye_share.x, cells), eye_row = cell_at(places.eye_share.y, cells);
    for (uint32_t j = 0; j < rows.to - rows.from; ++j)
        for (uint32_t i = 0, row = towards(j, eye_row, rows); i < columns.to - columns.from; ++i) {
            uint32_t column = towards(i, eye_column, columns);
            uint32_t decides = rung_threshold(places.fade_number, column, row, cells, cells);
            for (auto rest = all; !rest.empty(); rest = rest.subspan(alike(rest)))
                if (rest[0]->by_rung.contains(decides)) paint_cell(places, piece, column, row, rest.first(alike(rest)));
        }
}

}  // namespace overlook::wang_ldi
