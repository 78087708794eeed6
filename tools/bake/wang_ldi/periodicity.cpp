#include "tools/bake/wang_ldi/periodicity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>

#include "tools/bake/wang_ldi/fourier.h"

namespace overlook::wang_ldi {
namespace {

uint32_t count_same(const uint8_t* a, const uint8_t* b, size_t count) {
    uint32_t same = 0;
    for (size_t i = 0; i < count; ++i) same += a[i] == b[i];
    return same;
}

double share_of_same(const Tiling& tiling, int dx, int dy) {
    uint32_t across = uint32_t(std::abs(dx)), width = tiling.columns - across, height = tiling.rows - uint32_t(dy);
    const uint8_t* base = tiling.tiles.data() + (dx < 0 ? across : 0);
    const uint8_t* moved = tiling.tiles.data() + size_t(dy) * tiling.columns + (dx > 0 ? across : 0);
    uint64_t same = 0;
    for (size_t y = 0; y < height; ++y) same += count_same(base + y * tiling.columns, moved + y * tiling.columns, width);
    return double(same) / (double(width) * height);
}

}  // namespace

Correlation greatest_correlation(const Tiling& tiling, int least, int most) {
    assert(tiling.columns > uint32_t(most) && tiling.rows > uint32_t(most));
    std::array<uint64_t, 256> count{};
    for (uint8_t tile : tiling.tiles) ++count[tile];
    double by_chance = 0;
    for (uint64_t of_tile : count) by_chance += std::pow(double(of_tile) / double(tiling.tiles.size()), 2);
    Correlation greatest;
    if (by_chance == 1) return {least, 0, 1};  // one tile only: it is its own neighbour everywhere
    for (int dy = 0; dy <= most; ++dy)
        for (int dx = -most; dx <= most; ++dx) {
            if (std::max(std::abs(dx), dy) < least || (dy == 0 && dx < 0)) continue;
            double value = (share_of_same(tiling, dx, dy) - by_chance) / (1 - by_chance);
            if (std::abs(value) > std::abs(greatest.value)) greatest = {dx, dy, value};
        }
    return greatest;
}

Spectrum spectrum_of(const Tiling& tiling, size_t tile_count, uint32_t side) {
    assert(side <= tiling.columns && side <= tiling.rows);
    Spectrum spectrum{side, std::vector<double>(size_t(side) * side, 0.0)};
    std::vector<std::complex<double>> values(spectrum.power.size());
    for (size_t tile = 0; tile < tile_count; ++tile) {
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x) values[size_t(y) * side + x] = tiling.at(x, y) == tile ? 1.0 : 0.0;
        fourier_2d(values, side);
        for (size_t i = 0; i < values.size(); ++i) spectrum.power[i] += std::norm(values[i]);
    }
    spectrum.power[0] = 0;
    double sum = 0;
    for (double power : spectrum.power) sum += power;
    double mean = sum / double(spectrum.power.size() - 1);
    if (mean > 0)
        for (double& power : spectrum.power) power /= mean;
    return spectrum;
}

SpectrumShape shape_of(const Spectrum& spectrum) {
    std::vector<double> sorted = spectrum.power;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    double sum = 0, top = 0;
    for (size_t i = 0; i < sorted.size(); ++i) {
        sum += sorted[i];
        if (i < sorted.size() / 100) top += sorted[i];
    }
    return {sorted.front(), sum > 0 ? top / sum : 1.0};
}

}  // namespace overlook::wang_ldi
