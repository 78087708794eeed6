// Plants' triangles drawn by the processor's own hand are those that OpenGL draws.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <set>

#include "runtime/wang_ldi/draw_plants.h"
#include "runtime/wang_ldi/plant_raster.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kWide = 320, kHigh = 240;

// Stripes across, in a file as chains have it.
std::vector<std::byte> stripes(const ScratchFolder& folder) {
    ImageRgb8 image{32, 16, {}};
    for (uint32_t y = 0; y < 16; ++y)
        for (uint32_t x = 0; x < 32; ++x)
            for (uint32_t c : {x * 8, y * 16, 255 - x * 6}) image.pixels.push_back(uint8_t(c));
    EXPECT_TRUE(write_png(folder / "stripes.png", image));
    std::ifstream file(folder / "stripes.png", std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    auto view = std::as_bytes(std::span(bytes));
    return {view.begin(), view.end()};
}

// 16 x 16 pixels as a PNG in hexadecimal: columns of transparent red, and of blue that is not, in turn.
constexpr std::string_view kColumns =
    "89504e470d0a1a0a0000000d49484452000000100000001008060000001ff3ff610000001b4944415478da63f8cf0002ffff934b338c1a30"
    "6ac0a801c3c50000e6b97e90b0d5dc910000000049454e44ae426082";
std::vector<std::byte> columns() {
    std::vector<std::byte> bytes;
    for (size_t i = 0; i < kColumns.size(); i += 2)
        bytes.push_back(std::byte(std::stoi(std::string(kColumns.substr(i, 2)), nullptr, 16)));
    return bytes;
}

// A globe upon the ground, its picture once round it, and a leaf beside it that lets light through.
std::vector<discrete::Chain> chains(const ScratchFolder& folder) {
    discrete::Chain globe = discrete::made::empty_chain({-1, -1, 0}, 2);
    for (uint32_t rows : {24u, 12u}) {
        discrete::Level level = discrete::made::globe(globe, {0, 0, 1}, 0.9, rows, {250, 230, 200, 255});
        for (uint32_t v = 0; v < level.vertices.size(); ++v)
            level.vertices[v].uv = {uint16_t(65535 * (v % (2 * rows + 1)) / (2 * rows)),
                                    uint16_t(65535 * (v / (2 * rows + 1)) / rows)};
        discrete::made::end_level(globe, std::move(level), rows == 24 ? 0 : 0.01);
    }
    globe.surfaces[0].texture = "stripes.png", globe.surfaces[0].texture_bytes = stripes(folder);
    discrete::Chain leaf = discrete::made::empty_chain({-1, -1, 0}, 2);
    discrete::Level level;
    discrete::made::add_quad(leaf, level, {glm::dvec3{-0.8, -0.1, 0.2}, {0.7, -0.3, 0.3}, {0.6, 0.2, 1.6}, {-0.5, 0.3, 1.4}},
                             {90, 200, 60, 255});
    discrete::made::end_level(leaf, std::move(level), 0);
    leaf.surfaces[0].is_two_sided = true;
    return {globe, leaf};
}

Planting planting() {
    Planting planting;
    planting.tile_size_m = 4, planting.models.resize(2), planting.tiles.resize(1);
    for (Model& model : planting.models) model.tight_radius_m = 0.5f;
    planting.tiles[0] = {{0, 1, 1, 0, 1, Owner::interior}, {1, 3, 3, 0, 1, Owner::interior}};
    return planting;
}

// All round the eye, some through it.
std::vector<PlantPlaces> places(bool fades) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PlantPlaces> all(2);
    for (int n = 0; n < 60; ++n) {
        double turn = 6.28 * unit(random), away_m = 0.4 + 12 * unit(random) * unit(random), heading = 6.28 * unit(random);
        PlantPlaces& of = all[size_t(n % 2)];
        of.placements.push_back({{away_m * std::sin(heading), away_m * std::cos(heading), 0.3 * unit(random) - 0.2},
                                 std::cos(turn),
                                 std::sin(turn),
                                 0.6 + unit(random)});
        of.shares.push_back(fades && n % 3 == 0 ? 0.4f : 1.0f);
    }
    return all;
}

view::Camera camera() {
    view::Camera camera;
    camera.position_m = {0.1, -0.2, 1.3}, camera.heading_deg = 20, camera.pitch_deg = -8;
    camera.width_px = kWide, camera.height_px = kHigh, camera.near_m = 0.05;
    return camera;
}

struct Both {
    ImageRgb8 by_opengl;
    std::vector<float> depth;
    Warped by_processor;
};
void draw(Plants& plants, bool fades, Both& both, double fade = 0) {
    auto target = gl::Target::make(kWide, kHigh, 1);
    ASSERT_TRUE(target);
    target->bind();
    const GLfloat black[] = {0, 0, 0, 1}, farthest = 0;
    glClearBufferfv(GL_COLOR, 0, black);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    std::vector<PlantList> lists = plant_lists(plants.forms(), places(fades), camera(), {1, fade});
    PlantCounts counts = plants.draw(*target, camera(), lists, 0);
    EXPECT_GT(counts.plant_count, 10u);
    EXPECT_EQ(counts.triangle_count, counts_of(lists).triangle_count);
    target->resolve();
    both.by_opengl = target->read(), both.depth = target->read_depth();
    both.by_processor.clear(kWide, kHigh);
    ASSERT_EQ(plants.shapes().size(), 2u);
    PlantRaster raster;
    raster.draw(camera(), plants.shapes(), plants.light(), lists);
    raster.lay_over(both.by_processor);
}

// Outlines may be rounded to another pixel, light and pictures between pixels to another tone.
void expect_alike(const Both& both) {
    size_t other_place = 0, other_depth = 0, other_colour = 0, covered = 0;
    double difference = 0;
    for (size_t p = 0; p < size_t(kWide) * kHigh; ++p) {
        bool is_there = both.by_processor.colours[p] != 0;
        other_place += is_there != (both.depth[p] > 0);
        if (!is_there || both.depth[p] == 0) continue;
        ++covered;
        other_depth += !(std::abs(0.05f / both.depth[p] - both.by_processor.depth_m[p]) < 2e-3f * both.by_processor.depth_m[p]);
        int most = 0;
        for (size_t c = 0; c < 3; ++c)
            most = std::max(most,
                            std::abs(int(both.by_opengl.pixels[3 * p + c]) - int(both.by_processor.colours[p] >> (8 * c) & 255)));
        other_colour += most > 10, difference += most;
    }
    EXPECT_GT(covered, size_t(kWide) * kHigh / 3);
    EXPECT_LE(other_place, covered / 1000);
    EXPECT_LE(other_depth, covered / 500);
    EXPECT_LE(other_colour, covered / 100);
    EXPECT_LE(difference / double(covered), 1.5);
}

TEST(PlantsByTheProcessor, AreThoseOfOpenGl) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    std::vector<discrete::Chain> of = chains(folder);
    for (const glm::dvec3& to_sun : {glm::dvec3(0), glm::normalize(glm::dvec3(0.3, -0.6, 0.8))}) {
        auto plants = Plants::make(of, planting(), to_sun);
        ASSERT_TRUE(plants) << plants.error().message;
        for (bool fades : {false, true}) {
            Both both;
            draw(*plants, fades, both, fades ? 0.9 : 0);
            expect_alike(both);
        }
    }
}

// Two levels of one place, red and blue, before green: each pixel is of both by whole samples, and none shows what is behind.
TEST(PlantsOfTwoLevels, ShareTheSamplesOfAPixel) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    std::vector<discrete::Chain> of{discrete::made::empty_chain(glm::dvec3(-5), 10)};
    for (bool is_coarse : {false, true}) {
        discrete::Level level;
        discrete::made::add_quad(of[0], level, {glm::dvec3{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}},
                                 is_coarse ? discrete::made::Colour{0, 0, 255, 255} : discrete::made::Colour{255, 0, 0, 255});
        discrete::made::end_level(of[0], std::move(level), is_coarse ? 0.02 : 0);
    }
    Planting one = planting();
    one.models.resize(1), one.tiles[0].resize(1);
    auto plants = Plants::make(of, one, glm::dvec3(0));
    ASSERT_TRUE(plants) << plants.error().message;
    view::Camera from;
    from.width_px = 128, from.height_px = 96, from.fov_y_deg = 10, from.near_m = 0.05;
    size_t mixed = 0;
    for (double away_m = 5; away_m < 27; away_m += 1.3) {
        auto target = gl::Target::make(128, 96, 4);
        ASSERT_TRUE(target);
        target->bind();
        const GLfloat green[] = {0, 1, 0, 1}, farthest = 0;
        glClearBufferfv(GL_COLOR, 0, green);
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        std::vector<PlantPlaces> places{{{{{0, away_m, 0}}}, {1.0f}}};
        std::vector<PlantList> lists = plant_lists(plants->forms(), places, from, {1, 0.5});
        plants->draw(*target, from, lists, 0);
        target->resolve();
        ImageRgb8 picture = target->read();
        std::set<int> blues;
        size_t behind = 0;
        for (size_t p = 0; p < size_t(128) * 96; ++p)
            behind += picture.pixels[3 * p + 1] > 0, blues.insert(picture.pixels[3 * p + 2]);
        EXPECT_EQ(behind, 0u) << away_m;
        EXPECT_LE(blues.size(), 2u) << "steps of a sample on either side of the share, " << away_m;
        mixed += *blues.begin() > 0 && *blues.begin() < 255;
    }
    EXPECT_GT(mixed, 2u);
}

TEST(PlantsByTheProcessor, HaveFacesOfTheirOwnWithoutNormals) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    std::vector<discrete::Chain> of = chains(folder);
    of[0].attributes.normals = false;
    of[1].levels[0].is_plain = true;
    auto plants = Plants::make(of, planting(), glm::normalize(glm::dvec3(0.3, -0.6, 0.8)));
    ASSERT_TRUE(plants) << plants.error().message;
    Both both;
    draw(*plants, false, both);
    expect_alike(both);
}

// What is transparent counts as much as what is not where nothing is held against a threshold.
TEST(PlantsByTheProcessor, HavePicturesInPlainMeansUnlessTheyAreMasked) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    for (bool is_masked : {false, true}) {
        std::vector<discrete::Chain> of = chains(folder);
        caveclod::Surface& surface = of[0].surfaces[0];
        surface.texture = "columns.png", surface.texture_bytes = columns();
        surface.is_alpha_masked = is_masked, surface.alpha_cutoff = 0.2f;
        of[0].uv_step *= 10000;  // nowhere as large as it is
        auto plants = Plants::make(of, planting(), glm::dvec3(0));
        ASSERT_TRUE(plants) << plants.error().message;
        Both both;
        draw(*plants, false, both);
        expect_alike(both);
        EXPECT_EQ(plants->shapes()[0].skins[0].levels.back().texels[0][0] == 0, is_masked);
    }
}

TEST(PlantsByTheProcessor, AreLeftToOpenGlIfTheyMove) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    std::vector<discrete::Chain> of{discrete::made::windmill_chain()};
    Planting one = planting();
    one.models.resize(1), one.tiles[0].resize(1);
    auto plants = Plants::make(of, one, glm::dvec3(0));
    ASSERT_TRUE(plants) << plants.error().message;
    EXPECT_TRUE(plants->shapes().empty());
}

}  // namespace
}  // namespace overlook::wang_ldi
