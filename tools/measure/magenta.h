// Planted ground over magenta: where it shows through what is planted on it, which no plant is coloured like, is a hole.
#pragma once

#include "formats/image.h"
#include "tools/measure/method.h"
#include "tools/measure/numbers/gaps.h"
#include "tools/measure/world.h"

namespace overlook::measure {

struct Magenta {
    Gaps anywhere,
        in_cell;  // in_cell: of plants as far from the eye, on the ground, as images were sampled for, and from as high
    ImageRgb8 worst, truth;  // the picture with the most gaps in the cell, and the plants themselves
};

// Paints the ground of a scene's planting magenta and takes the air away; before it is uploaded. Nothing else of it changes.
void paint_magenta(World& world);

// Draws a method's pictures of such a world, and its plants by geometry from the same places, one sample a pixel. A gap is a
// pixel where the method shows the ground or the sky and the plants, there and all round, do not. Fails with Exit::impossible
// (targets).
Result<Magenta> gaps_over_magenta(World& magenta, const MethodSpec& spec, std::span<const view::Camera> cameras);

}  // namespace overlook::measure
