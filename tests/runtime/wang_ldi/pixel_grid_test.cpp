// Pieces of a tile and halves of pieces hold every pixel of an image once, whatever its side; so do coarse cells.
#include "runtime/wang_ldi/pixel_grid.h"

#include <gtest/gtest.h>

#include <vector>

namespace overlook::wang_ldi {
namespace {

const std::vector<uint32_t> kSides{1, 2, 3, 7, 16, 31, 62, 73, 151, 468};

TEST(PixelGrid, EveryPixelLiesInOneHalfOfOnePieceAndThereWhereItsMiddleLies) {
    for (uint32_t side : kSides)
        for (uint32_t pieces : {1u, 2u, 4u, 16u})
            for (Diagonal diagonal : {Diagonal::rising, Diagonal::falling}) {
                std::vector<int> held(size_t(side) * side);
                for (uint32_t n = 0; n < 2 * pieces * pieces; ++n) {
                    Piece piece{n / 2 % pieces, n / 2 / pieces, pieces, false, n % 2, diagonal};
                    Span rows = rows_of(piece, side);
                    for (uint32_t row = rows.from; row < rows.to; ++row) {
                        Span columns = columns_of(piece, row, side);
                        for (uint32_t column = columns.from; column < columns.to; ++column) {
                            ++held[size_t(row) * side + column];
                            double x = (column + 0.5) / side * pieces - piece.column, y = (row + 0.5) / side * pieces - piece.row;
                            ASSERT_TRUE(x > -1e-9 && x < 1 + 1e-9 && y > -1e-9 && y < 1 + 1e-9);
                            bool is_between = std::abs(diagonal == Diagonal::rising ? x - y : x + y - 1) < 1e-9;
                            ASSERT_TRUE(is_between || half_of(diagonal, x, y) == piece.half)
                                << side << " " << column << " " << row;
                        }
                    }
                }
                for (int times : held) ASSERT_EQ(times, 1) << side << " pixels, " << pieces << " pieces";
            }
}

TEST(PixelGrid, CellsAndPixelsAgreeOnWhichHoldsWhich) {
    for (uint32_t side : kSides)
        for (uint32_t cells : kSides) {
            uint32_t next = 0;
            for (uint32_t cell = 0; cell < cells; ++cell) {
                Span pixels = pixels_of(cell, cells, side);
                ASSERT_EQ(pixels.from, next);
                for (next = pixels.from; next < pixels.to; ++next) ASSERT_EQ(cell_of(next, side, cells), cell);
            }
            ASSERT_EQ(next, side);
        }
}

// Whatever lies between two pixels of a line and the eye is drawn after what lies behind it.
TEST(PixelGrid, TowardsTheEyeEveryPixelComesOnceAndNoneBeforeWhatIsBehindIt) {
    for (uint32_t count : {1u, 2u, 5u, 9u})
        for (int64_t eye = -2; eye < int64_t(count) + 2; ++eye) {
            std::vector<int64_t> order;
            for (uint32_t i = 0; i < count; ++i) order.push_back(towards(i, eye, count));
            std::vector<bool> seen(count);
            for (size_t i = 0; i < count; ++i) {
                ASSERT_FALSE(seen[size_t(order[i])]);
                seen[size_t(order[i])] = true;
                for (size_t later = i + 1; later < count; ++later) {
                    bool is_same_side = (order[i] - eye) * (order[later] - eye) > 0;
                    if (is_same_side || order[i] == eye) {
                        ASSERT_LT(std::abs(order[later] - eye), std::abs(order[i] - eye));
                    }
                }
            }
        }
}

}  // namespace
}  // namespace overlook::wang_ldi
