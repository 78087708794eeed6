// The sets of plants read as they were made, are what the paper's tiles hold, and follow their seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <regex>

#include "runtime/view/flight.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/mesh_input.h"
#include "tools/make_sample/plant_field.h"
#include "tools/make_sample/plant_land.h"
#include "tools/make_sample/plant_textures.h"
#include "tools/make_sample/sample_plants.h"
#include "tools/make_sample/sample_slopes.h"
#include "tools/make_sample/sunflower.h"

namespace overlook::sample {
namespace {

const PlantSet& set_of(const std::string& name) {
    static const PlantSet sunflowers = plant_set("sunflowers", 1).value_or(PlantSet{});
    static const PlantSet grass = plant_set("grass", 1).value_or(PlantSet{});
    return name == "grass" ? grass : sunflowers;
}

double triangles_a_tile(const PlantSet& set) {
    double triangles = 0, shares = 0;
    for (const Plant& plant : set.plants) shares += plant.share, triangles += plant.share * double(plant.mesh.faces.size());
    return set.per_tile * triangles / shares;
}

// Of the area that its pictures cover, how much shows; 0..1.
double share_shown(const Paint& paint) {
    constexpr int kSide = 64;
    int shown = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) shown += paint((x + 0.5) / kSide, (y + 0.5) / kSide).a >= 0.5;
    return double(shown) / (kSide * kSide);
}

TEST(SamplePlants, AreThoseOfThePaper) {
    int grasses = 0, dandelions = 0, buttercups = 0;
    for (const Plant& plant : set_of("grass").plants) {
        grasses += plant.file.rfind("grass-", 0) == 0, dandelions += plant.file.rfind("dandelion-", 0) == 0;
        buttercups += plant.file.rfind("buttercup-", 0) == 0;
    }
    EXPECT_EQ(grasses, 15);
    EXPECT_EQ(dandelions, 9);
    EXPECT_EQ(buttercups, 15);
    EXPECT_NEAR(triangles_a_tile(set_of("grass")), 62'000, 0.02 * 62'000);
    EXPECT_NEAR(triangles_a_tile(set_of("sunflowers")), 20 * 35'000, 0.02 * 20 * 35'000);
}
TEST(SamplePlants, AreFiniteWithNormalsAndPicturesEverywhere) {
    for (const char* name : {"sunflowers", "grass"})
        for (const Plant& plant : set_of(name).plants) {
            const mesh::Mesh& mesh = plant.mesh;
            bool is_finite = true, is_unit = true, is_in_picture = true, is_whole = true;
            for (const glm::vec3& at : mesh.positions_m) is_finite &= glm::length(at) < 10;
            for (const glm::vec3& normal : mesh.normals) is_unit &= std::abs(glm::length(normal) - 1) < 1e-4f;
            for (const glm::vec2& uv : mesh.uvs) is_in_picture &= uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
            for (size_t f = 0; f < mesh.faces.size(); ++f) {
                glm::dvec3 a(corner_m(mesh, f, 0)), b(corner_m(mesh, f, 1)), c(corner_m(mesh, f, 2));
                is_whole &= glm::length(glm::cross(b - a, c - a)) > 0;
            }
            EXPECT_TRUE(is_finite) << plant.file;
            EXPECT_TRUE(is_unit) << plant.file;
            EXPECT_TRUE(is_in_picture) << plant.file;
            EXPECT_TRUE(is_whole) << plant.file;
            for (const mesh::Surface& surface : mesh.surfaces) EXPECT_GT(surface.texture_bytes.size(), 100u) << plant.file;
        }
}
TEST(SamplePlants, LightTheSideThatTheirTrianglesShow) {
    for (const char* name : {"sunflowers", "grass"})
        for (const Plant& plant : set_of(name).plants) {
            size_t turned = 0;
            for (size_t f = 0; f < plant.mesh.faces.size(); ++f) {
                glm::dvec3 a(corner_m(plant.mesh, f, 0)), b(corner_m(plant.mesh, f, 1)), c(corner_m(plant.mesh, f, 2)), shown(0);
                for (uint32_t corner : plant.mesh.face_normals[f]) shown += glm::dvec3(plant.mesh.normals[corner]);
                turned += glm::dot(glm::cross(b - a, c - a), shown) <= 0;
            }
            EXPECT_LE(double(turned), 0.005 * double(plant.mesh.faces.size())) << plant.file;
        }
}
TEST(SamplePlants, StandOnTheGround) {
    for (const Plant& plant : set_of("grass").plants) {
        double low_m = 1, top_m = 0;
        for (const glm::vec3& at : plant.mesh.positions_m)
            low_m = std::min(low_m, double(at.z)), top_m = std::max(top_m, double(at.z));
        EXPECT_LE(low_m, 0) << plant.file;
        EXPECT_GE(low_m, -0.03) << plant.file;
        EXPECT_GT(top_m, 0.1) << plant.file;
        EXPECT_LT(top_m, 0.65) << plant.file;
        EXPECT_LT(tight_radius_m(plant.mesh), 0.25) << plant.file;
    }
}
TEST(SamplePlants, LoseNothingOnTheirWayThroughAFile) {
    ScratchFolder folder;
    for (const char* name : {"sunflowers", "grass"}) ASSERT_TRUE(make_plants(name, {1, 50}, folder / name));
    auto expect_whole = [&](const std::string& path, const Plant& plant) {
        auto file = mesh::open_mesh(path, {});
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->mesh.faces.size(), plant.mesh.faces.size()) << plant.file;
        EXPECT_EQ(file->report.dropped.size(), 0u) << plant.file;
        EXPECT_EQ(file->report.flipped_face_count, 0u) << plant.file;
        for (size_t i = 0; i < plant.mesh.surfaces.size() && i < file->mesh.surfaces.size(); ++i) {
            EXPECT_EQ(file->mesh.surfaces[i].is_alpha_masked, plant.mesh.surfaces[i].is_alpha_masked) << plant.file;
            EXPECT_EQ(file->mesh.surfaces[i].is_two_sided, plant.mesh.surfaces[i].is_two_sided) << plant.file;
        }
    };
    for (const Plant& plant : set_of("grass").plants) expect_whole(folder / ("grass/" + plant.file), plant);
    for (size_t i : {0u, 5u, 10u}) {
        const Plant& plant = set_of("sunflowers").plants[i];
        expect_whole(folder / ("sunflowers/" + plant.file), plant);
    }
}
TEST(SamplePlants, ShowTheirMasksInUse) {
    constexpr uint8_t kColourAndOpacity = 6;  // of PNG's header
    for (const char* name : {"sunflowers", "grass"}) {
        size_t masked_faces = 0;
        for (const Plant& plant : set_of(name).plants)
            for (size_t f = 0; f < plant.mesh.faces.size(); ++f) {
                const mesh::Surface& surface = plant.mesh.surfaces[plant.mesh.face_surface[f]];
                if (!surface.is_alpha_masked) continue;
                ++masked_faces;
                ASSERT_GT(surface.texture_bytes.size(), 26u);
                EXPECT_EQ(surface.texture_bytes[25], kColourAndOpacity);
            }
        EXPECT_GT(masked_faces, 100u) << name;
    }
    for (const auto& [paint, least, most] :
         {std::tuple(heart_leaf_paint(1), 0.25, 0.6), {palmate_leaf_paint(1), 0.15, 0.6}, {parachute_paint(1), 0.05, 0.6}}) {
        EXPECT_GT(share_shown(paint), least);
        EXPECT_LT(share_shown(paint), most);
    }
}
TEST(SamplePlants, FollowTheSeed) {
    ScratchFolder folder;
    for (auto [place, seed] : {std::pair("a", 1), {"b", 1}, {"c", 2}})
        ASSERT_TRUE(make_plants("grass", {uint64_t(seed), 50}, folder / place));
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a")) {
        std::string file = entry.path().filename().string();
        auto text = [&](const std::string& place) { return text_of_file(folder / (place + ("/" + file))); };
        EXPECT_TRUE(text("a") == text("b")) << file;
        EXPECT_FALSE(text("a") == text("c")) << file;
    }
    auto sunflower = [](uint64_t seed) {
        return sunflower_mesh(sunflower_of(seed, 3), seed, std::vector<mesh::Surface>(4)).positions_m;
    };
    EXPECT_TRUE(sunflower(1) == sunflower(1));
    EXPECT_FALSE(sunflower(1) == sunflower(2));
}
TEST(SamplePlants, StandOnTheHillsWithoutOverlap) {
    for (const char* name : {"sunflowers", "grass"}) {
        const PlantSet& set = set_of(name);
        PlantField field = plant_field(set, 3000, 1);
        ASSERT_EQ(field.places.size(), 3000u);
        auto radius_m = [&](const PlantedPlace& place) { return place.scale * packing_radius_m(set.plants[place.plant]); };
        std::vector<double> radii_m;
        for (const PlantedPlace& place : field.places) radii_m.push_back(radius_m(place));
        int overlaps = 0;
        double covered_m2 = 0, highest_m = -1e9, lowest_m = 1e9;
        std::vector<int> stands(set.plants.size());
        for (size_t i = 0; i < field.places.size(); ++i) {
            const glm::dvec3& at_m = field.places[i].at_m;
            ++stands[field.places[i].plant], covered_m2 += 3.14159265 * radii_m[i] * radii_m[i];
            highest_m = std::max(highest_m, at_m.z), lowest_m = std::min(lowest_m, at_m.z);
            EXPECT_EQ(at_m.z, hill_m(field, at_m.x, at_m.y));
            for (size_t k = 0; k < i; ++k)
                overlaps += glm::distance(glm::dvec2(at_m), glm::dvec2(field.places[k].at_m)) < radii_m[i] + radii_m[k];
        }
        EXPECT_EQ(overlaps, 0) << name;
        EXPECT_NEAR(covered_m2 / (field.side_m * field.side_m), 0.5, 0.001) << name;
        EXPECT_GT(highest_m - lowest_m, 0.02 * field.side_m) << name;
        double shares = 0;
        for (const Plant& plant : set.plants) shares += plant.share;
        for (size_t i = 0; i < stands.size(); ++i) {
            double due = 3000 * set.plants[i].share / shares;
            EXPECT_NEAR(stands[i], due, 4.5 * std::sqrt(due)) << set.plants[i].file;
        }
        EXPECT_EQ(flight_of_field(field, 1).keys.size(), 13u);
    }
}
TEST(SamplePlants, WriteASceneThatIsRead) {
    ScratchFolder folder;
    ASSERT_TRUE(make_plants("sunflowers", {1, 50}, folder.path()));
    auto scene = scene::read_scene(folder / "scene.json");
    ASSERT_TRUE(scene) << scene.error().message;
    size_t instances = 0;
    for (const scene::Layer& layer : scene->layers) {
        instances += layer.instances.size();
        std::string glb = std::filesystem::path(layer.asset).stem().string() + ".glb";
        EXPECT_TRUE(std::filesystem::exists(folder / glb)) << glb;
    }
    EXPECT_EQ(instances, 50u);
    EXPECT_TRUE(scene::read_flight(folder / "flight.json"));
}
TEST(SamplePlants, WriteHillsToPlantThatAreGentle) {
    ScratchFolder folder;
    ASSERT_TRUE(make_plants("sunflowers", {3, 50}, folder.path()));
    auto scene = scene::read_scene(folder / "planting.json");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->layers.size(), 2u);
    ASSERT_TRUE(scene->layers[1].planting);
    EXPECT_EQ(scene->layers[1].planting->seed, 3u);
    ASSERT_EQ(scene->layers[1].planting->models.size(), 11u);
    for (const std::string& model : scene->layers[1].planting->models) {
        std::string glb = std::filesystem::path(model).stem().string() + ".glb";
        EXPECT_TRUE(std::filesystem::exists(folder / glb)) << glb;
    }
    EXPECT_GT(std::filesystem::file_size(folder / "land.tif"), size_t(kLandSide) * kLandSide * sizeof(float));
    EXPECT_GT(std::filesystem::file_size(folder / "land.png"), 10'000u);

    double steepest = 0, low_m = 1e9, high_m = -1e9;
    for (double south_m = 1; south_m < 799; south_m += 7)
        for (double east_m = 1; east_m < 799; east_m += 7) {
            double east = (land_height_m(3, east_m + 0.1, south_m) - land_height_m(3, east_m - 0.1, south_m)) / 0.2;
            double south = (land_height_m(3, east_m, south_m + 0.1) - land_height_m(3, east_m, south_m - 0.1)) / 0.2;
            steepest = std::max(steepest, std::hypot(east, south));
            low_m = std::min(low_m, land_height_m(3, east_m, south_m)),
            high_m = std::max(high_m, land_height_m(3, east_m, south_m));
        }
    EXPECT_LT(steepest, 0.25);
    EXPECT_GT(high_m - low_m, 10);
    auto walk = scene::read_flight(folder / "walk.json");
    ASSERT_TRUE(walk) << walk.error().message;
    for (const scene::Key& key : walk->keys)
        EXPECT_NEAR(key.position_m[2] - land_height_m(3, key.position_m[0], -key.position_m[1]), 1.75, 1e-6);
}
// Those of the stability suite, over the land of sunflowers (seed 1) or over the slopes: an eye's height, but for where they skim.
TEST(SamplePlants, AreFlownOverByTheSuiteAboveTheGround) {
    int flown = 0;
    for (const auto& entry : std::filesystem::directory_iterator(OVERLOOK_SOURCE_DIR "/samples/flights")) {
        std::string name = entry.path().stem().string();
        if (!name.starts_with("planting-")) continue;
        Result<scene::Flight> flight = scene::read_flight(entry.path().string());
        ASSERT_TRUE(flight) << flight.error().message;
        bool is_slopes = name == "planting-slopes";
        double least_m = INFINITY;
        for (uint32_t frame = 0; frame < scene::frame_count(*flight); ++frame) {
            glm::dvec3 at_m = view::camera_at(*flight, scene::frame_time_s(*flight, frame), {}).position_m;
            double ground_m = is_slopes ? slope_height_m(at_m.x, -at_m.y) : land_height_m(1, at_m.x, -at_m.y);
            least_m = std::min(least_m, at_m.z - ground_m);
        }
        EXPECT_GE(least_m, name == "planting-skimming" ? 1.2 * 0.05 - 1e-4 : 1.5) << name;  // 1.2 near planes
        ++flown;
    }
    EXPECT_EQ(flown, 10);
}

TEST(SamplePlants, NameEveryModelAndItsRadiiInTheRecipe) {
    for (const char* name : {"sunflowers", "grass"}) {
        const PlantSet& set = set_of(name);
        std::string recipe = plant_recipe(set, 7);
        EXPECT_NE(recipe.find("seed = 7\n"), std::string::npos);
        std::smatch head;
        ASSERT_TRUE(std::regex_search(recipe, head, std::regex("tile_size_m = ([0-9.]+)\ndensity_per_m2 = ([0-9.]+)\n")));
        double tile_m = std::stod(head[1]), covered_m2 = 0, shares = 0;
        EXPECT_NEAR(std::stod(head[2]) * tile_m * tile_m, set.per_tile, 0.2);
        std::regex model(R"(file = "([^"]+)\"\nshare = ([0-9.]+)\ntight_radius_m = ([0-9.]+)\npacking_radius_m = ([0-9.]+)\n)"
                         R"(scale = \[([0-9.]+), ([0-9.]+)\]\nturn_deg = \[(-?[0-9.]+), ([0-9.]+)\]\n)");
        size_t i = 0;
        for (std::sregex_iterator at(recipe.begin(), recipe.end(), model), end; at != end; ++at, ++i) {
            auto number = [&](size_t group) { return std::stod((*at)[group]); };
            ASSERT_LT(i, set.plants.size());
            EXPECT_EQ((*at)[1], set.plants[i].file);
            for (const glm::vec3& p : set.plants[i].mesh.positions_m) ASSERT_LE(std::hypot(double(p.x), double(p.y)), number(3));
            EXPECT_GT(number(4), number(3));
            EXPECT_LT(number(6) * number(4), tile_m / 4);
            EXPECT_LT(number(5), number(6));
            EXPECT_LT(number(7), number(8));
            double radius_m = number(4) * (number(5) + number(6)) / 2;
            covered_m2 += number(2) * 3.14159265 * radius_m * radius_m, shares += number(2);
        }
        EXPECT_EQ(i, set.plants.size());
        EXPECT_NEAR(set.per_tile * covered_m2 / shares / (tile_m * tile_m), 0.6, 0.02) << name;
    }
}

}  // namespace
}  // namespace overlook::sample
