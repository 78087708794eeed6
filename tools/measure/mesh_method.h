// The methods of meshes: CAVECLOD in its variants, and levels for the whole of a mesh.
#pragma once

#include <memory>

#include "runtime/caveclod/draw_frames.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// How a caveclod refines.
caveclod::FrameOptions refining_of(const MethodSpec& spec);
// What a frame of it took. resident_bytes: of the mesh in the renderer's memory, without the cameras' faces.
Counters counters_of(const caveclod::FrameCounts& counts, uint64_t resident_bytes);

// spec: of caveclod. The world's must be a mesh.
std::unique_ptr<Method> make_caveclod_method(World& world, const MethodSpec& spec);

// Levels of at most half the triangles each, one for all of the mesh, exchanged at once.
std::unique_ptr<Method> make_discrete_method(World& world, double error_px);

}  // namespace overlook::measure
