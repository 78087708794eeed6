// LOD-sprite as its paper has it, as a method to be measured.
#pragma once

#include <memory>

#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// Its settings: error-px of the high cut, which keyframes are drawn from; low-error-px of the low cut; key-error-px, equation 2's
// epsilon; drawn-plane=1 puts C' on the triangle that is drawn, not on the fan round the corners' mean; depth-thickness of
// equation 3, of an ordinary depth buffer or, with eye-depth=1, in metres; strips=1 gives a strip one texture.
//
// Of each frame: predicted_error_px is what equation 2 says of it (its root, in pixels), or of a keyframe the high cut's bound;
// event_count is 1 for a keyframe, whose depths cost a second drawing where a pixel has several samples.
std::unique_ptr<Method> make_lod_sprite_paper_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
