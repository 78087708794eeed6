// A tile's square cut in grids of different fineness, and which pixels of one lie in a cell, or half a cell, of another: by their
// middles and in whole numbers, so that every pixel lies in exactly one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "runtime/wang_ldi/ground.h"

namespace overlook::wang_ldi {

// Columns (or rows) from, up to but not to.
struct Span {
    uint32_t from = 0, to = 0;

    bool is_empty() const { return from >= to; }
};

// Of `cells` along a side of the tile the one that the middle of a pixel, of side_px, lies in.
inline uint32_t cell_of(uint32_t pixel, uint32_t side_px, uint32_t cells) {
    return side_px == cells ? pixel : uint32_t((uint64_t(2) * pixel + 1) * cells / (uint64_t(2) * side_px));
}
// The first pixel whose middle is at least `times` / `cells` through the tile's side.
inline uint32_t first_pixel(int64_t times, uint32_t cells, uint32_t side_px) {
    int64_t numerator = 2 * int64_t(side_px) * times - int64_t(cells);
    return numerator <= 0 ? 0 : uint32_t((numerator + 2 * int64_t(cells) - 1) / (2 * int64_t(cells)));
}
inline Span pixels_of(uint32_t cell, uint32_t cells, uint32_t side_px) {
    if (side_px == cells) return {cell, cell + 1};
    if (cells == 1) return {0, side_px};
    return {first_pixel(cell, cells, side_px), first_pixel(int64_t(cell) + 1, cells, side_px)};
}

// A square piece of a tile, or one of its two halves.
struct Piece {
    uint32_t column = 0, row = 0, pieces = 1;  // of so many along the tile's side
    bool is_whole = true;                      // else the half of the diagonal:
    uint32_t half = 0;
    Diagonal diagonal = Diagonal::rising;
};
inline Span rows_of(const Piece& piece, uint32_t side_px) {
    return pixels_of(piece.row, piece.pieces, side_px);
}
// The piece's columns in one of its rows.
inline Span columns_of(const Piece& piece, uint32_t row, uint32_t side_px) {
    Span all = pixels_of(piece.column, piece.pieces, side_px);
    if (piece.is_whole) return all;
    // Where half_of turns from 0 to 1, twice side_px times the pieces from the tile's west.
    int64_t across = 2 * int64_t(side_px), up = int64_t(2 * row + 1) * piece.pieces - across * piece.row;
    int64_t turn = across * piece.column + (piece.diagonal == Diagonal::rising ? up : across - up);
    int64_t twice = 2 * int64_t(piece.pieces), column = (turn - int64_t(piece.pieces) + twice - 1) / twice;
    auto east = uint32_t(std::clamp<int64_t>(column, all.from, all.to));
    return piece.half == 0 ? Span{all.from, east} : Span{east, all.to};
}

// The i-th of 0 .. count - 1 when those below `eye` come first, ascending, then those above it, descending, then it itself. A ray
// from within `eye` passes any two in this order turned round, so nothing hides what comes after it.
inline uint32_t towards(uint32_t i, int64_t eye, uint32_t count) {
    if (eye < 0) return count - 1 - i;
    if (eye >= int64_t(count) || int64_t(i) < eye) return i;
    return i < count - 1 ? count - 1 - (i - uint32_t(eye)) : uint32_t(eye);
}
inline uint32_t towards(uint32_t i, int64_t eye, const Span& span) {
    return span.from + towards(i, eye - int64_t(span.from), span.to - span.from);
}
// Which of `cells` along a tile's side a share of it lies in, before or behind all of them outside.
inline int64_t cell_at(double share, uint32_t cells) {
    return int64_t(std::clamp(std::floor(share * cells), -1.0, 1e9));
}

}  // namespace overlook::wang_ldi
