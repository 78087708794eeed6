#include "tests/corrupt/wang_fixtures.h"

#include <functional>
#include <limits>

#include "formats/little_endian.h"
#include "tests/corrupt/terrain_parts.h"

namespace overlook::wang_ldi::fixtures {
namespace {

using container::fixtures::RawSection;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

Planted tulip(float x_m, float y_m, Owner owner) {
    Planted planted;
    planted.x_m = x_m, planted.y_m = y_m, planted.owner = owner;
    return planted;
}

Bytes with(const std::function<void(Pieces&)>& change) {
    Pieces pieces = Pieces::of(tulips());
    change(pieces);
    return pieces.file();
}
// The same of a ground that is broken before it is laid out.
Bytes of(const std::function<void(PlantedTiles&)>& change) {
    PlantedTiles ground = tulips();
    change(ground);
    return Pieces::of(ground).file();
}
Bytes with_object(const std::function<void(Planted&)>& change) {
    return of([&](PlantedTiles& ground) { change(ground.planting.tiles[1][1]); });
}
Bytes without(const char* tag) {
    return with([&](Pieces& pieces) { pieces.without = tag; });
}
Bytes resized(Bytes Pieces::*piece, int by) {
    return with([&](Pieces& pieces) { (pieces.*piece).resize(size_t(int((pieces.*piece).size()) + by)); });
}
Bytes with_count(size_t at, uint16_t count) {
    return with([&](Pieces& pieces) { store_le<uint16_t>(pieces.tiles, at, count); });
}
// WPLT: the model begins at 16, its name at 20, its radii at 25; tile 0 at 33, its first object at 37.
Bytes with_planting(size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.planting, at, value); });
}
Bytes with_other_kind() {
    Bytes file = Pieces::of(tulips()).file();
    store_le<uint32_t>(file, 32, container::tag("DISC"));
    container::fixtures::seal(file);
    return file;
}

std::vector<Fixture> broken_sets() {
    return {{"w01_other_kind.ovl", 1, with_other_kind()},
            {"w01_no_tiles.ovl", 1, without("WTIL")},
            {"w01_no_planting.ovl", 1, without("WPLT")},
            {"w02_empty.ovl", 2, with([](Pieces& pieces) { pieces.tiles.clear(); })},
            {"w02_byte_less.ovl", 2, resized(&Pieces::tiles, -1)},
            {"w02_byte_more.ovl", 2, resized(&Pieces::tiles, 1)},
            {"w02_most_bytes.ovl", 2, resized(&Pieces::tiles, 4000)},
            {"w02_no_horizontal.ovl", 2, with_count(0, 0)},
            {"w02_most_vertical.ovl", 2, with_count(2, 256)},
            {"w02_no_corner.ovl", 2, with_count(4, 0)},
            {"w02_no_tile.ovl", 2, with_count(6, 0)},
            {"w02_most_tiles.ovl", 2, with_count(6, 65535)},
            {"w03_nan.ovl", 3, of([](PlantedTiles& ground) { ground.set.corner_density[0] = kNanF; })},
            {"w03_negative.ovl", 3, of([](PlantedTiles& ground) { ground.set.corner_density[0] = -0.5f; })},
            {"w03_above_one.ovl", 3, of([](PlantedTiles& ground) { ground.set.corner_density[0] = 1.5f; })},
            {"w04_horizontal.ovl", 4, of([](PlantedTiles& ground) { ground.set.horizontal[0].low = 1; })},
            {"w04_vertical.ovl", 4, of([](PlantedTiles& ground) { ground.set.vertical[1].high = 255; })},
            {"w05_north.ovl", 5, of([](PlantedTiles& ground) { ground.set.tiles[1].north = 1; })},
            {"w05_east.ovl", 5, of([](PlantedTiles& ground) { ground.set.tiles[0].east = 2; })},
            {"w05_corners.ovl", 5, of([](PlantedTiles& ground) {
                 ground.set.corner_density.push_back(1);
                 ground.set.vertical[1].low = 1;
             })}};
}

std::vector<Fixture> broken_plantings() {
    return {{"w06_empty.ovl", 6, with([](Pieces& pieces) { pieces.planting.clear(); })},
            {"w06_byte_less.ovl", 6, resized(&Pieces::planting, -1)},
            {"w06_byte_more.ovl", 6, resized(&Pieces::planting, 1)},
            {"w06_most_models.ovl", 6, with_planting(8, 0xffffffff)},
            {"w06_most_tiles.ovl", 6, with_planting(12, 0xffffffff)},
            {"w06_tile_less.ovl", 6, of([](PlantedTiles& ground) { ground.planting.tiles.pop_back(); })},
            {"w06_long_name.ovl", 6, with_planting(16, 4097)},
            {"w06_unprintable.ovl", 6, with_planting(20, 7)},
            {"w06_most_objects.ovl", 6, with_planting(33, 0xffffffff)},
            {"w07_nan_size.ovl", 7, of([](PlantedTiles& ground) { ground.planting.tile_size_m = kNan; })},
            {"w07_no_size.ovl", 7, of([](PlantedTiles& ground) { ground.planting.tile_size_m = 0; })},
            {"w07_no_radius.ovl", 7, of([](PlantedTiles& ground) { ground.planting.models[0].tight_radius_m = 0; })},
            {"w07_tight_above_packing.ovl", 7, of([](PlantedTiles& ground) { ground.planting.models[0].tight_radius_m = 0.6f; })},
            {"w07_packing_above_tile.ovl", 7, of([](PlantedTiles& ground) { ground.planting.models[0].packing_radius_m = 5; })},
            {"w07_nan_radius.ovl", 7, of([](PlantedTiles& ground) { ground.planting.models[0].packing_radius_m = kNanF; })},
            {"w08_model.ovl", 8, with_object([](Planted& object) { object.model = 1; })},
            {"w08_west.ovl", 8, with_object([](Planted& object) { object.x_m = -0.25f; })},
            {"w08_north.ovl", 8, with_object([](Planted& object) { object.y_m = 4; })},
            {"w08_nan_place.ovl", 8, with_object([](Planted& object) { object.x_m = kNanF; })},
            {"w08_turn.ovl", 8, with_object([](Planted& object) { object.turn_rad = 7; })},
            {"w08_no_scale.ovl", 8, with_object([](Planted& object) { object.scale = 0; })},
            {"w08_owner.ovl", 8, with_object([](Planted& object) { object.owner = Owner(4); })},
            {"w09_corner_moved.ovl", 9, of([](PlantedTiles& ground) { ground.planting.tiles[1][0].x_m = 0.5f; })},
            {"w09_corner_missing.ovl", 9,
             of([](PlantedTiles& ground) { ground.planting.tiles[0].erase(ground.planting.tiles[0].begin()); })},
            {"w09_edge_missing.ovl", 9, of([](PlantedTiles& ground) { ground.planting.tiles[2].pop_back(); })},
            {"w09_edge_turned.ovl", 9, of([](PlantedTiles& ground) { ground.planting.tiles[2].back().turn_rad = 1; })},
            {"w10_west.ovl", 10, with_object([](Planted& object) { object.x_m = 0.125f; })},
            {"w10_scaled.ovl", 10, with_object([](Planted& object) { object.scale = 9; })}};
}

}  // namespace

PlantedTiles tulips() {
    PlantedTiles ground;
    ground.set.vertical = {{}, {}};
    ground.set.tiles = {{0, 1, 0, 0}, {0, 0, 0, 1}, {0, 1, 0, 1}};
    ground.planting.tile_size_m = 4;
    ground.planting.models = {{"tulip", 0.25f, 0.5f}};
    Planted corner = tulip(0.25f, 0.25f, Owner::corner), edge = tulip(3.75f, 2, Owner::vertical_edge);
    edge.turn_rad = 0.5f;
    ground.planting.tiles = {{corner, edge}, {corner, tulip(2, 2, Owner::interior)}, {corner, edge}};
    return ground;
}

Pieces Pieces::of(const PlantedTiles& ground) {
    Pieces pieces;
    pieces.tiles = bytes_of_tiles(ground.set), pieces.planting = bytes_of_planting(ground.planting);
    return pieces;
}

Bytes Pieces::file() const {
    std::vector<RawSection> sections;
    if (without != "WTIL") sections.push_back({"WTIL", 1, 0, tiles, tiles.size()});
    if (without != "WPLT") sections.push_back({"WPLT", 1, 1, terrain::fixtures::frame_of(planting), planting.size()});
    Bytes file = container::fixtures::file_of(sections);
    store_le<uint32_t>(file, 32, kKind);
    container::fixtures::seal(file);
    return file;
}

std::vector<Fixture> whole_files() {
    PlantedTiles bare = tulips();
    for (auto& tile : bare.planting.tiles) tile.clear();
    bare.planting.models.clear(), bare.set.corner_density = {0};
    return {{"tulips.ovl", 0, Pieces::of(tulips()).file()}, {"bare.ovl", 0, Pieces::of(bare).file()}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> files = broken_sets(), plantings = broken_plantings();
    files.insert(files.end(), plantings.begin(), plantings.end());
    return files;
}

}  // namespace overlook::wang_ldi::fixtures
