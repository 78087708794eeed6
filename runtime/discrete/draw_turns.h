// Two frames put together: the buffers of frame-sequential interpolation, and the pass that combines them.
//
// Based on: D. Scherzer, M. Wimmer, Frame Sequential Interpolation for Discrete Level-of-Detail Rendering, 2008, 3.2-3.5.
// Different in Variant::fsi: settings.h's Remedies.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "runtime/discrete/draw.h"
#include "runtime/discrete/draw_combination.h"
#include "runtime/discrete/settings.h"

namespace overlook::discrete {

// A chain's part of two frames that are put together.
struct TurnPart {
    const Drawing* drawing = nullptr;
    const DrawList *now = nullptr, *before = nullptr;
};

// Draws by turns. A context must be current.
class Turns {
  public:
    // Its programs are those of any drawing: one of those that are drawn, or another.
    static Result<Turns> make(const Drawing& drawing, const FrameOptions& options);

    // look: without a part. Draws frame number `frame`, and the one before it where its buffer is not there any more, and puts
    // both together into the target. Again for the same number: only puts them together. parts: at least one, of one camera each
    // frame; has_before: false of a first frame, whose parts have nothing before. Returns calls made; uploaded grows by what went
    // to the card. Fails with Exit::impossible if the renderer has no such buffers.
    Result<uint64_t> draw(const gl::Target& target, const DrawOptions& look, uint64_t frame, std::span<const TurnPart> parts,
                          bool has_before, const Combination& combination, uint64_t& uploaded_bytes);
    // Makes the buffers for the target, and draws once all that a later frame may be drawn by; the target's picture is lost.
    // Fails as draw().
    Result<void> prepare(const gl::Target& target);
    // Of the last draw().
    uint64_t combined_px() const { return combined_px_; }
    // Pixels for which it put two frames together, of a target of so many samples a pixel; waits until it has.
    uint64_t searched_px(uint32_t samples) const;
    uint64_t bytes(uint32_t samples) const;  // of the buffers for targets of so many samples a pixel

  private:
    struct Pair {
        uint32_t width_px = 0, height_px = 0, samples = 0;
        std::array<TurnBuffer, 2> buffers;
        Combiner combiner;
    };
    Result<Pair*> pair_for(const gl::Target& target);
    Result<TurnBuffer> make_buffer(const gl::Target& target) const;
    uint64_t fill(const Pair& pair, TurnBuffer& buffer, const DrawOptions& look, uint64_t frame, std::span<const TurnPart> parts,
                  const DrawList* TurnPart::*list, uint64_t& uploaded_bytes);

    FrameOptions options_;
    gl::Program turn_;
    std::map<uint32_t, Pair> pairs_;  // by samples
    std::vector<ListBuffers> lists_;  // by part
    uint64_t combined_px_ = 0;
};

}  // namespace overlook::discrete
