#include "runtime/player/draw_sprite.h"

namespace overlook::player {

Result<void> SpriteDrawing::draw(const gl::Target& target, const view::Camera& local, const FrameStyle& style,
                                 const MakeThing& make_thing, const gl::SecondContextMaker& second, FrameRecord& record) {
    if (!frames_) {
        auto made = lod_sprite::FrameDrawer::make(make_thing(), with_error(options_, style.error_px), second);
        if (!made) return tl::unexpected(made.error());
        frames_ = std::move(*made);
        if (Result<void> prepared = frames_->prepare(local, target); !prepared) return prepared;
    } else if (error_px_ != style.error_px) {
        frames_->change(with_error(options_, style.error_px));
    }
    error_px_ = style.error_px;
    frames_->show_sources(style.shows_sources || options_.draw.shows_sources);
    return draw_sprite(*frames_, target, local, record);
}

}  // namespace overlook::player
