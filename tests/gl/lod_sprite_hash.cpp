// Prints the hashes of two novel frames, each from two keys at four samples a pixel.

#include <cstdio>

#include "formats/mapped_file.h"
#include "tests/gl/lod_sprite_scene.h"

int main() {
    using namespace overlook;
    std::string reason;
    std::optional<gl::Context> context = test::software_context(reason);
    if (!context) return 5;
    test::SpriteScene scene(test::hilly_terrain(129), 4);
    scene.make_key(0, scene.pose(0), 1.15, 2);
    scene.make_key(1, scene.pose(10), 1.15, 2);
    scene.options.keys = {{0, 0.3}, {1, 0.7}};
    for (double step_m : {6.0, 25.0}) {
        ImageRgb8 image = scene.novel(scene.pose(step_m));
        std::puts(content_hash(std::as_bytes(std::span(image.pixels))).c_str());
    }
    return 0;
}
