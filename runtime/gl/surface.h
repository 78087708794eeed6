// What a method that colours pixels by itself needs of the things that are drawn: LOD-sprite's sprite sits on any of them.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/gl/program.h"
#include "runtime/view/camera.h"

namespace overlook::gl {

// GLSL that a method puts into how a thing is drawn.
struct SurfaceShader {
    std::string name;  // stands in messages
    // Defines vec3 placed(vec3 relative_m): where a vertex at relative_m (metres from the eye, axes of the thing's own frame) is
    // drawn. May declare outputs of its own and write them there. Empty = where it is.
    std::string vertex;
    // Defines main(). At hand: surface.relative_m, where the pixel's middle meets the thing as drawn; vec3 own_colour(vec3 at_m),
    // the thing's linear colour, before the air, at a place near it (metres from the eye); vec3 behind_air(vec3 linear, vec3
    // at_m); vec3 encoded(vec3 linear), the sRGB encoding that a picture holds; out vec4 colour.
    std::string fragment;
};

// Some of a thing's triangles, in their order.
struct TriangleRange {
    uint64_t first = 0, count = ~uint64_t(0);  // as far as there are
};

// Texture units below this one are the thing's own.
constexpr unsigned kFirstFreeUnit = 4;

// A thing as it was settled for this frame. A context must be current.
class Surface {
  public:
    virtual ~Surface() = default;

    // Fails with Exit::our_bug and the compiler's first complaint.
    virtual Result<Program> program(const SurfaceShader& shader) const = 0;
    // Draws with a program of this surface, in use, whose own uniforms and textures are set, into whatever is bound.
    virtual void draw(const Program& program, const view::Camera& camera) = 0;
    virtual uint64_t draw_call_count() const = 0;  // by draw()
    // Fills the pixels in which nothing is drawn yet with what is behind everything; their depth stays as far as it was.
    virtual void draw_background(const view::Camera& camera) = 0;
};

}  // namespace overlook::gl
