// What the caveclod writer and reader share: codes of errors, where numbers stand in blocks, and what is expected of a split
// before it is told. Documented in formats/spec/caveclod.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "formats/caveclod_state.h"

namespace overlook::caveclod {

// Errors: 0 is none; from 1 on eighths of an octave from 2^-60 m.
constexpr uint32_t kErrorCodeMax = 960;  // 2^59.875 m
float error_of_code(uint32_t code);      // code at most kErrorCodeMax
uint32_t code_of_error(float error_m);   // the least whose error is not below; error_m finite, 0 .. error_of_code(kErrorCodeMax)

// The rows of numbers of a block, in their order.
enum Row : uint32_t {
    kBase,        // of the coarsest cut: faces, groups, surfaces
    kOwner,       // of each split, to the owner before
    kArcBegin,    // where in the owner's star the faces moved begin
    kArcLength,   // how many there are
    kFlags,       // what of a split is not as expected
    kWedgeCount,  // of each position, less one
    kWedge,       // wedges that are not clear
    kPosition,    // three for each position, to what is expected
    kNormal,
    kUv,
    kColour,
    kError,
    kRare,
    kRowCount
};
using Rows = std::array<std::vector<uint32_t>, kRowCount>;

// Bits of kFlags.
constexpr uint32_t kOtherFaces = 1, kOtherGroups = 2, kOtherWedges = 4, kMoreNeeds = 8, kOtherMoves = 16, kFlagsEnd = 32;

constexpr uint32_t zigzag(int32_t value) {
    return (uint32_t(value) << 1) ^ uint32_t(value >> 31);
}
constexpr int32_t unzigzag(uint32_t value) {
    return int32_t(value >> 1) ^ -int32_t(value & 1);
}

// Attributes in steps.
struct Steps {
    std::array<int32_t, 2> normal{}, uv{};
    std::array<int32_t, 4> colour{};

    bool operator==(const Steps&) const = default;
};
struct GridPosition {
    std::array<int32_t, 3> at{};

    bool operator==(const GridPosition&) const = default;
};
// Steps of a value, and the value of steps; the first is right for what the second gave. Values beyond the grid give steps beyond
// it.
GridPosition steps_of_position(const Grid& grid, const glm::vec3& position_m);
glm::vec3 position_of_steps(const Grid& grid, const GridPosition& steps);
Steps steps_of_vertex(const Grid& grid, const RenderVertex& vertex);
RenderVertex vertex_of_steps(const Grid& grid, const Attributes& attributes, uint32_t position, const Steps& steps);
constexpr int32_t most_steps(uint32_t bits) {
    return int32_t((1u << bits) - 1);
}

// One face that a split adds: (owner, third, new) or, if third_is_last, (owner, new, third).
struct AddedFace {
    uint32_t third = 0;
    bool third_is_last = false;
    uint32_t group = 0;
    std::array<uint16_t, 3> wedges{};  // of owner, new and third
};
struct Added {
    uint32_t count = 0;
    std::array<AddedFace, 2> faces;
};
// The faces that close the gap which an arc of the owner's star leaves when it moves to the new position: one at either end where
// the fan goes on, with the group and the wedges of the arc's face there. new_wedges: of the arc's corners, as moved.
Added expected_faces(const MeshState& state, const Hierarchy& hierarchy, std::span<const StarCorner> star, uint32_t begin,
                     uint32_t length, std::span<const uint16_t> new_wedges);

// The place of an arc's i-th corner in the star: closed fans go round.
uint32_t in_arc(std::span<const StarCorner> star, uint32_t begin, uint32_t i);
// Whether an arc of this length may begin there: within one fan, whole at most.
bool is_arc(std::span<const StarCorner> star, uint32_t begin, uint32_t length);

// Where the new position is expected: the mean of the owner and the far corners of the faces moved.
GridPosition expected_position(std::span<const GridPosition> positions, uint32_t owner, std::span<const StarCorner> moved);
// What a new vertex is expected to have: the mean over the corners of those moved faces that use it; else that of the vertex
// before.
Steps expected_vertex(const MeshState& state, const Hierarchy& hierarchy, std::span<const Steps> vertices,
                      std::span<const StarCorner> moved, std::span<const uint16_t> new_wedges, uint16_t wedge);

// The splits that split i needs by what it touches, in ascending order without those that another one needs directly.
// Hierarchy's needs must be complete below i.
void touched_needs(const MeshState& state, const Hierarchy& hierarchy, uint32_t owner, std::span<const uint32_t> moved,
                   const Added& added, std::vector<uint32_t>& needs);

}  // namespace overlook::caveclod
