// What is behind everything.
#pragma once

#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/view/camera.h"

namespace overlook::gl {

// Fills the pixels of a part of the picture in which nothing is drawn yet; their depth stays as far as it was. program: of
// shaders::kBackgroundVertex and a fragment shader that begins with shaders::kBackgroundDirection, its textures bound.
// nothing: an array without vertices. A context must be current.
void draw_background(const Program& program, const view::Camera& camera, const view::Part& part, const VertexArray& nothing);

}  // namespace overlook::gl
