#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "formats/mapped_file.h"
#include "tools/bake/images.h"
#include "tools/make_sample/canyon_ground.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_terrains.h"
#include "tools/make_sample/terrain_surfaces.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kColumns = kCanyon.columns, kRows = kCanyon.rows;
constexpr double kGreyStep_m = 15;  // from 35 at the river to 187 on the plateau: about 525 to 2,805 m
constexpr const char *kElevationFile = "elevation_1200_8bit.png", *kColourFile = "colour_1024.png";

struct Dressed {
    mesh::Mesh mesh;
    MeshGrid grid;
};

MeshGrid grid_of(const std::function<double(double east, double south)>& height_m_at) {
    MeshGrid grid{kColumns, kRows, {}};
    for (uint32_t row = 0; row < kRows; ++row)
        for (uint32_t column = 0; column < kColumns; ++column) {
            double east = double(column) / (kColumns - 1), south = double(row) / (kRows - 1);
            grid.positions_m.emplace_back(east * kCanyon.width_m, -south * kCanyon.height_m, height_m_at(east, south));
        }
    return grid;
}

Dressed dressed(MeshGrid grid, const std::function<double(double east)>& u_of, std::vector<uint8_t> texture_bytes) {
    auto uv_of = [&](uint32_t position) {
        double east = double(position % kColumns) / (kColumns - 1), south = double(position / kColumns) / (kRows - 1);
        return glm::vec2(u_of(east), south);
    };
    Dress dress{std::vector<uint32_t>(grid.face_count(), 0), std::vector<uint8_t>(grid.face_count(), 0), uv_of};
    Dressed made{mesh_of_grid(grid, dress), std::move(grid)};
    mesh::Surface surface;
    surface.name = "canyon";
    surface.texture = "canyon.png";
    surface.texture_bytes = std::move(texture_bytes);
    made.mesh.surfaces.push_back(std::move(surface));
    return made;
}

// The square of the data and its mirror image to the west.
Result<Dressed> real_canyon(const std::string& folder) {
    std::string elevation_path = (std::filesystem::path(folder) / kElevationFile).string();
    std::string colour_path = (std::filesystem::path(folder) / kColourFile).string();
    Result<NumberRaster> elevation = read_number_raster(elevation_path, {});
    if (!elevation) return tl::unexpected(elevation.error());
    if (elevation->width != elevation->height || elevation->width < 2)
        return bad_input("{}: is {} x {}; a square is wanted", elevation_path, elevation->width, elevation->height);
    Result<ImageRgb8> colour = read_image_rgb8(colour_path);
    if (!colour) return tl::unexpected(colour.error());
    Result<MappedFile> colour_file = MappedFile::open(colour_path);
    if (!colour_file) return tl::unexpected(colour_file.error());

    std::vector<double> grey(elevation->values.begin(), elevation->values.end());
    uint32_t side = elevation->width;
    grey = box_mean(grey, side, side, side / 600);  // half a cell of the mesh
    MeshGrid grid = grid_of([&](double east, double south) {
        return kGreyStep_m * between(grey, side, side, std::abs(2 * east - 1) * (side - 1), south * (side - 1));
    });
    std::vector<uint8_t> bytes;
    for (std::byte byte : colour_file->bytes()) bytes.push_back(uint8_t(byte));
    return dressed(
        std::move(grid), [](double east) { return std::abs(2 * east - 1); }, std::move(bytes));
}

Result<Dressed> made_canyon(uint64_t seed) {
    CanyonGround ground = make_canyon_ground(seed);
    Result<std::vector<std::byte>> png = png_bytes(canyon_picture(ground, seed));
    if (!png) return tl::unexpected(png.error());
    std::vector<uint8_t> bytes;
    for (std::byte byte : *png) bytes.push_back(uint8_t(byte));
    MeshGrid grid = grid_of([&](double east, double south) { return ground.height_m(east, south); });
    return dressed(
        std::move(grid), [](double east) { return east; }, std::move(bytes));
}

}  // namespace

Result<MeshSample> canyon(uint64_t seed, const std::string& source) {
    Result<Dressed> made = source.empty() ? made_canyon(seed) : real_canyon(source);
    if (!made) return tl::unexpected(made.error());
    auto flight = [&](const std::vector<Waypoint>& way, double pitch_deg) { return mesh_flight(made->grid, way, pitch_deg); };
    std::array<scene::Flight, 4> flights = {
        flight({{0.95, 0.7, 1500},
                {0.86, 0.76, 1000},
                {0.76, 0.7, 900},
                {0.68, 0.6, 900},
                {0.6, 0.5, 1000},
                {0.54, 0.4, 1200},
                {0.5, 0.3, 1500}},
               -12),
        flight(
            {{0.06, 0.9, 2000}, {0.16, 0.8, 1500}, {0.28, 0.7, 1200}, {0.36, 0.56, 1200}, {0.44, 0.44, 1200}, {0.5, 0.24, 1600}},
            -14),
        flight(
            {{0.9, 0.08, 2000}, {0.92, 0.26, 1500}, {0.94, 0.44, 1200}, {0.96, 0.6, 1200}, {0.9, 0.76, 1300}, {0.8, 0.88, 1800}},
            -14),
        flight(
            {{0.3, 0.1, 2500}, {0.4, 0.26, 1800}, {0.52, 0.42, 1500}, {0.64, 0.54, 1300}, {0.74, 0.66, 1300}, {0.82, 0.82, 1800}},
            -16)};
    return MeshSample{kCanyon.name, std::move(made->mesh), std::move(flights),
                      terrain_recipe(kCanyon, seed, source.empty() ? "" : fmt::format("{} and {}", kElevationFile, kColourFile))};
}

}  // namespace overlook::sample
