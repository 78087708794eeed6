// What bake-wang-ldi --json said of a bake.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook::measure::paper::wang {

// What --judge said: pictures of images, warped, beside what rays see.
struct Judged {
    double hole_share = 0;         // nothing is drawn
    double filled_hole_share = 0;  // nor after small holes were filled
    double deeper_share = 0;       // something too deep is
    double e_mean = 0, e_p99 = 0;  // LDR-FLIP, filled
    double unfilled_e_mean = 0;
    // Pixels that show something, of those where rays do; none of reports that do not say it.
    std::optional<double> covered_times{}, filled_covered_times{};
};

struct LevelReport {
    uint32_t side_px = 0;
    double nearest_m = 0;
    uint64_t images = 0, samples = 0, bytes = 0, rays = 0;
    double unseen_share_mean = 0;
    std::optional<Judged> own, foreign;  // among the neighbours that the tiles were sampled among, and among others
};

struct ImagesReport {
    LevelReport all;  // side and distance of the finest
    double unseen_share_most = 0;
    uint32_t directions = 0;
    double seconds = 0;
    uint64_t taken_from_parts = 0;  // images that this bake found done
    std::vector<LevelReport> levels;
};

struct BakeReport {
    // Tiles and what repeats.
    uint32_t tiles = 0;
    double correlation = 0;  // greatest over lags 2 to 10
    double spectrum_share = 0;
    bool avoids_equal_neighbours = false;
    uint64_t equal_neighbours = 0, disagreeing_neighbours = 0;
    // Planting.
    std::string method;  // "paper", "corners"
    double tile_size_m = 0;
    uint64_t objects = 0, neighbourhoods = 0, tight_overlaps = 0, tiles_with_a_place = 0;
    double density_corner = 0, density_edge = 0, density_inside = 0;  // over the mean
    double relative_radius = 0, more_per_tile = 0;
    double distance_step_m = 0;
    std::vector<double> density_by_corner_distance, density_by_edge_distance;
    std::optional<ImagesReport> images;
};

// Fails as MappedFile::open, and with Exit::bad_input: "sunflowers/paper.json: is not what bake-wang-ldi --json says: ..."
Result<BakeReport> read_report(const std::string& path);

}  // namespace overlook::measure::paper::wang
