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
#include "runtime/discrete/reprojection.h"
#include "runtime/discrete/settings.h"

namespace overlook::discrete {

// An instance under way, as in draw_turn_shaders.h.
struct PackedMoved {
    glm::mat4 old_from_new{1}, new_from_old{1};
    uint32_t id = 0, from = 0, to = 0;
    float phase = 0;
    float near_z = 0, far_z = 0, pad[2] = {0, 0};
};
static_assert(sizeof(PackedMoved) == 160);

// All that combining a frame with the one before it takes, beside their buffers.
struct Combination {
    Reprojection camera;
    std::vector<PackedMoved> moved;  // nearest first
    Tiles tiles;
};
// What of one chain is under way.
struct UnderWay {
    const FrameList* frame = nullptr;
    const ChainFacts* facts = nullptr;
    std::span<const Placement> before, now;  // where the instances stood in the frame before, and stand
    uint32_t first_instance = 0;             // instances of chains before this one
};
// Of all chains of a picture. old_camera: of the frame before.
Combination combination_of(const FrameOptions& options, std::span<const UnderWay> chains, const view::Camera& old_camera,
                           const view::Camera& new_camera);

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
    uint64_t bytes(uint32_t samples) const;  // of the buffers for targets of so many samples a pixel

  private:
    struct Buffer {
        gl::Texture colour, ids, depth;
        gl::Framebuffer framebuffer;
        uint64_t frame = 0;  // 0: none
    };
    struct Pair {
        uint32_t width_px = 0, height_px = 0, samples = 0;
        std::array<Buffer, 2> buffers;
        gl::Program combine;
    };
    Result<Pair*> pair_for(const gl::Target& target);
    Result<Buffer> make_buffer(const gl::Target& target) const;
    Result<gl::Program> combine_program(uint32_t samples) const;
    uint64_t fill(const Pair& pair, Buffer& buffer, const DrawOptions& look, uint64_t frame, std::span<const TurnPart> parts,
                  const DrawList* TurnPart::*list, uint64_t& uploaded_bytes);
    void combine(const gl::Target& target, const Pair& pair, const Buffer& newer, const Buffer& older,
                 const Combination& combination);

    FrameOptions options_;
    gl::Program turn_;
    std::map<uint32_t, Pair> pairs_;  // by samples
    std::vector<ListBuffers> lists_;  // by part
    gl::StreamBuffer moved_, tiles_;
    gl::VertexArray nothing_;
};

}  // namespace overlook::discrete
