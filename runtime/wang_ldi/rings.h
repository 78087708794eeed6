// Levels and directions made visible: images in colours of their own, as in the paper's figure 7.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "formats/wang_ldi.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/image_store.h"

namespace overlook::wang_ldi {

// Of the images of a level, by its place in the set, and of a direction: hues go round with levels, every other direction is
// darker. sRGB-encoded.
std::array<uint8_t, 3> ring_colour(uint32_t level, uint32_t direction);

// Images as they are, in the colours of their rings, with some of their own light and dark.
class RingImages {
  public:
    // Has ready what a list shows, of the images at hand, as far as there is room beside these in their budget, and lets go what
    // it does not show.
    void take(const Field& field, const FieldList& list, const ImageStore& images);
    // Null of what is not ready. Any thread.
    const StoredImage* at(uint64_t index) const;

  private:
    std::map<uint64_t, StoredImage> images_;
};
// One image so.
Ldi ring_image(const Ldi& ldi, uint32_t level, uint32_t direction);

}  // namespace overlook::wang_ldi
