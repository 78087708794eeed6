// Prints the hash of a picture of the hilly terrain: shaded and wireframe.

#include <cstdio>

#include "formats/mapped_file.h"
#include "runtime/terrain/draw.h"
#include "tests/gl/fixture.h"

int main() {
    using namespace overlook;
    std::string reason;
    std::optional<gl::Context> context = test::software_context(reason);
    if (!context) return 5;
    terrain::Terrain terrain = test::hilly_terrain(129);
    auto target = gl::Target::make(640, 360, 4);
    auto drawing = terrain::Drawing::make(terrain);
    if (!target || !drawing) return 70;
    for (terrain::Look look : {terrain::Look::shaded, terrain::Look::wireframe}) {
        terrain::DrawOptions options;
        options.look = look;
        drawing->draw(*target, test::everything(terrain), test::from_south(terrain, 640, 360), options);
        ImageRgb8 image = target->read();
        std::puts(content_hash(std::as_bytes(std::span(image.pixels))).c_str());
    }
    return 0;
}
