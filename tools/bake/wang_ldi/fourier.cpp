#include "tools/bake/wang_ldi/fourier.h"

#include <bit>
#include <cassert>
#include <numbers>
#include <utility>
#include <vector>

namespace overlook::wang_ldi {
namespace {

using Complex = std::complex<double>;

// turns[k] = exp(-2 pi i k / side)
void transform(Complex* row, size_t side, std::span<const Complex> turns) {
    for (size_t i = 1, j = 0; i < side; ++i) {
        size_t bit = side >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(row[i], row[j]);
    }
    for (size_t length = 2; length <= side; length *= 2)
        for (size_t begin = 0; begin < side; begin += length)
            for (size_t k = 0; k < length / 2; ++k) {
                Complex &a = row[begin + k], &b = row[begin + k + length / 2], turn = turns[k * (side / length)];
                Complex moved{b.real() * turn.real() - b.imag() * turn.imag(), b.real() * turn.imag() + b.imag() * turn.real()};
                b = a - moved, a = a + moved;
            }
}

}  // namespace

void fourier_2d(std::span<std::complex<double>> values, uint32_t side) {
    assert(std::has_single_bit(side) && values.size() == size_t(side) * side);
    std::vector<Complex> turns(side), column(side);
    for (size_t k = 0; k < side; ++k) turns[k] = std::polar(1.0, -2 * std::numbers::pi * double(k) / double(side));
    for (size_t y = 0; y < side; ++y) transform(&values[y * side], side, turns);
    for (size_t x = 0; x < side; ++x) {
        for (size_t y = 0; y < side; ++y) column[y] = values[y * side + x];
        transform(column.data(), side, turns);
        for (size_t y = 0; y < side; ++y) values[y * side + x] = column[y];
    }
}

}  // namespace overlook::wang_ldi
