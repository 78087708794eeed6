// The lines of text over the picture, through Dear ImGui (whose only source file is overlay.cpp).
#pragma once

#include "runtime/gl/context.h"
#include "runtime/player/scene.h"

struct GLFWwindow;

namespace overlook::player {

struct OverlayText {
    const FrameRecord* frame = nullptr;
    const gl::Renderer* renderer = nullptr;
    Method method = Method::terrain;
    bool shows_sources = false;
    KeyWatch keys;
    double error_px = 1;
    double speed_factor = 1;
    uint32_t width_px = 0, height_px = 0;
    bool is_recording = false;
};

// Lives as long as the window; only one at a time.
class Overlay {
  public:
    explicit Overlay(GLFWwindow* window);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    // Draws into the window's own framebuffer.
    void draw(const OverlayText& text);
};

}  // namespace overlook::player
