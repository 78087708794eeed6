// A cut of a terrain, drawn and told of: of the whole in memory and of one in parts alike.
#pragma once

#include "runtime/gl/target.h"
#include "runtime/player/frame.h"
#include "runtime/terrain/draw.h"

namespace overlook::player {

// Draws the cut, waits until it is drawn, and writes the time that took, the cut's counts and the error it keeps into the record.
void draw_cut(terrain::Drawing& drawing, const gl::Target& target, const terrain::Cut& cut, const view::Camera& camera,
              const terrain::DrawOptions& look, FrameRecord& record);

}  // namespace overlook::player
