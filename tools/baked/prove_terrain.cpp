#include "tools/baked/prove_terrain.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "formats/parallel.h"
#include "formats/terrain_check.h"
#include "formats/terrain_diamond.h"
#include "runtime/terrain/refine.h"

namespace overlook::terrain {
namespace {

constexpr double kRounding_m = 1e-7;
constexpr size_t kRowsAtATime = 8;

void prove_heights(const Terrain& terrain, const Source& source, Proof& proof) {
    for (uint32_t row = 0; row < source.height; ++row)
        for (uint32_t column = 0; column < source.width; ++column) {
            double there = source.at(column, row);
            bool is_void = terrain.is_void(column, row);
            proof.void_count += std::isnan(there);
            if (is_void != std::isnan(there)) {
                double infinite = std::numeric_limits<double>::infinity();
                proof.heights.add(
                    {column, row, infinite, terrain.finest_error_m, is_void ? "is stored as a void" : "is a void in the source"});
            } else if (!is_void) {
                double distance_m = std::abs(terrain.height_m(column, row) - there);
                proof.greatest_stored_m = std::max(proof.greatest_stored_m, distance_m);
                if (distance_m > terrain.finest_error_m + kRounding_m)
                    proof.heights.add({column, row, distance_m, terrain.finest_error_m, "is stored too far"});
            }
        }
    proof.sample_count = uint64_t(source.width) * source.height;
}

struct LevelProof {
    Places places;
    uint64_t triangle_count = 0, rated_count = 0;
    double tightness_sum = 0, tightest = 0;
};

void prove_triangle(const Terrain& terrain, const Source& source, const Triangle& t, uint8_t code, LevelProof& proof) {
    if (is_degenerate(terrain.shape, t)) return;
    ++proof.triangle_count;
    if (code == kMustSplit) return;
    RasterPoint corners[3];
    double heights_m[3];
    int k = 0;
    for (GridPoint p : {t.apex, t.left, t.right}) {
        GridPoint sample = sample_of(terrain.shape, p);
        corners[k] = {sample.x, sample.y};
        heights_m[k++] = terrain.height_m(sample.x, sample.y);
    }
    Place worst = triangle_deviation(source, corners, heights_m);
    worst.promised_m = terrain.error_m[code];
    if (worst.measured_m > worst.promised_m + kRounding_m) proof.places.add(worst);
    if (worst.promised_m <= 0) return;
    ++proof.rated_count;
    proof.tightness_sum += worst.measured_m / worst.promised_m;
    proof.tightest = std::max(proof.tightest, worst.measured_m / worst.promised_m);
}

void prove_level(const Terrain& terrain, const Source& source, uint32_t level, LevelProof& all) {
    LevelGrid grid = level_grid(terrain.shape, level);
    size_t ranges = (grid.rows + kRowsAtATime - 1) / kRowsAtATime;
    std::vector<LevelProof> parts(ranges);
    parallel_ranges(grid.rows, kRowsAtATime, [&](size_t begin, size_t end) {
        LevelProof& part = parts[begin / kRowsAtATime];
        for (uint32_t j = uint32_t(begin); j < end; ++j)
            for (uint32_t i = 0; i < grid.columns; ++i) {
                if (((i | j) & 1) == 0) continue;
                Triangle triangles[2];
                int count = triangles_of_diamond(terrain.shape, i << level, j << level, level, triangles);
                uint8_t code = terrain.codes[level][size_t(j) * grid.columns + i];
                for (int k = 0; k < count; ++k) prove_triangle(terrain, source, triangles[k], code, part);
            }
    });
    for (const LevelProof& part : parts) {
        all.places.join(part.places);
        all.triangle_count += part.triangle_count, all.rated_count += part.rated_count;
        all.tightness_sum += part.tightness_sum, all.tightest = std::max(all.tightest, part.tightest);
    }
}

}  // namespace

bool Proof::holds() const {
    bool cuts_are_sound = std::all_of(cuts.begin(), cuts.end(), [](const CutProof& cut) { return cut.report.is_sound(); });
    return heights.count() == 0 && triangles.count() == 0 && codes_above_parent == 0 && cuts_are_sound;
}

Source source_of(const dem::Raster& dem) {
    Source source{dem.width, dem.height, {}};
    source.heights_m.reserve(dem.samples.size());
    for (float sample : dem.samples) source.heights_m.push_back(dem.height_offset_m + dem.height_scale_m * double(sample));
    return source;
}

Proof prove(const Terrain& terrain, const Source& source, std::span<const double> tolerances_m,
            const std::function<void(double)>& progress) {
    Proof proof;
    prove_heights(terrain, source, proof);
    double steps = double(terrain.shape.root_log2) + 2 * double(tolerances_m.size()) + 1, done = 1;
    progress(done / steps);

    LevelProof hierarchy;
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        prove_level(terrain, source, level, hierarchy);
        progress(++done / steps);
    }
    proof.triangles = hierarchy.places;
    proof.triangle_count = hierarchy.triangle_count;
    proof.tightest = hierarchy.tightest;
    proof.mean_tightness = hierarchy.rated_count > 0 ? hierarchy.tightness_sum / double(hierarchy.rated_count) : 1;
    proof.codes_above_parent = find_code_above_parent(terrain) ? 1 : 0;

    Refiner refiner(terrain);
    Cut cut;
    for (double tolerance_m : tolerances_m) {
        refiner.cut_by_metres(tolerance_m, cut);
        proof.cuts.push_back({tolerance_m, cut.void_rim_triangle_count, check_cut(terrain, source, cut.indices, tolerance_m)});
        progress((done += 2) / steps);
    }
    return proof;
}

}  // namespace overlook::terrain
