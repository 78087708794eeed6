// Whatever decides the bytes of a bake is in the key of its parts: of two bakes that differ in one such thing neither takes the
// other's.
#include "tools/bake/wang_ldi/bake_key.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/tools/wang_ldi/plants.h"

namespace overlook::wang_ldi {
namespace {

struct Bake {
    TileSet tiles = plants::one_tile();
    Planting planting = plants::planting(3, 2);
    Models models = plants::models();
    ImageBake bake;
    ImageSet set = plants::image_set();

    Bake() {
        tiles.tiles.resize(2), bake.version = "0.1.0";
        models.skins[0].textures = {Texture{}};
    }
    uint64_t key() const { return key_of(tiles, planting, models, bake, set); }
};

TEST(BakeKeys, OfBakesThatDifferInOneThingDiffer) {
    const std::vector<std::function<void(Bake&)>> changes{
        [](Bake& of) { of.bake.version = "0.1.1"; },
        [](Bake& of) { of.tiles.horizontal.push_back({}); },
        [](Bake& of) { of.tiles.vertical.push_back({}); },
        [](Bake& of) { of.tiles.corner_density.push_back(1), of.tiles.horizontal[0].high = 1; },
        [](Bake& of) { of.tiles.corner_density.push_back(1), of.tiles.vertical[0].low = 1; },
        [](Bake& of) { of.tiles.corner_density[0] = 0.5f; },
        [](Bake& of) { of.tiles.tiles[1].north = 1; },
        [](Bake& of) { of.planting.tile_size_m = 5; },
        [](Bake& of) { of.planting.tiles[0][3].turn_rad += 0.1f; },
        [](Bake& of) { of.planting.tiles[0][3].owner = Owner::corner; },
        // The same objects, the last of the first tile now the first of the second.
        [](Bake& of) {
            of.planting.tiles[1].insert(of.planting.tiles[1].begin(), of.planting.tiles[0].back());
            of.planting.tiles[0].pop_back();
        },
        [](Bake& of) { of.planting.tiles.emplace_back(); },
        [](Bake& of) { of.models.meshes[2].masks[0].opacity[5] ^= 1; },
        [](Bake& of) { of.models.meshes[2].masks.push_back(of.models.meshes[2].masks[0]); },
        [](Bake& of) { of.models.skins[0].textures.push_back({}); },
        [](Bake& of) { of.set.level_fade = 0.05f; },
        [](Bake& of) { of.set.direction_fade = 0.1f; },
        [](Bake& of) { of.set.levels[0].side_px = 161; },
        [](Bake& of) { of.bake.sampling.unseen_goal = 0.03; },
        [](Bake& of) { of.bake.sampling.least_eyes = 17; },
        [](Bake& of) { of.bake.light.sun_rays = 9; },
        [](Bake& of) { of.bake.textures.error_goal = 0.07; },
        [](Bake& of) { of.bake.textures.side_px = 16; },
        [](Bake& of) { of.bake.neighbourhoods = 2; },
        [](Bake& of) { of.bake.memory_bytes = 1; },
        [](Bake& of) { of.bake.seed = 2; },
        [](Bake& of) { of.bake.has_gloss = false; },
        [](Bake& of) { of.bake.is_covering = false; },
        [](Bake& of) { of.bake.trial_tiles = 1; },
        [](Bake& of) { of.bake.judged_views = 7; },
        [](Bake& of) { of.models.skins[0].looks.push_back({}); },
        [](Bake& of) { of.models.skins[0].looks[0].roughness = 0.5f; },
        [](Bake& of) { of.models.skins[0].looks[0].metallic = 0.5f; },
        [](Bake& of) { of.bake.instructions = rays::Instructions::everywhere; },
    };
    std::set<uint64_t> keys{Bake().key()};
    EXPECT_EQ(Bake().key(), *keys.begin());
    for (size_t c = 0; c < changes.size(); ++c) {
        Bake changed;
        changes[c](changed);
        EXPECT_TRUE(keys.insert(changed.key()).second) << "change " << c;
    }
    Bake elsewhere;  // where its parts lie and which of them are made decides nothing
    elsewhere.bake.parts_folder = "elsewhere", elsewhere.bake.part_count = 3;
    EXPECT_EQ(elsewhere.key(), Bake().key());
}

}  // namespace
}  // namespace overlook::wang_ldi
