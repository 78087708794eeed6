// A field's list drawn on the processor, exactly: what the paper's renderer does, and what faster ways are compared with.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, sections 5.2 and 5.4; L. McMillan,
// Computing Visibility Without Depth, 1995. Ours: threads, each with a part of the list and a picture of its own, that are laid
// over each other in the list's order.
#pragma once

#include "runtime/wang_ldi/far_images.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

// Draws the list of a field for a camera over what is in the picture. Tiles stand sheared on their halves' planes, each half with
// the pixels of its own alone; of images that fade, each place is shown by one. Textures and colours are drawn from `far`, on the
// ground; without it they are left out, as is geometry. An image that is not
// at hand is left out and counted. As the paper draws: the list of paper_options, by order. Same picture and counts with any
// number of threads. finer: as Eye's. Memory: a picture for each thread but one. O(samples + pixels written).
WarpCounts warp_field(const view::Camera& camera, const Field& field, const FieldList& list, const ImageAt& image_at,
                      Hiding hiding, Warped& picture, const FarImages* far = nullptr, uint32_t finer = 1);

}  // namespace overlook::wang_ldi
