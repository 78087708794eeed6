// The player's window, through GLFW (whose only source file is window.cpp).
#pragma once

#include "runtime/player/options.h"
#include "runtime/player/scene.h"

namespace overlook::player {

// Opens a window and flies until it is closed, or until the plan's frames are drawn. Fails with Exit::impossible where
// there is no display ("no window can be opened here: ...; --headless draws without one") or no OpenGL 4.5.
Result<void> run_in_window(Plan plan, const command::Common& common, Scene read_scene);

// Whether this session has a display at all.
bool has_display();

}  // namespace overlook::player
