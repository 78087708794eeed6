// The graphics card's splats show what the exact warper shows.
#include <gtest/gtest.h>

#include "runtime/wang_ldi/draw_splats.h"
#include "runtime/wang_ldi/hole_fill.h"
#include "runtime/wang_ldi/warp_field.h"
#include "tests/gl/fixture.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

struct SplatField : DrawnField {
    std::vector<PreparedLdi> prepared;
    FarImages far_images;

    explicit SplatField(bool has_splats) : DrawnField(Ground(hills())) {
        images.has_splats = has_splats;
        for (Ldi& ldi : ldis) {
            if (has_splats)
                for (uint32_t s = 0; s < ldi.sample_count(); ++s) ldi.splats.push_back(uint8_t(8 + s * 7 % 40));
            prepared.push_back(PreparedLdi::of(ldi));
        }
        far_images = far();
    }
    PreparedAt at_hand() const {
        return [this](uint64_t index) { return &prepared[index]; };
    }
    view::Camera camera(int n) const {
        glm::dvec2 at(401.3 + 37 * n, -533.1 + 21 * n);
        double above = n == 2 ? 25 : 1.8;
        view::Camera camera = head_camera({at, ground.height_m(at) + above}, 70.0 * n, n == 2 ? -40 : -8);
        camera.width_px = 320, camera.height_px = 240;
        return camera;
    }
};
const SplatField& field_with(bool splats) {
    static const SplatField without(false), with(true);
    return splats ? with : without;
}

// What a composite was filled with.
Warped read(const Composite& composite, const view::Camera& camera) {
    Warped picture;
    picture.clear(camera.width_px, camera.height_px);
    auto bytes = GLsizei(picture.colours.size() * 4);
    glGetTextureImage(composite.colours(), 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes, picture.colours.data());
    glGetTextureImage(composite.depths(), 0, GL_RED, GL_FLOAT, bytes, picture.depth_m.data());
    return picture;
}
size_t differing(const Warped& exact, const Warped& other) {
    size_t count = 0;
    for (size_t p = 0; p < exact.colours.size(); ++p)
        count += exact.colours[p] != other.colours[p] ||
                 (exact.colours[p] != 0 && std::abs(exact.depth_m[p] - other.depth_m[p]) > 1e-5f * exact.depth_m[p]);
    return count;
}

void show_what_the_exact_warper_shows(Splats* splats) {
    auto composite = Composite::make();
    ASSERT_TRUE(composite);
    for (bool has_splats : {false, true}) {
        const SplatField& test = field_with(has_splats);
        Field field = test.field(test.far_options());
        for (int n = 0; n < 4; ++n)
            for (bool fills : {false, true}) {
                view::Camera camera = test.camera(n);
                uint32_t finer = n % 2 == 1 ? 2 : 1;
                FieldList list = list_of(field, camera);
                Warped exact = empty_picture(camera);
                WarpCounts counts = warp_field(camera, field, list, test.all(), Hiding::by_depth, exact, &test.far_images, finer);
                uint64_t filled = fills ? fill_holes(exact, finer) : 0;
                SplatCounts drawn = splats->draw(camera, field, list, test.at_hand(), fills, &test.far_images, *composite, finer);
                EXPECT_LE(differing(exact, read(*composite, camera)), exact.colours.size() / 1000) << n << has_splats << fills;
                EXPECT_GE(drawn.samples, counts.samples);
                EXPECT_NEAR(double(splats->holes_filled()), double(filled), 10 + 0.01 * double(filled));
                EXPECT_EQ(drawn.images_missing, 0u);
                EXPECT_EQ(std::count_if(exact.colours.begin(), exact.colours.end(), [](uint32_t c) { return c != 0; }) > 5000,
                          true);
            }
    }
}

TEST(Splats, ShowWhatTheExactWarperShows) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto splats = Splats::make(false);
    ASSERT_TRUE(splats) << splats.error().message;
    show_what_the_exact_warper_shows(&*splats);
}

TEST(Splats, ShowTheSameInOneRound) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto splats = Splats::make(true);
    ASSERT_TRUE(splats) << splats.error().message;
    if (!splats->is_in_one_round()) GTEST_SKIP() << "no 64-bit atomics in OpenGL here";
    show_what_the_exact_warper_shows(&*splats);
}

TEST(Splats, KeepImagesAsLongAsTheyAreAtHand) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto composite = Composite::make();
    auto splats = Splats::make();
    ASSERT_TRUE(composite && splats);
    const SplatField& test = field_with(false);
    Field field = test.field(test.far_options());
    view::Camera camera = test.camera(0);
    FieldList list = list_of(field, camera);
    SplatCounts first = splats->draw(camera, field, list, test.at_hand(), true, &test.far_images, *composite);
    Warped whole = read(*composite, camera);
    uint64_t bytes = splats->bytes();
    SplatCounts again = splats->draw(camera, field, list, test.at_hand(), true, &test.far_images, *composite);
    EXPECT_GE(first.uploaded_bytes, again.uploaded_bytes + bytes);
    EXPECT_EQ(splats->bytes(), bytes);
    EXPECT_EQ(again.samples, first.samples);
    EXPECT_TRUE(read(*composite, camera).colours == whole.colours);
    SplatCounts none = splats->draw(
        camera, field, list, [](uint64_t) -> const PreparedLdi* { return nullptr; }, true, nullptr, *composite);
    EXPECT_GT(none.images_missing, 10u);
    EXPECT_EQ(none.samples, 0u);
    EXPECT_EQ(splats->bytes(), 0u);
    Warped empty = read(*composite, camera);
    EXPECT_EQ(size_t(std::count(empty.colours.begin(), empty.colours.end(), 0u)), empty.colours.size());
}

}  // namespace
}  // namespace overlook::wang_ldi
