// How Mesh keeps a split: a byte of flags, then numbers of seven bits a byte, the last byte below 128. In their order: needs and
// dependents, each their count and steps from one to the next; back to the owner; how many faces fewer than two a split came
// before; moves; added faces.
#pragma once

#include <cstdint>

namespace overlook::caveclod {

// Bits of a record's first byte.
inline constexpr uint8_t kFaceCount = 3, kHasMoveWedges = 4, kHasFaceWedges = 8,
                         kThirdIsLast = 16;  // the last for face 0, twice it for 1

}  // namespace overlook::caveclod
