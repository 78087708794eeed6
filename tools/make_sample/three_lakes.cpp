#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tools/bake/caveclod/groups.h"
#include "tools/make_sample/ground_regions.h"
#include "tools/make_sample/ground_textures.h"
#include "tools/make_sample/landscape.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_terrains.h"
#include "tools/make_sample/terrain_surfaces.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kSide = kThreeLakes.columns;
constexpr double kCell_m = kThreeLakes.width_m / (kSide - 1);
constexpr uint32_t kLakeCount = 3;
constexpr uint32_t kLeastRegion = 80;  // faces
constexpr double kMeetingRadius = 4;   // cells
constexpr double kBeach = 0.28;        // how far outside a lake sand lies, in its terms

enum Surface : uint32_t { kDeepWater, kClearWater, kMoorWater, kSand, kMeadow, kForest, kHeath, kRock, kSnow };
constexpr std::array<GroundKind, 9> kKinds = {GroundKind::deep_water, GroundKind::clear_water, GroundKind::moor_water,
                                              GroundKind::sand,       GroundKind::meadow,      GroundKind::forest,
                                              GroundKind::heath,      GroundKind::rock,        GroundKind::snow};

// Above 0 in the lake, falling outward from its shore.
struct Lake {
    double column, row, radius, level_m;
    uint64_t seed;

    double depth(double x, double y) const {
        double dx = (x - column) / radius, dy = (y - row) / radius;
        return 1 - dx * dx - dy * dy + 0.9 * fractal_noise(seed, x / 11, y / 11, 4);
    }
};

struct Ground {
    MeshGrid grid;
    std::vector<Lake> lakes;
    std::vector<double> depth;      // [P] of the nearest lake
    std::vector<uint32_t> of_lake;  // [P] which that is
};

double mean_height_m(const Landscape& land, uint32_t column, uint32_t row, uint32_t reach) {
    double sum = 0;
    for (uint32_t y = row - reach; y <= row + reach; ++y)
        for (uint32_t x = column - reach; x <= column + reach; ++x) sum += land.height_m[size_t(y) * kSide + x];
    return sum / ((2 * reach + 1) * (2 * reach + 1));
}

// Where the land lies lowest, well away from the border and from each other.
std::vector<Lake> find_lakes(const Landscape& land, uint64_t seed) {
    constexpr uint32_t kMargin = 26, kReach = 9;
    std::vector<Lake> lakes;
    for (uint32_t n = 0; n < kLakeCount; ++n) {
        Lake best{0, 0, 15.5 - 2.5 * n, HUGE_VAL, seed + 40 + n};
        for (uint32_t row = kMargin; row < kSide - kMargin; row += 2)
            for (uint32_t column = kMargin; column < kSide - kMargin; column += 2) {
                auto is_near = [&](const Lake& other) {
                    double dx = other.column - column, dy = other.row - row;
                    return dx * dx + dy * dy < 52 * 52;
                };
                if (std::any_of(lakes.begin(), lakes.end(), is_near)) continue;
                double mean_m = mean_height_m(land, column, row, kReach);
                if (mean_m < best.level_m) best = {double(column), double(row), best.radius, mean_m, best.seed};
            }
        lakes.push_back(best);
    }
    return lakes;
}

// Level water, and a shore that rises from it.
double shore_height_m(double height_m, double depth, double level_m) {
    if (depth > 0) return level_m;
    double share = smooth_step(0, 1.1, -depth);
    double shore_m = level_m + share * (height_m - level_m);
    return depth > -0.6 ? std::max(shore_m, level_m + 12 * std::min(1.0, -depth / kBeach)) : shore_m;
}

Ground make_ground(uint64_t seed) {
    Landscape land = make_landscape({seed, kSide, kCell_m, Relief::front});
    Ground ground{{kSide, kSide, {}}, find_lakes(land, seed), {}, {}};
    for (uint32_t row = 0; row < kSide; ++row)
        for (uint32_t column = 0; column < kSide; ++column) {
            uint32_t nearest = 0;
            for (uint32_t n = 1; n < kLakeCount; ++n)
                if (ground.lakes[n].depth(column, row) > ground.lakes[nearest].depth(column, row)) nearest = n;
            double depth = ground.lakes[nearest].depth(column, row);
            double z_m = shore_height_m(land.height_m[size_t(row) * kSide + column], depth, ground.lakes[nearest].level_m);
            ground.grid.positions_m.emplace_back(column * kCell_m, -(row * kCell_m), z_m);
            ground.depth.push_back(depth);
            ground.of_lake.push_back(nearest);
        }
    return ground;
}

// [P] heights over ground smoothed over `reach` cells either way, twice, as shares of all positions that lie lower.
std::vector<double> height_ranks(const MeshGrid& grid, uint32_t reach) {
    std::vector<double> smooth(grid.positions_m.size());
    for (size_t i = 0; i < smooth.size(); ++i) smooth[i] = grid.positions_m[i].z;
    for (int pass = 0; pass < 2; ++pass) smooth = box_mean(smooth, grid.columns, grid.rows, reach);
    std::vector<uint32_t> order(smooth.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return smooth[a] != smooth[b] ? smooth[a] < smooth[b] : a < b; });
    std::vector<double> ranks(smooth.size());
    for (size_t i = 0; i < order.size(); ++i) ranks[order[i]] = double(i) / double(order.size());
    return ranks;
}

uint32_t surface_of(const Ground& ground, std::span<const double> ranks, uint32_t face, uint64_t seed) {
    double rank = 0, depth = -HUGE_VAL, least_depth = HUGE_VAL;
    uint32_t lake = 0;
    for (uint32_t corner : ground.grid.face(face)) {
        rank += ranks[corner] / 3;
        least_depth = std::min(least_depth, ground.depth[corner]);
        if (ground.depth[corner] > depth) {
            depth = ground.depth[corner];
            lake = ground.of_lake[corner];
        }
    }
    if (least_depth > 0) return lake;
    if (depth > -kBeach) return kSand;
    glm::dvec3 centre = ground.grid.centre_m(face) / 1000.0;
    rank += 0.05 * fractal_noise(seed + 60, centre.x / 9, centre.y / 9, 3);
    if (rank > 0.91) return kSnow;
    if (rank > 0.79) return kRock;
    if (rank > 0.62) return kHeath;
    bool is_wooded = rank > 0.22 && fractal_noise(seed + 70, centre.x / 17, centre.y / 17, 2) > -0.08;
    return is_wooded ? kForest : kMeadow;
}

std::vector<uint32_t> cover(const Ground& ground, uint32_t reach, uint64_t seed) {
    std::vector<double> ranks = height_ranks(ground.grid, reach);
    std::vector<uint32_t> surface(ground.grid.face_count());
    for (uint32_t face = 0; face < surface.size(); ++face) surface[face] = surface_of(ground, ranks, face, seed);
    drop_islands(ground.grid, kLeastRegion, surface);
    constexpr std::array<uint32_t, 5> kMeeting = {kForest, kMeadow, kSand, kRock, kHeath};
    make_meeting(ground.grid, kMeeting, kMeetingRadius, 0, surface);
    return surface;
}

mesh::Mesh dressed(const Ground& ground, const std::vector<uint32_t>& surface) {
    Dress dress{surface, {}, [&](uint32_t position) { return tile_uv(ground.grid.positions_m[position]); }};
    for (uint32_t ground_kind : surface) dress.shading.push_back(ground_kind <= kMoorWater);
    return mesh_of_grid(ground.grid, dress);
}

}  // namespace

Result<MeshSample> three_lakes(uint64_t seed) {
    Ground ground = make_ground(seed);
    // Smoother ground has shorter boundaries: the smoothing whose number of render vertices is nearest to the paper's.
    Result<mesh::Mesh> mesh = nearest_to_paper(kThreeLakes, seed, [&](uint32_t variant) {
        return dressed(ground, cover(ground, 1 + variant % 12, seed + 1000 * (variant / 12)));
    });
    if (!mesh) return tl::unexpected(mesh.error());
    if (Result<void> made = dress_surfaces(kKinds, seed, *mesh); !made) return tl::unexpected(made.error());

    auto flight = [&](const std::vector<Waypoint>& way, double pitch_deg) { return mesh_flight(ground.grid, way, pitch_deg); };
    return MeshSample{
        kThreeLakes.name,
        std::move(*mesh),
        {flight({{0.08, 0.92, 1500},
                 {0.2, 0.8, 900},
                 {0.34, 0.66, 600},
                 {0.5, 0.58, 700},
                 {0.62, 0.44, 900},
                 {0.78, 0.34, 900},
                 {0.9, 0.16, 1200}},
                -9),
         flight({{0.9, 0.9, 1200}, {0.76, 0.74, 700}, {0.58, 0.66, 500}, {0.42, 0.5, 600}, {0.3, 0.34, 700}, {0.14, 0.2, 900}},
                -10),
         flight({{0.12, 0.1, 1500}, {0.3, 0.22, 800}, {0.52, 0.26, 700}, {0.72, 0.4, 700}, {0.84, 0.6, 800}, {0.88, 0.84, 900}},
                -12),
         flight({{0.5, 0.96, 700},
                 {0.36, 0.8, 400},
                 {0.26, 0.6, 400},
                 {0.36, 0.44, 500},
                 {0.54, 0.48, 500},
                 {0.6, 0.64, 600},
                 {0.48, 0.76, 900}},
                -8)},
        terrain_recipe(kThreeLakes, seed, "")};
}

}  // namespace overlook::sample
