// Drawing by LOD-sprite in the player, whatever it sits on.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "runtime/gl/timer.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/player/frame.h"
#include "runtime/player/method.h"

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

// One thing's sprites, made when they are first drawn. Whatever was drawn otherwise between, or with another error, they begin
// anew.
class SpriteDrawing {
  public:
    using MakeThing = std::function<std::unique_ptr<lod_sprite::DrawnGeometry>()>;
    explicit SpriteDrawing(const lod_sprite::FrameOptions& options) : options_(options) {}

    // The frame is drawn otherwise.
    void pause() { error_px_.reset(); }
    // Fails as lod_sprite::FrameDrawer.
    Result<void> draw(const gl::Target& target, const view::Camera& local, const FrameStyle& style, const MakeThing& make_thing,
                      const gl::SecondContextMaker& second, FrameRecord& record);

  private:
    lod_sprite::FrameOptions options_;
    std::unique_ptr<lod_sprite::FrameDrawer> frames_;
    std::optional<double> error_px_;  // of the frame before, if that was one of these
};

}  // namespace overlook::player
