#include "tools/bake/wang_ldi/point_spectrum.h"

#include <algorithm>

#include "tools/bake/wang_ldi/fourier.h"
#include "tools/bake/wang_ldi/free_area.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kCells = 2048;

}  // namespace

Points points_of(const Planting& planting, const Tiling& tiling) {
    uint32_t side = std::min(tiling.columns, tiling.rows);
    Points points{side * planting.tile_size_m, {}};
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x)
            for (const Planted& object : planting.tiles[tiling.at(x, y)])
                points.places_m.emplace_back(x * planting.tile_size_m + double(object.x_m),
                                             y * planting.tile_size_m + double(object.y_m));
    return points;
}

Points poisson_disk_points(double size_m, double radius_m, uint64_t seed) {
    Bounds all{0, 0, size_m, size_m};
    DiscGrid grid(all, radius_m);
    FreeArea area(std::span(&all, 1), radius_m, 1e-3 * radius_m);
    Random random(seed);
    Points points{size_m, {}};
    while (auto place = area.draw(grid, random)) {
        grid.add({place->x, place->y, radius_m});
        points.places_m.emplace_back(place->x, place->y);
    }
    return points;
}

PointSpectrum spectrum_of(const Points& points, double most_frequency, uint32_t rings) {
    std::vector<std::complex<double>> cells(size_t(kCells) * kCells);
    for (auto [x, y] : points.places_m) {
        auto cell = [&](double v) { return std::min(kCells - 1, uint32_t(v / points.size_m * kCells)); };
        cells[size_t(cell(y)) * kCells + cell(x)] += 1;
    }
    fourier_2d(cells, kCells);
    PointSpectrum spectrum;
    int most = std::min(int(most_frequency * points.size_m), int(kCells / 2 - 1));
    spectrum.side = uint32_t(2 * most + 1), spectrum.frequency_step = most / points.size_m / rings;
    spectrum.power.resize(size_t(spectrum.side) * spectrum.side);
    std::vector<double> sum(rings, 0), squares(rings, 0), count(rings, 0), greatest(rings, 0);
    for (int v = -most; v <= most; ++v)
        for (int u = -most; u <= most; ++u) {
            double power = std::norm(cells[size_t(v + int(kCells)) % kCells * kCells + size_t(u + int(kCells)) % kCells]) /
                           double(points.places_m.size());
            // The square's own sides make the axes' frequencies large; so near the middle they are left out with it.
            bool is_middle = std::abs(u) < 2 && std::abs(v) < 2;
            spectrum.power[size_t(v + most) * spectrum.side + size_t(u + most)] = is_middle ? 0 : power;
            auto ring = size_t(std::hypot(u, v) / most * rings);
            if (is_middle || ring >= rings) continue;
            sum[ring] += power, squares[ring] += power * power, ++count[ring];
            greatest[ring] = std::max(greatest[ring], power);
        }
    for (size_t r = 0; r < rings; ++r) {
        double mean = count[r] > 0 ? sum[r] / count[r] : 0,
               variance = count[r] > 1 ? (squares[r] - sum[r] * mean) / (count[r] - 1) : 0;
        spectrum.radial_power.push_back(mean);
        spectrum.anisotropy_db.push_back(mean > 0 && variance > 0 ? 10 * std::log10(variance / (mean * mean)) : 0);
        if (mean > 0) spectrum.greatest_peak = std::max(spectrum.greatest_peak, greatest[r] / mean);
    }
    return spectrum;
}

}  // namespace overlook::wang_ldi
