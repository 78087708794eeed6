// Pictures without a window.
#pragma once

#include "runtime/player/options.h"
#include "runtime/player/scene.h"

namespace overlook::player {

// Draws the frames of the plan, writes the pictures and the report.
Result<void> run_headless(Plan plan, const command::Common& common, Scene read_scene);

// Writes the target's picture if the plan wants one of this frame.
Result<void> write_picture(const Plan& plan, const gl::Target& target, uint32_t frame, bool is_last);

}  // namespace overlook::player
