#include "runtime/lod_sprite/paper_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/lod_sprite/paper_fixture.h"

namespace overlook::lod_sprite::paper {
namespace {

// Looks north from the origin; at 100 m a pixel is 1/3 m wide.
view::Camera looking_north() {
    view::Camera camera = test::square_camera({0, 0, 0}, 0, 0);
    camera.near_m = 1;
    return camera;
}

// A depth buffer that holds one depth; 0 = the background.
std::vector<float> buffer_of(const view::Camera& camera, double depth_m) {
    return std::vector<float>(size_t(camera.width_px) * camera.height_px, depth_m > 0 ? float(camera.near_m / depth_m) : 0.0f);
}

KeyDepth wall(double depth_m) {
    KeyDepth key;
    key.keep(looking_north(), buffer_of(looking_north(), depth_m));
    return key;
}

DepthTest metres(double thickness) {
    return {DepthSpace::eye, thickness, 0};
}

TEST(PaperDepthTest, ComparesMetresInEyeSpace) {
    KeyDepth key = wall(100);
    EXPECT_TRUE(key.is_visible({3, 100, 4}, metres(0.01)));
    EXPECT_TRUE(key.is_visible({3, 104.9, 4}, metres(5)));
    EXPECT_FALSE(key.is_visible({3, 105.1, 4}, metres(5)));
    EXPECT_TRUE(key.is_visible({3, 95.1, 4}, metres(5)));
    EXPECT_FALSE(key.is_visible({3, 94.9, 4}, metres(5)));
}

TEST(PaperDepthTest, ComparesAnOrdinaryDepthBufferInWindowSpace) {
    // z(100) = 1000 * 99 / (100 * 999) and z(110) = 1000 * 109 / (110 * 999) differ by 1 / 1098.9.
    KeyDepth key = wall(100);
    DepthTest window{DepthSpace::window, 0, 1000};
    for (double thickness : {0.00092, 0.00090}) {
        window.thickness = thickness;
        EXPECT_EQ(key.is_visible({0, 110, 0}, window), thickness > 1 / 1098.9);
    }
    // The same thickness is a few centimetres deep close by, and the whole distance far off.
    EXPECT_FALSE(wall(4).is_visible({0, 4.1, 0}, window));
    EXPECT_TRUE(wall(900).is_visible({0, 560, 0}, window));
}

TEST(PaperDepthTest, HidesWhatTheFrameDidNotShow) {
    KeyDepth key = wall(100);
    DepthTest any = metres(1e9);
    EXPECT_TRUE(key.is_visible({0, 100, 0}, any));
    EXPECT_TRUE(key.is_visible({99.9, 100, -99.9}, any));
    EXPECT_FALSE(key.is_visible({100.1, 100, 0}, any));
    EXPECT_FALSE(key.is_visible({-100.1, 100, 0}, any));
    EXPECT_FALSE(key.is_visible({0, 100, 100.1}, any));
    EXPECT_FALSE(key.is_visible({0, 100, -100.1}, any));
    EXPECT_FALSE(key.is_visible({0, 0.9, 0}, any));   // before the near plane
    EXPECT_FALSE(key.is_visible({0, -100, 0}, any));  // behind
    EXPECT_FALSE(key.is_visible({0, 1001, 0}, {DepthSpace::window, 2, 1000}));
}

TEST(PaperDepthTest, TakesTheClosestPixel) {
    view::Camera camera = looking_north();
    std::vector<float> depth = buffer_of(camera, 50);
    // Only pixel (420, 150) holds a wall at 100 m. Its middle is 120.5 px right of the frame's and 149.5 px up.
    depth[150 * 600 + 420] = 1 / 100.f;
    KeyDepth key;
    key.keep(camera, depth);
    auto is_visible = [&](double x_px, double y_px) { return key.is_visible({x_px / 3, 100, y_px / 3}, metres(1)); };
    EXPECT_TRUE(is_visible(120.5, 149.5));
    EXPECT_TRUE(is_visible(120.01, 149.99) && is_visible(120.99, 149.01));
    EXPECT_FALSE(is_visible(119.99, 149.5) || is_visible(121.01, 149.5));
    EXPECT_FALSE(is_visible(120.5, 150.01) || is_visible(120.5, 148.99));
}

TEST(PaperDepthTest, TakesFarThingsForTheSkyInWindowSpaceAlone) {
    KeyDepth sky = wall(0);
    EXPECT_FALSE(sky.is_visible({0, 1e6, 0}, metres(1e9)));
    DepthTest window{DepthSpace::window, 1e-5, 100'000};
    EXPECT_FALSE(sky.is_visible({0, 10'000, 0}, window));
    EXPECT_TRUE(sky.is_visible({0, 99'000, 0}, window));
}

// 9 x 9 samples north of the eye, 10 m apart, all in the frame; the triangles below are seen unless something stands before them.
struct Ground {
    terrain::Terrain terrain = test::plain_terrain(9);
    view::Camera camera = test::square_camera({40, -300, 100}, 0, -20);

    // The depth buffer of the ground alone, each pixel's by its ray.
    std::vector<float> depth() const {
        std::vector<float> depth;
        view::Axes axes = view::axes_of(camera);
        for (uint32_t row = 0; row < 600; ++row)
            for (uint32_t column = 0; column < 600; ++column) {
                glm::dvec3 way = axes.forward + axes.right * ((column + 0.5) / 300 - 1) + axes.up * (1 - (row + 0.5) / 300);
                depth.push_back(way.z < 0 ? float(camera.near_m / (-camera.position_m.z / way.z)) : 0.0f);
            }
        return depth;
    }
    // Puts something 10 m from the eye before a sample.
    void hide(std::vector<float>& depth, uint32_t column, uint32_t row) const {
        view::Axes axes = view::axes_of(camera);
        glm::dvec3 p = glm::dvec3(10 * column, -10.0 * row, 0) - camera.position_m;
        double x_px = 300 + 300 * glm::dot(p, axes.right) / glm::dot(p, axes.forward);
        double y_px = 300 - 300 * glm::dot(p, axes.up) / glm::dot(p, axes.forward);
        depth[size_t(y_px) * 600 + size_t(x_px)] = float(camera.near_m / 10);
    }
};

std::vector<uint8_t> flags_of(TriangleFlags& flags, const KeyDepth& key, const terrain::Cut& cut) {
    std::vector<uint8_t> is_visible;
    flags.read(key, cut, is_visible);
    return is_visible;
}

TEST(PaperFlags, ShowATriangleOnlyIfAllItsVerticesWere) {
    Ground ground;
    std::vector<float> depth = ground.depth();
    ground.hide(depth, 0, 0);
    KeyDepth key;
    key.keep(ground.camera, depth);
    terrain::Cut cut = test::squares_cut(9, 8);  // the hidden corner is one of both triangles
    for (uint32_t corner : {8u, 72u, 80u}) cut.indices.push_back(corner);
    TriangleFlags flags(ground.terrain, metres(3), NewTriangles::hidden);
    flags.start(key, cut);
    EXPECT_EQ(flags_of(flags, key, cut), (std::vector<uint8_t>{0, 0, 1}));
}

TEST(PaperFlags, ShowATriangleWhoseInsideAloneIsHidden) {
    // The fault that the paper names and accepts.
    Ground ground;
    std::vector<float> depth = ground.depth();
    for (uint32_t column = 1; column < 8; ++column) ground.hide(depth, column, 4);
    KeyDepth key;
    key.keep(ground.camera, depth);
    terrain::Cut cut = test::squares_cut(9, 8);
    TriangleFlags flags(ground.terrain, metres(3), NewTriangles::hidden);
    flags.start(key, cut);
    EXPECT_EQ(flags_of(flags, key, cut), (std::vector<uint8_t>{1, 1}));
}

TEST(PaperFlags, OfNewTrianglesAreTestedOrHidden) {
    Ground ground;
    std::vector<float> depth = ground.depth();
    ground.hide(depth, 4, 4);
    KeyDepth key;
    key.keep(ground.camera, depth);
    terrain::Cut coarse = test::squares_cut(9, 8), fine = test::squares_cut(9, 4);
    for (NewTriangles fresh : {NewTriangles::hidden, NewTriangles::tested}) {
        TriangleFlags flags(ground.terrain, metres(3), fresh);
        flags.start(key, coarse);
        std::vector<uint8_t> is_visible = flags_of(flags, key, fine);
        bool is_tested = fresh == NewTriangles::tested;
        // Of the eight triangles six have the hidden vertex in the middle.
        EXPECT_EQ(std::count(is_visible.begin(), is_visible.end(), 1), is_tested ? 2 : 0);
        EXPECT_EQ(flags_of(flags, key, fine), is_visible);
        EXPECT_EQ(flags_of(flags, key, coarse), (std::vector<uint8_t>{1, 1}));
    }
}

TEST(PaperFlags, AreTheTrianglesWhereverItsCornersBegin) {
    Ground ground;
    KeyDepth key;
    key.keep(ground.camera, ground.depth());
    terrain::Cut cut = test::squares_cut(9, 8), turned;
    for (size_t i = 0; i < cut.indices.size(); i += 3)
        for (size_t j : {i + 1, i + 2, i}) turned.indices.push_back(cut.indices[j]);
    TriangleFlags flags(ground.terrain, metres(3), NewTriangles::hidden);
    flags.start(key, cut);
    EXPECT_EQ(flags_of(flags, key, turned), (std::vector<uint8_t>{1, 1}));
}

TEST(PaperFlags, AreForgottenWithTheirKeyframe) {
    Ground ground;
    std::vector<float> depth = ground.depth();
    KeyDepth key;
    key.keep(ground.camera, depth);
    terrain::Cut cut = test::squares_cut(9, 4);
    TriangleFlags flags(ground.terrain, metres(3), NewTriangles::tested);
    flags.start(key, cut);
    std::vector<uint8_t> before = flags_of(flags, key, cut);
    EXPECT_EQ(std::count(before.begin(), before.end(), 1), 8);
    ground.hide(depth, 4, 4);
    key.keep(ground.camera, depth);
    flags.start(key, cut);
    std::vector<uint8_t> after = flags_of(flags, key, cut);
    EXPECT_EQ(std::count(after.begin(), after.end(), 1), 2);
}

TEST(PaperTable, KeepsWhatItWasGivenUntilItIsCleared) {
    TripleTable table;
    for (int round = 0; round < 3; ++round) {
        bool is_new = false;
        for (uint32_t i = 0; i < 5000; ++i) {
            table.at({i, i * 7, i % 3}, i, is_new);
            ASSERT_TRUE(is_new) << i;
        }
        for (uint32_t i = 0; i < 5000; ++i) {
            ASSERT_EQ(table.at({i, i * 7, i % 3}, 0, is_new), i);
            ASSERT_FALSE(is_new);
        }
        EXPECT_EQ(table.size(), 5000u);
        table.clear();
        EXPECT_EQ(table.size(), 0u);
    }
}

}  // namespace
}  // namespace overlook::lod_sprite::paper
