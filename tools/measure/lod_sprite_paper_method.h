// LOD-sprite as its paper has it, as a method to be measured.
#pragma once

#include <memory>

#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// error-px: of the high cut, which keyframes are drawn from; low-error-px: of the low cut; key-error-px: equation 2's epsilon, for
// C' on the fan of the corners' mean or, with drawn-plane=1, on the triangle that is drawn;
// depth-thickness: equation 3's, of an ordinary depth buffer, or metres with eye-depth=1; strips=1: a strip has one texture.
//
// Of each frame: predicted_error_px is what equation 2 says of it (its root, in pixels), or of a keyframe the high cut's bound;
// event_count is 1 for a keyframe, whose depths cost a second drawing where a pixel has several samples.
std::unique_ptr<Method> make_lod_sprite_paper_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
