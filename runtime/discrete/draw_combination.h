// The pass that puts two frames of frame-sequential interpolation together.
//
// Based on: D. Scherzer, M. Wimmer, Frame Sequential Interpolation for Discrete Level-of-Detail Rendering, 2008, 3.4.
// Different in Variant::fsi: settings.h's Remedies; and only those squares of the picture are put together in which something
// may be under way, and of them what draw_sieve.h leaves, all others are copied from the newer frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/discrete/director.h"
#include "runtime/discrete/draw_sieve.h"
#include "runtime/discrete/reprojection.h"
#include "runtime/discrete/settings.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/target.h"

namespace overlook::discrete {

// An instance under way, as in draw_combination_shaders.h.
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
    bool has_own_motion = false;     // any of them stood elsewhere before
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

// One frame drawn by turns: what things look like, which ones they are, how near.
struct TurnBuffer {
    gl::Texture colour, ids, depth;
    gl::Framebuffer framebuffer;
    uint64_t frame = 0;  // 0: none
};

// A context must be current.
class Combiner {
  public:
    // For buffers of so many samples a pixel.
    static Result<Combiner> make(const FrameOptions& options, uint32_t samples);
    // Into the target, which is as large as the buffers and has as many samples. sifts: with the sieve, if there is one. Returns
    // calls made.
    uint64_t combine(const gl::Target& target, const TurnBuffer& newer, const TurnBuffer& older, const Combination& combination,
                     bool sifts = true);
    // Puts some pixels together by each way that there is, so that no later frame waits for a shader; the target's picture is
    // lost.
    void prepare(const gl::Target& target, const TurnBuffer& newer, const TurnBuffer& older);
    // Pixels of the squares of the last one; it copied the others.
    uint64_t combined_px() const { return combined_px_; }
    // Pixels for which it put two frames together: no more than that. Waits until it has.
    uint64_t searched_px() const;

  private:
    const gl::Program& use_program(bool is_one, bool moves, const gl::Target& target, const Combination& combination);
    Result<gl::Program> make_program(bool is_one, bool moves) const;
    uint64_t draw_tiles(bool is_one, const gl::Target& target, const Combination& combination, bool is_sifted);
    void fill_tiles(const gl::Target& target, const Combination& combination, bool takes_all);
    uint64_t combine_tiles(const gl::Target& target, const Combination& combination, bool sifts);
    bool copies_rest() const;

    FrameOptions options_;
    uint32_t samples_ = 1;
    gl::Program paper_, tiled_[2][2];  // [has one entry][has own motion]
    std::optional<Sieve> sieve_;
    gl::StreamBuffer moved_, tiles_, entries_;
    gl::VertexArray nothing_;
    uint32_t one_count_ = 0, tile_count_ = 0;  // those with one entry come first
    uint64_t combined_px_ = 0;
};

}  // namespace overlook::discrete
