#include "runtime/discrete/draw_frames.h"

#include <utility>

#include "runtime/discrete/select.h"

namespace overlook::discrete {

FrameDrawer::FrameDrawer(const Drawing& drawing, std::span<const Placement> placements, const FrameOptions& options)
    : drawing_(drawing),
      director_(facts_of(drawing.chain()), placements, options),
      placed_before_(placements.begin(), placements.end()) {
    director_.set_grain_m(drawing.grain_m());
}

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::make(const Drawing& drawing, std::span<const Placement> placements,
                                                       const FrameOptions& options) {
    std::unique_ptr<FrameDrawer> made(new FrameDrawer(drawing, placements, options));
    if (Result<void> turns = made->make_turns(); !turns) return tl::unexpected(turns.error());
    return made;
}

Result<void> FrameDrawer::make_turns() {
    turns_.reset();
    if (!draws_by_turns(director_.options().variant)) return {};
    Result<Turns> turns = Turns::make(drawing_, director_.options());
    if (!turns) return tl::unexpected(turns.error());
    turns_.emplace(std::move(*turns));
    return {};
}

void FrameDrawer::place(std::span<const Placement> placements) {
    director_.place(placements);
}

Result<void> FrameDrawer::change(const FrameOptions& options) {
    FrameOptions before = director_.options();
    director_.change(options);
    bool draws_alike = before.variant == options.variant && before.remedies == options.remedies &&
                       before.is_half_precise == options.is_half_precise;
    return draws_alike ? Result<void>() : make_turns();
}

void FrameDrawer::decide(const view::Camera& camera, double dt_s, double clip_s) {
    director_.decide(camera, dt_s);
    ++frame_;
    const FrameList& frame = director_.frame();
    const std::vector<Placement>& placed = director_.placements();
    std::swap(before_, now_);
    now_ = draw_list(drawing_.layout(), drawing_.chain(), frame, placed, camera, clip_s);
    has_before_ = frame_ > 1 && before_.camera.width_px == camera.width_px && before_.camera.height_px == camera.height_px;
    if (turns_) {
        const view::Camera& old_camera = has_before_ ? before_.camera : camera;
        combination_ = combination_of(director_.options(), frame, director_.facts(), placed_before_, placed, old_camera, camera);
        placed_before_ = placed;
    }
    counts_ = {};
    counts_.triangle_count = frame.triangle_count;
    counts_.tested_count = frame.tested_count;
    counts_.in_view_count = frame.in_view_count;
    counts_.begun_count = frame.begun_count;
    counts_.fading_count = frame.fading.size();
    counts_.state_bytes = director_.bytes();
    counts_.error_px = frame.error_px;
}

Result<FrameCounts> FrameDrawer::draw(const gl::Target& target, const DrawOptions& look) {
    FrameCounts counts = counts_;
    if (!turns_) {
        counts.uploaded_bytes = lists_.fill(now_);
        counts.draw_call_count = drawing_.draw(target, lists_, now_, look);
        return counts;
    }
    const DrawList* before = has_before_ ? &before_ : nullptr;
    Result<uint64_t> calls = turns_->draw(target, look, frame_, now_, before, combination_, counts.uploaded_bytes);
    if (!calls) return tl::unexpected(calls.error());
    counts.draw_call_count = *calls;
    counts.resident_bytes = turns_->bytes();
    return counts;
}

}  // namespace overlook::discrete
