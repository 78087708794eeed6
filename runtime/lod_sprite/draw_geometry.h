// What LOD-sprite sits on, as its drawing half needs it.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/result.h"
#include "runtime/gl/surface.h"
#include "runtime/lod_sprite/geometry.h"

namespace overlook::lod_sprite {

// A context must be current, also when it goes.
class DrawnGeometry {
  public:
    virtual ~DrawnGeometry() = default;

    virtual Geometry& geometry() = 0;

    // Puts a key's slice, or the coarse cut, as they are now, where they are drawn from. Returns the bytes sent to the card.
    // What either's surfaces draw holds until the next call of one of the two.
    virtual uint64_t take_slice() = 0;
    virtual uint64_t take_coarse(uint64_t near_triangle_count) = 0;
    virtual gl::Surface& slice() = 0;
    virtual gl::Surface& near() = 0;  // the coarse cut's first near_triangle_count
    virtual gl::Surface& far() = 0;   // and the others

    // The same thing for another thread, whose own context, current now, shares the objects of the one that this was made in.
    // Fails with Exit::our_bug.
    virtual Result<std::unique_ptr<DrawnGeometry>> sharing() const = 0;
};

}  // namespace overlook::lod_sprite
