#include "runtime/wang_ldi/draw_land.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "formats/mapped_file.h"
#include "runtime/gl/png.h"
#include "runtime/wang_ldi/plain.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kOverviewPitch_deg = -6;

// A painted map; empty if there is none.
Result<ImageRgb8> read_map(const std::string& scene_path, const std::string& name) {
    ImageRgb8 map;
    if (name.empty()) return map;
    std::string path = scene::path_in_scene(scene_path, name);
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    Result<ImageRgba8> picture = decode_png(path, file->bytes());
    if (!picture) return tl::unexpected(picture.error());
    map.width = picture->width, map.height = picture->height;
    map.pixels.reserve(size_t(3) * map.width * map.height);
    for (size_t p = 0; p < size_t(map.width) * map.height; ++p)
        map.pixels.insert(map.pixels.end(), &picture->pixels[4 * p], &picture->pixels[4 * p] + 3);
    return map;
}

Result<PlantedOptions> options_of(const scene::Planting& planting, const std::string& scene_path) {
    PlantedOptions options;
    options.seed = planting.seed;
    if (planting.tiling == scene::kRandomAccess) options.tiling = TilingKind::random_access;
    if (planting.tiling == scene::kRowByRow) options.tiling = TilingKind::row_by_row;
    PlacementOptions& placement = options.placement;
    placement.lowest_m = planting.lowest_m.value_or(placement.lowest_m);
    placement.highest_m = planting.highest_m.value_or(placement.highest_m);
    placement.steepest = planting.steepest, placement.fairing_tiles = planting.fairing_tiles;
    Result<ImageRgb8> mask = read_map(scene_path, planting.mask), density = read_map(scene_path, planting.density);
    if (!mask) return tl::unexpected(mask.error());
    if (!density) return tl::unexpected(density.error());
    placement.mask = std::move(*mask), placement.density = std::move(*density);
    return options;
}

}  // namespace

Result<std::unique_ptr<PlantedLand>> PlantedLand::read(container::Reader file, std::optional<terrain::Terrain> terrain,
                                                       const scene::Planting& planting, const std::string& scene_path) {
    Result<PlantedOptions> options = options_of(planting, scene_path);
    if (!options) return tl::unexpected(options.error());
    std::unique_ptr<PlantedLand> made(new PlantedLand);
    made->is_plain_ = !terrain;
    made->terrain_ = std::make_unique<terrain::Terrain>(terrain ? std::move(*terrain) : plain_terrain());
    made->refiner_.emplace(*made->terrain_);
    Ground on = made->is_plain_ ? Ground::plain() : Ground(*made->terrain_);
    Result<std::unique_ptr<PlantedField>> planted = PlantedField::open(std::move(file), std::move(on), *options);
    if (!planted) return tl::unexpected(planted.error());
    made->planted_ = std::move(*planted);
    made->described_ = planting, made->scene_path_ = scene_path;
    return made;
}

bool PlantedLand::has_models() const {
    auto is_there = [&](const std::string& model) {
        std::error_code unused;
        return std::filesystem::is_regular_file(scene::path_in_scene(scene_path_, model), unused);
    };
    return !described_.models.empty() && std::all_of(described_.models.begin(), described_.models.end(), is_there);
}

Result<void> PlantedLand::read_models() {
    size_t wanted = planted_->planting().models.size();
    if (described_.models.empty())
        return bad_input("{}: names no models of what {} plants; they are chains of levels (bake-lod discrete)", scene_path_,
                         planted_->name());
    if (described_.models.size() != wanted)
        return bad_input("{}: names {} models, and {} plants {}", scene_path_, described_.models.size(), planted_->name(),
                         wanted);
    for (const std::string& model : described_.models) {
        Result<discrete::Chain> chain = discrete::read(scene::path_in_scene(scene_path_, model));
        if (!chain) return tl::unexpected(chain.error());
        models_.push_back(std::move(*chain));
    }
    return {};
}

void PlantedLand::paint_ground(const std::array<uint8_t, 3>& colour) {
    terrain_->texture = {1, 1, {colour.begin(), colour.end()}};
}

Result<void> PlantedLand::upload() {
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*terrain_);
    if (!drawing) return tl::unexpected(drawing.error());
    drawing_.emplace(std::move(*drawing));
    if (models_.empty()) return {};
    Result<Plants> plants = Plants::make(models_, planted_->planting(), planted_->images().set().to_sun);
    if (!plants) return tl::unexpected(plants.error());
    plants_.emplace(std::move(*plants));
    return {};
}

double PlantedLand::eye_height_m() const {
    const Cell& cell = planted_->images().set().cell;
    return (cell.eye_low_m + cell.eye_high_m) / 2;
}

view::Camera PlantedLand::overview(uint32_t width_px, uint32_t height_px) const {
    const Ground& ground = planted_->ground();
    glm::dvec2 middle_m = is_plain_ ? glm::dvec2(0) : (ground.extent().low_m + ground.extent().high_m) / 2.0;
    double height_m = ground.height_m(middle_m);
    view::Camera camera;
    camera.width_px = width_px, camera.height_px = height_px;
    camera.pitch_deg = kOverviewPitch_deg;
    camera.position_m = {middle_m, (std::isnan(height_m) ? 0 : height_m) + eye_height_m()};
    return camera;
}

}  // namespace overlook::wang_ldi
