// Cards cut to their leaves show rays the same as whole ones, with less to meet.
#include "tools/bake/wang_ldi/trim.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"

namespace overlook::wang_ldi {
namespace {

// An upright card of two triangles with a leaf: an ellipse, turned, off the middle; or whatever is_solid says of texels.
template <class Solid>
rays::Mesh card_of(uint32_t side, glm::vec2 uv_from, glm::vec2 uv_to, const Solid& is_solid) {
    rays::Mesh mesh;
    rays::Mask mask{side, side, {}, 128};
    for (uint32_t p = 0; p < side * side; ++p) mask.opacity.push_back(is_solid(p % side, p / side) ? 255 : 0);
    mesh.masks = {mask};
    glm::vec3 right(1, 0, 0), up(0, 0, 1);
    plants::add_triangle(mesh, -right, right, right + 2.0f * up),
        plants::add_triangle(mesh, -right, right + 2.0f * up, -right + 2.0f * up);
    glm::vec2 a(uv_from.x, uv_to.y), b = uv_to, c(uv_to.x, uv_from.y), d = uv_from;
    mesh.uvs = {{a, b, c}, {a, c, d}};
    mesh.masks_of = {0, 0};
    return mesh;
}
auto leaf(uint32_t side) {
    return [side](uint32_t x, uint32_t y) {
        double u = (x + 0.5) / side - 0.6, v = (y + 0.5) / side - 0.45, along = 0.8 * u + 0.6 * v, across = 0.8 * v - 0.6 * u;
        return along * along / 0.09 + across * across / 0.01 < 1;
    };
}

std::vector<rays::Hit> hits_of(const rays::Mesh& mesh) {
    std::vector<rays::Mesh> meshes{mesh};
    std::vector<rays::Copy> copies{{0, glm::mat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0})}};
    auto scene = rays::Scene::build(meshes, copies, rays::Layout::flattened);
    EXPECT_TRUE(scene);
    std::vector<rays::Ray> rays;
    Random random(7);
    for (int i = 0; i < 40'000; ++i)
        rays.push_back({{float(2.4 * random.next_unit() - 1.2), -3, float(2.4 * random.next_unit() - 0.2)},
                        {float(0.2 * random.next_unit() - 0.1), 1, float(0.2 * random.next_unit() - 0.1)}});
    std::vector<rays::Hit> hits(rays.size());
    scene->first_hits(rays, hits);
    return hits;
}

// How many of the rays see something else.
int differing(const rays::Mesh& a, const rays::Mesh& b, int& hit) {
    std::vector<rays::Hit> of_a = hits_of(a), of_b = hits_of(b);
    int count = 0;
    hit = 0;
    for (size_t i = 0; i < of_a.size(); ++i) {
        bool in_a = of_a[i].copy != rays::kNone, in_b = of_b[i].copy != rays::kNone;
        hit += in_a;
        count += in_a != in_b || (in_a && std::abs(of_a[i].distance - of_b[i].distance) > 1e-4f);
    }
    return count;
}

TEST(TrimmedLeaves, ShowRaysTheSameAndAreSmaller) {
    struct Case {
        uint32_t side;
        glm::vec2 from, to;
    };
    // Plain; mirrored; repeated and off by whole pictures; a few texels of it.
    for (const Case& one :
         {Case{64, {0, 0}, {1, 1}}, {64, {1, 0}, {0, 1}}, {16, {-3.25f, 5}, {-1.5f, 6.5f}}, {256, {0.4f, 0.3f}, {0.7f, 0.6f}}}) {
        rays::Mesh whole = card_of(one.side, one.from, one.to, leaf(one.side)), cut = whole;
        Skin skin = plants::skin_of({0.2f, 0.5f, 0.1f});
        TrimReport report = trim_to_masks(cut, skin);
        EXPECT_EQ(report.masked_before, 2u);
        EXPECT_EQ(cut.triangles.size(), cut.uvs.size());
        EXPECT_EQ(cut.triangles.size(), cut.masks_of.size());
        EXPECT_LE(report.area_after_m2, report.area_before_m2);
        int hit = 0;
        EXPECT_LE(differing(whole, cut, hit), 1) << one.side;  // a ray on the very border of a texel
        EXPECT_GT(hit, 1000) << one.side;
    }
    rays::Mesh cut = card_of(64, {0, 0}, {1, 1}, leaf(64));
    Skin skin = plants::skin_of({0.2f, 0.5f, 0.1f});
    TrimReport report = trim_to_masks(cut, skin);
    EXPECT_NEAR(report.area_before_m2, 4, 1e-6);
    EXPECT_LT(report.area_after_m2, 0.25 * report.area_before_m2);  // the leaf itself has a tenth
    EXPECT_GT(report.area_after_m2, 0.094 * report.area_before_m2);
}

// Every texel by itself, wherever it stands: it is still there.
TEST(TrimmedLeaves, LoseNoTexel) {
    for (uint32_t texel = 0; texel < 64; ++texel) {
        rays::Mesh whole = card_of(8, {0, 0}, {1, 1}, [&](uint32_t x, uint32_t y) { return y * 8 + x == texel; }), cut = whole;
        Skin skin = plants::skin_of({1, 1, 1});
        TrimReport report = trim_to_masks(cut, skin);
        // Beyond the card's rim its picture begins anew, with the texels of its other rim.
        bool is_inside = std::min(texel % 8, texel / 8) > 0 && std::max(texel % 8, texel / 8) < 7;
        if (is_inside) {
            EXPECT_LT(report.area_after_m2, 0.05 * report.area_before_m2);
        }
        int hit = 0;
        EXPECT_LE(differing(whole, cut, hit), 1) << texel;
        EXPECT_GT(hit, 200) << texel;
    }
}

TEST(TrimmedLeaves, NeedNoMaskWithoutHolesAndNoTriangleWithoutALeaf) {
    Skin skin = plants::skin_of({1, 1, 1});
    rays::Mesh solid = card_of(8, {0, 0}, {1, 1}, [](uint32_t, uint32_t) { return true; });
    EXPECT_EQ(trim_to_masks(solid, skin).solid, 2u);
    EXPECT_EQ(solid.masks_of, (std::vector<uint32_t>{rays::kNone, rays::kNone}));
    rays::Mesh none = card_of(8, {0, 0}, {1, 1}, [](uint32_t, uint32_t) { return false; });
    trim_to_masks(none, skin);
    EXPECT_EQ(none.triangles.size(), 1u);  // a mesh is never empty
    rays::Mesh half = card_of(8, {0, 0}, {1, 1}, [](uint32_t x, uint32_t y) { return x + 1 < 8 - y; });
    trim_to_masks(half, skin);  // a triangle of the two shows the solid half
    EXPECT_LE(half.triangles.size(), 4u);
    // A line in the texture, numbers that are none: left as they are.
    for (float to : {0.0f, NAN, INFINITY, 1e30f}) {
        rays::Mesh odd = card_of(8, {0, 0}, {to, 1}, leaf(8));
        trim_to_masks(odd, skin);
        EXPECT_EQ(odd.triangles.size(), 2u) << to;
        EXPECT_EQ(odd.masks_of[0], 0u);
    }
}

// A card's normals and looks go with its pieces; other triangles stay.
TEST(TrimmedLeaves, KeepTheirLooks) {
    rays::Mesh mesh = card_of(64, {0, 0}, {1, 1}, leaf(64));
    plants::add_triangle(mesh, {5, 0, 0}, {6, 0, 0}, {5, 0, 1});
    mesh.uvs.push_back({}), mesh.masks_of.push_back(rays::kNone);
    Skin skin;
    skin.looks.resize(3), skin.looks_of = {2, 2, 1};
    skin.normals.assign(3, {glm::vec3(0, -1, 0), {0, -1, 0}, {0, -1, 0}});
    trim_to_masks(mesh, skin);
    ASSERT_EQ(skin.looks_of.size(), mesh.triangles.size());
    ASSERT_EQ(skin.normals.size(), mesh.triangles.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_EQ(skin.looks_of[t], mesh.masks_of[t] == rays::kNone ? 1u : 2u);
        for (const glm::vec3& normal : skin.normals[t]) EXPECT_NEAR(normal.y, -1, 1e-6);
    }
    EXPECT_GT(mesh.triangles.size(), 3u);
}

}  // namespace
}  // namespace overlook::wang_ldi
