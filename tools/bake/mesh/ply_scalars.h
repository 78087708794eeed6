// What the scalar properties of a PLY element mean.
#pragma once

#include <array>

#include "tools/bake/mesh/ply_header.h"

namespace overlook::mesh {

// What a scalar property means.
enum Slot : uint8_t { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kRed, kGreen, kBlue, kAlpha, kU, kV, kTexture, kIgnored };
constexpr size_t kSlots = kIgnored + 1;

// The scalars of an element, by meaning.
struct Scalars {
    std::array<bool, kSlots> has{};
    std::array<double, kSlots> value{};
    std::array<double, kSlots> greatest{};
    std::vector<Slot> slots;  // by property

    explicit Scalars(const PlyElement& element);
    std::array<uint8_t, 4> colour() const;
    bool has_colour() const { return has[kRed] && has[kGreen] && has[kBlue]; }
};

}  // namespace overlook::mesh
