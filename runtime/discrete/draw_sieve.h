// In which small blocks of the picture something under way may be seen, found out by the graphics card from what two frames show,
// so that no other need be searched.
#pragma once

#include <cstdint>

#include "formats/result.h"
#include "runtime/discrete/reprojection.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"

namespace overlook::discrete {

// A context must be current.
class Sieve {
  public:
    static constexpr uint32_t kBlock_px = 8;
    static_assert(2 * kBlock_px == Tiles::kSide_px);

    // For buffers of so many samples a pixel.
    static Result<Sieve> make(uint32_t samples);
    // Of squares as in draw_combination_shaders.h, one at least, those with one entry first; they, what is under way and its
    // entries are bound, and so are both frames' buffers. width_px, height_px: of the picture. Afterwards blocks() holds those
    // blocks, as squares of kBlock_px, that are to be put together: those in which the newer frame shows something under way, or
    // the older one where that would be looked for.
    void sift(uint32_t width_px, uint32_t height_px, uint32_t one_count, uint32_t tile_count);
    GLuint blocks() const { return blocks_.id(); }
    // Draws those of squares with one entry or the others, a strip of four corners each, by the program in use, whose uniform
    // first_tile says where they begin.
    void draw(const gl::Program& program, bool is_one) const;
    // How many blocks the last sift() found; waits for it.
    uint32_t block_count() const;

  private:
    gl::Program program_;
    gl::StreamBuffer found_, blocks_;
    uint32_t one_count_ = 0, tile_count_ = 0;
};

}  // namespace overlook::discrete
