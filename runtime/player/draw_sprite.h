// Drawing by LOD-sprite in the player, whatever it sits on.
#pragma once

#include "runtime/gl/timer.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/player/frame.h"

namespace overlook::player {

// By either form of LOD-sprite.
template <class FrameDrawer>
Result<void> draw_sprite(FrameDrawer& frames, const gl::Target& target, const view::Camera& local, FrameRecord& record) {
    gl::Timer deciding;
    frames.decide(local);
    record.refine_ms = deciding.elapsed_ms();

    gl::Timer drawing;
    Result<lod_sprite::FrameCounts> drawn = frames.draw(target);
    if (!drawn) return tl::unexpected(drawn.error());
    record.draw_ms = drawing.finished_ms();

    record.triangle_count = drawn->triangle_count;
    record.tested_count = drawn->tested_count;
    record.predicted_error_px = drawn->error_p99_px;
    record.uploaded_bytes = drawn->uploaded_bytes;
    record.sprite = *drawn;
    return {};
}

}  // namespace overlook::player
