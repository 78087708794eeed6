#include <algorithm>
#include <array>
#include <cmath>

#include "tools/make_sample/ground_regions.h"
#include "tools/make_sample/ground_textures.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_terrains.h"
#include "tools/make_sample/terrain_surfaces.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kColumns = kCliff.columns, kRows = kCliff.rows;
constexpr uint32_t kRimRow = 106, kWallRows = 4;  // cells from the rim to the foot
constexpr uint32_t kLeastRegion = 80;             // faces
constexpr double kMeetingRadius = 4;              // cells

enum Surface : uint32_t { kMeadow, kForest, kRock, kScree, kFields };
constexpr std::array<GroundKind, 5> kKinds = {GroundKind::meadow, GroundKind::forest, GroundKind::rock, GroundKind::scree,
                                              GroundKind::fields};

double km_noise(uint64_t seed, double x_m, double y_m, double feature_m, int octaves) {
    return fractal_noise(seed, x_m / feature_m + 0.37, y_m / feature_m + 0.61, octaves);
}

// Metres south of the northern border; the cliff winds from the western border to the eastern one.
double rim_south_m(uint64_t seed, double x_m) {
    return 0.45 * kCliff.height_m + 9000 * km_noise(seed + 1, x_m, 0, 24'000, 1) + 2600 * km_noise(seed + 2, x_m, 0, 7'000, 2) +
           260 * km_noise(seed + 3, x_m, 0, 1'500, 2);
}

double wall_width_m(uint64_t seed, double x_m) {
    return 260 + 130 * km_noise(seed + 4, x_m, 0, 1'700, 2);
}

double high_ground_m(uint64_t seed, double x_m, double south_m) {
    double hills = ridged_noise(seed + 10, x_m / 17'000, south_m / 17'000, 5);
    return 1480 + 420 * smooth_step(0, 20'000, rim_south_m(seed, x_m) - south_m) * hills +
           70 * km_noise(seed + 11, x_m, south_m, 4'000, 4);
}

double low_ground_m(uint64_t seed, double x_m, double south_m) {
    double from_foot_m = south_m - rim_south_m(seed, x_m) - wall_width_m(seed, x_m);
    double hills = 210 * km_noise(seed + 20, x_m, south_m, 11'000, 5) * smooth_step(0, 9'000, from_foot_m);
    double fan = 1 - smooth_step(0, 2'600 + 1'200 * km_noise(seed + 21, x_m, 0, 2'600, 2), from_foot_m);
    return 260 + hills + 260 * fan * fan;
}

// Where row `row` of the grid lies in a column: evenly spaced above the rim and below the foot, in ledges between.
double south_of_row_m(uint64_t seed, double x_m, uint32_t row) {
    constexpr std::array<double, kWallRows + 1> kShare = {0, 0.10, 0.34, 0.52, 1};
    double rim_m = rim_south_m(seed, x_m), width_m = wall_width_m(seed, x_m), foot_m = rim_m + width_m;
    if (row <= kRimRow) return rim_m * row / kRimRow;
    if (row >= kRimRow + kWallRows)
        return foot_m + (kCliff.height_m - foot_m) * (row - kRimRow - kWallRows) / (kRows - 1 - kRimRow - kWallRows);
    return rim_m + width_m * (kShare[row - kRimRow] + 0.06 * km_noise(seed + 5 + row, x_m, 0, 900, 1));
}

MeshGrid make_grid(uint64_t seed) {
    constexpr std::array<double, kWallRows + 1> kFallen = {0, 0.38, 0.50, 0.86, 1};
    MeshGrid grid{kColumns, kRows, {}};
    for (uint32_t row = 0; row < kRows; ++row)
        for (uint32_t column = 0; column < kColumns; ++column) {
            double x_m = kCliff.width_m * column / (kColumns - 1), south_m = south_of_row_m(seed, x_m, row);
            double z_m = row <= kRimRow ? high_ground_m(seed, x_m, south_m) : low_ground_m(seed, x_m, south_m);
            if (row > kRimRow && row < kRimRow + kWallRows) {
                double rim_m = high_ground_m(seed, x_m, rim_south_m(seed, x_m));
                double foot_m = low_ground_m(seed, x_m, rim_south_m(seed, x_m) + wall_width_m(seed, x_m));
                double fallen = kFallen[row - kRimRow] + 0.05 * km_noise(seed + 9 + row, x_m, 0, 2'100, 2);
                z_m = rim_m + fallen * (foot_m - rim_m);
            }
            grid.positions_m.emplace_back(x_m, -south_m, z_m);
        }
    return grid;
}

uint32_t surface_of(const MeshGrid& grid, uint32_t face, double wood_m, uint64_t seed) {
    uint32_t row = face / 2 / (kColumns - 1);
    glm::dvec3 centre = grid.centre_m(face);
    double x_m = centre.x, south_m = -centre.y;
    bool is_wooded = km_noise(seed + 30, x_m, south_m, wood_m, 2) > 0.16;
    if (row < kRimRow) {
        double bare_rows = 1.6 + 2.2 * km_noise(seed + 31, x_m, 0, 5'000, 2);
        if (kRimRow - row <= std::max(1.0, bare_rows)) return kRock;
        return is_wooded ? kForest : kMeadow;
    }
    if (row < kRimRow + kWallRows) return kRock;
    double from_foot_m = south_m - rim_south_m(seed, x_m) - wall_width_m(seed, x_m);
    if (from_foot_m < 1'500 + 1'100 * km_noise(seed + 32, x_m, 0, 3'000, 2)) return kScree;
    return is_wooded ? kForest : kFields;
}

std::vector<uint32_t> cover(const MeshGrid& grid, double wood_m, uint64_t seed) {
    std::vector<uint32_t> surface(grid.face_count());
    for (uint32_t face = 0; face < surface.size(); ++face) surface[face] = surface_of(grid, face, wood_m, seed);
    drop_islands(grid, kLeastRegion, surface);
    constexpr std::array<uint32_t, 4> kMeeting = {kFields, kForest, kRock, kScree};
    make_meeting(grid, kMeeting, kMeetingRadius, kRimRow + kWallRows + 6, surface);
    return surface;
}

mesh::Mesh dressed(const MeshGrid& grid, const std::vector<uint32_t>& surface) {
    Dress dress{surface, {}, [&](uint32_t position) { return tile_uv(grid.positions_m[position]); }};
    for (uint32_t face = 0; face < surface.size(); ++face) dress.shading.push_back(face / 2 / (kColumns - 1) >= kRimRow);
    return mesh_of_grid(grid, dress);
}

}  // namespace

Result<MeshSample> cliff(uint64_t seed) {
    MeshGrid grid = make_grid(seed);
    Result<mesh::Mesh> mesh = nearest_to_paper(kCliff, seed, [&](uint32_t variant) {
        return dressed(grid, cover(grid, 7'000 + 1'500 * (variant % 12), seed + 1000 * (variant / 12)));
    });
    if (!mesh) return tl::unexpected(mesh.error());
    if (Result<void> made = dress_surfaces(kKinds, seed, *mesh); !made) return tl::unexpected(made.error());

    auto flight = [&](const std::vector<Waypoint>& way, double pitch_deg) { return mesh_flight(grid, way, pitch_deg); };
    return MeshSample{
        kCliff.name,
        std::move(*mesh),
        {flight({{0.04, 0.72, 900}, {0.2, 0.62, 600}, {0.4, 0.56, 500}, {0.6, 0.54, 500}, {0.8, 0.5, 700}, {0.96, 0.4, 900}}, -6),
         flight({{0.5, 0.95, 700}, {0.46, 0.8, 500}, {0.44, 0.66, 500}, {0.42, 0.52, 700}, {0.4, 0.36, 500}, {0.42, 0.18, 700}},
                -6),
         flight({{0.94, 0.12, 800}, {0.78, 0.22, 500}, {0.6, 0.3, 400}, {0.4, 0.34, 400}, {0.2, 0.3, 500}, {0.06, 0.2, 700}},
                -10),
         flight({{0.9, 0.86, 700}, {0.74, 0.72, 450}, {0.62, 0.6, 450}, {0.5, 0.6, 450}, {0.36, 0.68, 450}, {0.2, 0.82, 600}},
                -7)},
        terrain_recipe(kCliff, seed, "")};
}

}  // namespace overlook::sample
