// A field's list drawn on the processor, fast: the same pictures as the exact warper's (warp_field.h), from prepared images,
// eight samples at a time.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 5.2. Ours: images are laid out for
// vectors, depth and colour are painted as one number without a branch, small holes are closed, fades are decided sample by
// sample.
#pragma once

#include <memory>

#include "runtime/wang_ldi/far_images.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/prepared_ldi.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

struct FastOptions {
    Hiding hiding = Hiding::by_depth;
    bool fills_holes = true;   // as fill_holes
    bool uses_vectors = true;  // the widest that the processor has; false: those that every one has. Same picture
    uint32_t finer = 1;        // as Eye's, 1..4
};

// Keeps canvases from picture to picture; one for each thread that draws at the same time.
class FastWarp {
  public:
    FastWarp();
    ~FastWarp();
    FastWarp(const FastWarp&) = delete;
    FastWarp& operator=(const FastWarp&) = delete;

    // As warp_field, but the picture becomes the camera's size and what was in it is gone. Rows of images outside of the picture
    // are skipped, so fewer samples are counted; samples_drawn and pixels_written are the same. Same picture and counts with any
    // number of threads. Memory: 8 bytes for each pixel and thread, kept.
    WarpCounts warp(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                    const FastOptions& options, Warped& picture, const FarImages* far = nullptr);
    uint64_t holes_filled() const { return holes_filled_; }  // of the last picture

  private:
    struct Threads;
    std::unique_ptr<Threads> threads_;
    uint64_t holes_filled_ = 0;
};

}  // namespace overlook::wang_ldi
