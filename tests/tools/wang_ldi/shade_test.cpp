// Light is what geometry says: open ground, the shadow of a roof, a half-hidden sky, leaves lit from behind; palettes keep
// colours.
#include "tools/bake/wang_ldi/shade.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/palette.h"

namespace overlook::wang_ldi {
namespace {

Light overhead() {
    Light light;
    light.to_sun = {0, 0, 1}, light.sun = glm::vec3(0.8f), light.sky = glm::vec3(0.4f), light.ground = glm::vec3(0.1f);
    light.sky_rays = 256;
    return light;
}
Point facing(const glm::vec3& normal, float transmission = 0) {
    Point point;
    point.face = point.normal = normal, point.albedo = glm::vec3(0.5f), point.transmission = transmission;
    return point;
}
// A square of 2 * half about (0, 0, height).
rays::Scene roof(std::vector<rays::Mesh>& meshes, float half, float height) {
    meshes.assign(1, rays::Mesh());
    plants::add_triangle(meshes[0], {-half, -half, height}, {half, -half, height}, {half, half, height});
    plants::add_triangle(meshes[0], {-half, -half, height}, {half, half, height}, {-half, half, height});
    std::vector<rays::Copy> copies{{0, glm::mat4x3(1)}};
    return std::move(*rays::Scene::build(meshes, copies, rays::Layout::flattened));
}

TEST(Light, OnOpenGroundIsSunAndSky) {
    auto open = rays::Scene::build({}, {}, rays::Layout::flattened);
    EXPECT_NEAR(lit(*open, facing({0, 0, 1}), overhead(), 1).g, 0.5 * (0.8 + 0.4), 1e-4);
    glm::vec3 slanting = glm::normalize(glm::vec3(0, 1, 1));
    double cosine = std::sqrt(0.5), sky = (1 + cosine) / 2;  // of the cosine-weighted half of directions, those above the horizon
    EXPECT_NEAR(lit(*open, facing(slanting), overhead(), 1).g, 0.5 * (0.8 * cosine + 0.4 * sky + 0.1 * (1 - sky)), 0.01);
    EXPECT_NEAR(lit(*open, facing({0, 0, -1}), overhead(), 1).g, 0.5 * 0.1, 1e-4);
}

TEST(Light, UnderARoofIsTheSkyBesideIt) {
    std::vector<rays::Mesh> meshes;
    rays::Scene scene = roof(meshes, 1, 1);
    // The form factor of a square of 2 x 2 at a distance of 1, seen from below its middle (four corners of Howell's B-4).
    double corner = 1 / (2 * M_PI) * 2 * (1 / std::sqrt(2)) * std::atan(1 / std::sqrt(2)), hidden = 4 * corner;
    EXPECT_NEAR(lit(scene, facing({0, 0, 1}), overhead(), 7).g, 0.5 * 0.4 * (1 - hidden), 0.01);
}

TEST(Light, AtARoofsShadowsRimIsAPartOfTheSun) {
    std::vector<rays::Mesh> meshes;
    rays::Scene scene = roof(meshes, 1, 10);
    Light light = overhead();
    light.sun_radius_deg = 2, light.sun_rays = 256, light.sky = light.ground = glm::vec3(0);
    auto at = [&](float x) {
        Point point = facing({0, 0, 1});
        point.at_m = {x, 0, 0};
        return double(lit(scene, point, light, 3).g) / (0.5 * 0.8);
    };
    EXPECT_EQ(at(0), 0);
    EXPECT_NEAR(at(1), 0.5, 0.03);
    EXPECT_NEAR(at(1.5f), 1, 1e-6);
    double reach = 10 * std::tan(2 * M_PI / 180);
    EXPECT_NEAR(at(float(1 + reach / 2)), 0.8045, 0.03);  // a circle less its segment beyond half the radius
}

TEST(Light, ThroughALeafComesFromBehind) {
    auto open = rays::Scene::build({}, {}, rays::Layout::flattened);
    Light light = overhead();
    light.sky = light.ground = glm::vec3(0);
    EXPECT_EQ(lit(*open, facing({0, 0, -1}), light, 1).g, 0);
    EXPECT_NEAR(lit(*open, facing({0, 0, -1}, 0.25f), light, 1).g, 0.5 * 0.25 * 0.8, 1e-6);
    EXPECT_NEAR(lit(*open, facing({0, 0, 1}, 0.25f), light, 1).g, 0.5 * 0.8, 1e-6);
}

TEST(Points, FaceTheViewerAndHaveTheirSkinsColour) {
    Models models;
    models.meshes = {rays::Mesh()}, models.skins = {Skin{}};
    plants::add_triangle(models.meshes[0], {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    models.meshes[0].uvs = {{glm::vec2(0, 0), {1, 0}, {0, 1}}};
    models.skins[0].normals = {{glm::normalize(glm::vec3(0.2f, 0, 1)), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)}};
    models.skins[0].textures = {{2, 1, {255, 0, 0, 0, 255, 0}}};
    models.skins[0].looks = {{glm::vec3(0.5f), 0, 0.3f}};
    std::vector<rays::Copy> copies{{0, glm::mat4x3({0, 2, 0}, {-2, 0, 0}, {0, 0, 2}, {5, 5, 5})}};
    Point above = point_of(models, copies, {0, 0, 1, 0.75f, 0.1f}, {0, 0, -1});
    EXPECT_NEAR(glm::distance(above.at_m, glm::vec3(5 - 0.2, 5 + 1.5, 5)), 0, 1e-5);
    EXPECT_GT(above.face.z, 0.99f);
    EXPECT_GT(above.normal.y, 0.01f);  // the corner's lean, turned with the copy
    EXPECT_EQ(above.albedo, glm::vec3(0, 0.5f, 0));
    Point below = point_of(models, copies, {0, 0, 1, 0.1f, 0.1f}, {0, 0, 3});
    EXPECT_LT(below.face.z, -0.99f);
    EXPECT_LT(below.normal.z, -0.9f);
    EXPECT_EQ(below.albedo, glm::vec3(0.5f, 0, 0));
    EXPECT_EQ(below.transmission, 0.3f);
}

TEST(Palettes, KeepAFewColoursAsTheyAre) {
    std::vector<Colour> all;
    for (int i = 0; i < 5000; ++i) all.push_back({uint8_t(i % 16 * 16), uint8_t(i % 8 * 32), uint8_t(i % 4 * 64)});
    Palette palette = palette_of(all, 256);
    EXPECT_LE(palette.colours.size(), 16u);
    for (size_t i = 0; i < all.size(); ++i) ASSERT_EQ(palette.colours[palette.indices[i]], all[i]);
}

TEST(Palettes, OfManyColoursAreNearThemAndFromDarkToBright) {
    Random random(5);
    std::vector<Colour> all;
    for (int i = 0; i < 60000; ++i) {
        double leaf = random.next_unit(), shade = 0.2 + 0.8 * random.next_unit();
        all.push_back(
            {uint8_t(200 * leaf * shade), uint8_t((120 + 60 * leaf) * shade), uint8_t(40 * shade + 20 * random.next_unit())});
    }
    Palette palette = palette_of(all, 256);
    double squares = 0;
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t axis = 0; axis < 3; ++axis)
            squares += std::pow(all[i][axis] - palette.colours[palette.indices[i]][axis], 2.0);
    EXPECT_LT(std::sqrt(squares / (3.0 * double(all.size()))), 4.0);
    EXPECT_EQ(palette.colours.size(), 256u);
    auto luma = [](const Colour& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
    for (size_t c = 1; c < palette.colours.size(); ++c) EXPECT_GE(luma(palette.colours[c]) + 1, luma(palette.colours[c - 1]));
    EXPECT_TRUE(palette_of(all, 256).indices == palette.indices);
    EXPECT_EQ(palette_of(all, 1).colours.size(), 1u);
    EXPECT_EQ(palette_of({}, 256).colours.size(), 0u);
}

}  // namespace
}  // namespace overlook::wang_ldi
