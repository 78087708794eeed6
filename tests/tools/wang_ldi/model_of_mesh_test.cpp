// A mesh becomes a model with its holes, colours, textures and leaves.
#include "tools/bake/wang_ldi/model_of_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tools/bake/images.h"

namespace overlook::wang_ldi {
namespace {

// Two triangles of two surfaces over the unit square: a masked leaf with a picture of 2 x 2 texels, and bare bark.
mesh::Mesh leaf_and_bark() {
    mesh::Mesh mesh;
    mesh.origin_m = {10, 0, 0};
    mesh.positions_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    mesh.face_surface = {0, 1};
    mesh.face_source = {0, 1};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}};
    mesh.face_uvs = {{0, 1, 2}, {mesh::kNone, mesh::kNone, mesh::kNone}};
    mesh.normals = {{0, 0, 1}};
    mesh.face_normals = {{0, 0, 0}, {mesh::kNone, mesh::kNone, mesh::kNone}};
    const std::vector<uint8_t> texels{255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255, 255, 127};
    auto png = png_bytes(2, 2, 4, texels);
    EXPECT_TRUE(png) << png.error().message;
    mesh::Surface leaf, bark;
    leaf.texture = "leaf.png", leaf.is_alpha_masked = leaf.is_two_sided = true;
    for (std::byte byte : *png) leaf.texture_bytes.push_back(uint8_t(byte));
    bark.base_colour = {0.5f, 0.25f, 0.125f, 1};
    mesh.surfaces = {leaf, bark};
    return mesh;
}

TEST(Models, KeepHolesColoursAndLeaves) {
    Models models;
    auto added = add_model(leaf_and_bark(), {0.25f, false}, models);
    ASSERT_TRUE(added) << added.error().message;
    const rays::Mesh& shape = models.meshes[0];
    EXPECT_EQ(shape.positions_m[1], glm::vec3(11, 0, 0));
    // Of the leaf: u to the right, v down its picture; texel (1, 0) is clear and (1, 1) just below the cutoff.
    EXPECT_TRUE(is_solid(shape, 0, 0.1f, 0.1f));
    EXPECT_FALSE(is_solid(shape, 0, 0.8f, 0.05f));
    EXPECT_FALSE(is_solid(shape, 0, 0.1f, 0.8f));
    EXPECT_TRUE(is_solid(shape, 1, 0.8f, 0.05f));
    std::vector<rays::Copy> copies{{0, glm::mat4x3(1)}};
    Point leaf = point_of(models, copies, {0, 0, 1, 0.1f, 0.1f}, {0, 0, -1});
    EXPECT_EQ(leaf.albedo, glm::vec3(1, 0, 0));
    EXPECT_EQ(leaf.transmission, 0.25f);
    Point bark = point_of(models, copies, {0, 1, 1, 0.3f, 0.3f}, {0, 0, -1});
    EXPECT_LT(glm::distance(bark.albedo, glm::vec3(0.21404f, 0.05088f, 0.01444f)), 1e-4f);  // surfaces' colours are sRGB-encoded
    EXPECT_EQ(bark.transmission, 0);
    EXPECT_EQ(bark.normal, glm::vec3(0, 0, 1));
}

TEST(Models, OfFaintSurfacesAreHolesWhereTheyAreBelowTheCutoff) {
    auto made = [](float alpha, bool has_picture, bool trims_leaves) {
        mesh::Mesh mesh = leaf_and_bark();
        mesh.surfaces[0].base_colour.a = alpha, mesh.surfaces[0].alpha_cutoff = 0.5f;
        if (!has_picture) mesh.surfaces[0].texture_bytes.clear();
        ModelOptions options;
        options.trims_leaves = trims_leaves;
        Models models;
        EXPECT_TRUE(add_model(mesh, options, models));
        return models;
    };
    for (bool has_picture : {false, true}) {
        for (float alpha : {0.0f, 0.4f, 0.5f, 1.0f}) {
            Models whole = made(alpha, has_picture, false);
            ASSERT_EQ(whole.meshes[0].triangles.size(), 2u);
            EXPECT_EQ(is_solid(whole.meshes[0], 0, 0.1f, 0.1f), alpha >= 0.5f) << alpha;  // an opaque texel
            EXPECT_TRUE(is_solid(whole.meshes[0], 1, 0.1f, 0.1f));
            // Of a leaf that is nowhere solid nothing is left; the bark stays.
            std::vector<uint32_t> left = made(alpha, has_picture, true).skins[0].looks_of;
            EXPECT_EQ(std::count(left.begin(), left.end(), 0u) > 0, alpha >= 0.5f) << alpha;
            EXPECT_EQ(std::count(left.begin(), left.end(), 1u), 1);
        }
    }
}

TEST(Models, WithPicturesThatCannotBeReadAreRefusedByName) {
    mesh::Mesh mesh = leaf_and_bark();
    mesh.surfaces[0].texture_bytes.resize(20);
    Models models;
    auto added = add_model(mesh, {}, models);
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().exit, Exit::bad_input);
    EXPECT_EQ(added.error().message.rfind("leaf.png: ", 0), 0u) << added.error().message;
    mesh.surfaces[0].texture_bytes.clear();  // a missing one is as if it were white
    ASSERT_TRUE(add_model(mesh, {}, models));
    EXPECT_TRUE(is_solid(models.meshes.back(), 0, 0.8f, 0.05f));
}

}  // namespace
}  // namespace overlook::wang_ldi
