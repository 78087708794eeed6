#include "runtime/view/camera.h"

#include <gtest/gtest.h>

namespace overlook::view {
namespace {

Camera camera_of(uint32_t width_px, uint32_t height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

TEST(PartMap, ChangesNothingForTheWholePicture) {
    PartMap map = part_map(camera_of(1281, 719), {0, 0, 1281, 719});
    EXPECT_EQ(map.scale, glm::dvec2(1, 1));
    EXPECT_EQ(map.shift, glm::dvec2(0, 0));
}

// Places in the picture, in pixels from its upper left corner, are in the part where they should be.
TEST(PartMap, MovesPixelsByThePlaceOfThePart) {
    Camera camera = camera_of(640, 360);
    Part part{100, 40, 32, 24};
    PartMap map = part_map(camera, part);
    for (glm::dvec2 at_px : {glm::dvec2(100, 40), glm::dvec2(132, 64), glm::dvec2(117.5, 43.25), glm::dvec2(0, 360)}) {
        glm::dvec2 ndc{2 * at_px.x / 640 - 1, 1 - 2 * at_px.y / 360};
        glm::dvec2 moved = map.scale * ndc + map.shift;
        EXPECT_NEAR((moved.x + 1) * 16, at_px.x - 100, 1e-10);
        EXPECT_NEAR((1 - moved.y) * 12, at_px.y - 40, 1e-10);
    }
}

TEST(PartMap, MayReachBeyondThePicture) {
    PartMap map = part_map(camera_of(100, 100), {90, 90, 20, 20});
    // The picture's lower right corner lies in the middle of the part.
    EXPECT_NEAR(map.scale.x * 1 + map.shift.x, 0, 1e-12);
    EXPECT_NEAR(map.scale.y * -1 + map.shift.y, 0, 1e-12);
}

}  // namespace
}  // namespace overlook::view
