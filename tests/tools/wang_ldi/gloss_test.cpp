// What is mirrored is what optics says: nothing of what sends light back evenly, of white metal nearly all that falls on it, the
// sun where its angle is that of the eye.
#include "tools/bake/wang_ldi/gloss.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/shade_rays.h"

namespace overlook::wang_ldi {
namespace {

rays::Scene open_ground() {
    return std::move(*rays::Scene::build({}, {}, rays::Layout::flattened));
}
Point plate(float roughness, float metallic, const glm::vec3& to_eye) {
    Point point;
    point.face = point.normal = {0, 0, 1}, point.albedo = glm::vec3(1), point.to_eye = glm::normalize(to_eye);
    point.roughness = roughness, point.metallic = metallic;
    return point;
}
Light sun_alone(const glm::vec3& to_sun) {
    Light light;
    light.to_sun = to_sun, light.sun = glm::vec3(1), light.sky = light.ground = glm::vec3(0);
    return light;
}

TEST(Gloss, OfRoughnessOneWithoutMetalIsNone) {
    rays::Scene open = open_ground();
    Light with, without;
    without.has_gloss = false;
    Point even = plate(1, 0, {0, 1, 1}), glossy = plate(0.3f, 0, {0, 1, 1});
    EXPECT_EQ(lit(open, even, with, 1), lit(open, even, without, 1));
    EXPECT_NE(lit(open, glossy, with, 1), lit(open, glossy, without, 1));
}

TEST(Gloss, OfWhiteMetalUnderAWhiteSkyIsTheSky) {
    rays::Scene open = open_ground();
    Light light;
    light.sun = glm::vec3(0), light.sky = light.ground = glm::vec3(0.5f), light.sky_rays = 256;
    EXPECT_NEAR(lit(open, plate(0.2f, 1, {0, 0, 1}), light, 1).g, 0.5, 0.005);
    // Light that facets send on to others is lost: what the same integral over the sun's directions gives, by midpoints.
    EXPECT_NEAR(lit(open, plate(0.9f, 1, {0, 1, 2}), light, 1).g, 0.5 * 0.4332, 0.005);
}

// Over all eyes of the hemisphere nearly as much as falls on it: by midpoints over angles.
TEST(Gloss, OfTheSunIsSentSomewhere) {
    rays::Scene open = open_ground();
    Light light = sun_alone({0.5f, 0, 1});
    double cosine = 1 / std::sqrt(1.25), sum = 0;
    ShadowRays rays;
    constexpr int kRings = 200, kSectors = 400;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
            double off = (ring + 0.5) / kRings * M_PI / 2, round = (sector + 0.5) / kSectors * 2 * M_PI;
            glm::dvec3 eye(std::sin(off) * std::cos(round), std::sin(off) * std::sin(round), std::cos(off));
            double solid = std::sin(off) * (M_PI / 2 / kRings) * (2 * M_PI / kSectors);
            sum += double(mirrored(open, plate(0.4f, 1, glm::vec3(eye)), light, 1, {0, 0}, rays).g) * std::cos(off) * solid;
        }
    // What falls on it: pi times the sun's share that white sends back, by the cosine.
    EXPECT_NEAR(sum / (M_PI * cosine), 0.9633, 0.005);
}

TEST(Gloss, IsBrightWhereAnglesAreEqual) {
    rays::Scene open = open_ground();
    Light light = sun_alone({-1, 0, 1});
    float towards = lit(open, plate(0.3f, 0, {1, 0, 1}), light, 1).g, beside = lit(open, plate(0.3f, 0, {0, 1, 1}), light, 1).g;
    EXPECT_GT(towards, 1.5f * beside);
    EXPECT_LT(beside, 1.01f * std::sqrt(0.5f));
    light.to_sun = {-1, 0, -0.1f};
    EXPECT_EQ(lit(open, plate(0.3f, 1, {1, 0, 1}), light, 1).g, 0);
}

TEST(Gloss, OfSamplesIsAsTheirEyeSeesIt) {
    Models models = plants::models();
    for (Skin& skin : models.skins)
        for (Look& look : skin.looks) look.roughness = 0.3f;
    std::vector<TraceStage> stages;
    auto stage = stage_of(models, copies_of(plants::one_tile(), plants::planting(3), alone(0)), 1u << 30);
    ASSERT_TRUE(stage);
    stages.push_back(std::move(*stage));
    Wedge wedge{4, 0, 1, 40, 6, 12, 1.5, 1.9, 0, M_PI / 4};
    SampleOptions options;
    options.fixed_rays = 20'000;
    Sampled all = sampled(models, stages, wedge, options);
    ASSERT_GT(all.samples.size(), 100u);
    glm::vec3 eye = middle_eye_m(wedge);
    EXPECT_NEAR(double(eye.y), 2 + std::sqrt(72.0), 1e-4);
    auto here = lit_samples(models, stages, all.samples, eye, {}, 1),
         there = lit_samples(models, stages, all.samples, {9, 0, 2}, {}, 1);
    Light without;
    without.has_gloss = false;
    auto even = lit_samples(models, stages, all.samples, eye, without, 1),
         even_there = lit_samples(models, stages, all.samples, {9, 0, 2}, without, 1);
    size_t differing = 0;
    for (size_t i = 0; i < here.size(); ++i) {
        differing += here[i] != there[i];
        ASSERT_EQ(even[i], even_there[i]);
    }
    EXPECT_GT(differing, here.size() / 2);
}

}  // namespace
}  // namespace overlook::wang_ldi
