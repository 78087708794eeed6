// A baked mesh packed for refining: read-only, shared by all cameras.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/caveclod.h"

namespace overlook::caveclod {

// What deciding about a split needs, in one piece.
struct Bounds {
    uint64_t middle = 0;  // the owner's position in steps of the grid, 21 bits an axis
    uint16_t error = 0;   // code of the format
    uint16_t radius = 0;  // sixty-fourths of an octave, rounded up
    NormalCone cone;
};
static_assert(sizeof(Bounds) == 16);

// One vertex of the vertex buffer.
struct PackedVertex {
    std::array<uint16_t, 3> position{};  // high 16 of the grid's bits
    uint16_t position_low = 0;           // the low bits of each axis, up to 4 of them, x first from bit 0
    std::array<int16_t, 2> normal{};     // octahedral, in steps
    std::array<uint16_t, 2> uv{};        // in steps of the grid
};
static_assert(sizeof(PackedVertex) == 16);

// A split as applying it needs it. `vertex` are indices into the vertex buffer.
struct SplitRecord {
    struct Move {
        uint32_t corner = 0;  // face * kCorners + corner
        uint32_t vertex = 0, vertex_before = 0;
    };
    struct Face {
        uint32_t face = 0, surface = 0;
        std::array<uint32_t, 3> vertices{};  // the owner's comes first
        uint8_t new_corner = 0;              // which of them is the new position's
    };
    std::vector<uint32_t> needs, dependents;  // ascending
    std::vector<Move> moves;
    std::array<Face, 2> faces;
    uint32_t face_count = 0;
};

// Of a mesh of which a part is there: what is known of the whole.
struct WholeMesh {
    uint32_t face_count = 0, vertex_count = 0;
    // No split that is missing bounds more; 0: none is missing.
    float missing_error_m = 0;
};

class Mesh {
  public:
    // The hierarchy may go afterwards. Fails with Exit::impossible if its splits do not fit into 32-bit places ("a mesh of
    // 200,000,000 splits needs more than 4 GiB of records"), or if it has too many faces of one surface and too many surfaces for
    // 32-bit handles: "a mesh of 70,000 surfaces and 200,000 faces of one has too many for one camera's handles".
    static Result<Mesh> make(const Hierarchy& hierarchy);
    // The same of a hierarchy's first splits. Of all of them it is the mesh that the other one makes, but that handles have room
    // for whole.face_count faces of one surface.
    static Result<Mesh> make(const Hierarchy& hierarchy, const WholeMesh& whole);

    // Becomes the mesh of more splits of the same hierarchy, with the surfaces that it has itself. Cost O(1).
    void grow(Mesh&& finer);
    // Keeps the first splits alone, with the bounds and records that they have. extent: as it was of them; missing_error_m: as
    // WholeMesh's. Cost O(what is left).
    struct Extent {
        uint32_t split_count = 0, face_count = 0, vertex_count = 0;
    };
    Extent extent() const { return {split_count(), face_count(), vertex_count()}; }
    void shrink(const Extent& extent, float missing_error_m);
    // Splits from here on are on their way out: refinements collapse them and split none. split_count() if none is.
    void set_split_limit(uint32_t split_limit) { split_limit_ = split_limit; }
    void set_surfaces(std::vector<Surface> surfaces) { surfaces_ = std::move(surfaces); }  // as many as there are

    uint32_t split_limit() const { return split_limit_; }
    float missing_error_m() const { return missing_error_m_; }
    // Above all vertices, those that are missing as well: a face's index from here on is of a vertex on its way.
    uint32_t glide_begin() const { return glide_begin_; }
    uint32_t split_count() const { return uint32_t(bounds_.size()); }
    uint32_t face_count() const { return face_count_; }
    uint32_t base_face_count() const { return uint32_t(base_surfaces_.size()); }
    uint32_t vertex_count() const { return uint32_t(vertices_.size()); }
    uint32_t surface_count() const { return uint32_t(surfaces_.size()); }

    const Bounds& bounds(uint32_t split) const { return bounds_[split]; }
    float error_m(uint32_t split) const { return error_by_code_[bounds_[split].error]; }
    float radius_m(uint32_t split) const { return radius_by_code_[bounds_[split].radius]; }
    glm::dvec3 middle_m(uint32_t split) const {  // in the world
        uint64_t at = bounds_[split].middle;
        constexpr uint64_t kAxis = (1 << 21) - 1;
        return origin_m_ + glm::dvec3(double(at & kAxis), double(at >> 21 & kAxis), double(at >> 42 & kAxis)) * position_step_m_;
    }
    void prefetch_bounds(uint32_t split) const { __builtin_prefetch(&bounds_[split]); }
    float finest_error_m() const { return finest_error_m_; }
    // Whether the star of a split can glide between its two forms and stay between them (see Refinement).
    bool glides(uint32_t split) const { return (glides_[split / 64] >> (split % 64) & 1) != 0; }

    // `record`: scratch that keeps its memory.
    void decode(uint32_t split, SplitRecord& record) const;
    void decode_needs(uint32_t split, std::vector<uint32_t>& needs) const;
    void decode_dependents(uint32_t split, std::vector<uint32_t>& dependents) const;

    std::span<const std::array<uint32_t, 3>> base_faces() const { return base_faces_; }
    uint32_t base_surface(uint32_t face) const { return base_surfaces_[face]; }
    // Splits that need nothing.
    std::span<const uint32_t> roots() const { return roots_; }

    std::span<const PackedVertex> vertices() const { return vertices_; }
    std::span<const std::array<uint8_t, 4>> colours() const { return colours_; }  // [D], or empty
    std::span<const Surface> surfaces() const { return surfaces_; }
    const Grid& grid() const { return grid_; }
    const Attributes& attributes() const { return attributes_; }
    const glm::dvec3& origin_m() const { return origin_m_; }
    // Where a vertex lies, relative to origin_m.
    glm::dvec3 vertex_m(uint32_t vertex) const;
    // The box round all vertices, in the world.
    const glm::dvec3& lowest_m() const { return lowest_m_; }
    const glm::dvec3& highest_m() const { return highest_m_; }

    // A handle is a face's surface and its slot there: slots take the low bits.
    uint32_t slot_bits() const { return slot_bits_; }

    // What the mesh keeps in memory, pictures of surfaces left out.
    struct Bytes {
        uint64_t bounds = 0, records = 0, vertices = 0, base = 0, glides = 0;
        uint64_t all() const { return bounds + records + vertices + base + glides; }
    };
    Bytes bytes() const;

  private:
    friend class MeshPacker;
    Mesh() = default;
    uint32_t vertex_begin(uint32_t position) const {
        return vertex_blocks_[position / kRowBlock] + (wide_rows_.empty() ? vertex_rows_[position] : wide_rows_[position]);
    }

    static constexpr uint32_t kRowBlock = 64;

    uint32_t face_count_ = 0, base_position_count_ = 0, slot_bits_ = 32, split_limit_ = 0, glide_begin_ = 0;
    float finest_error_m_ = 0, missing_error_m_ = 0;
    glm::dvec3 origin_m_{0}, lowest_m_{0}, highest_m_{0};
    double position_step_m_ = 1;
    Grid grid_;
    Attributes attributes_;
    std::vector<Bounds> bounds_;          // [S]
    std::vector<uint64_t> glides_;        // [S / 64]
    std::vector<uint32_t> record_begin_;  // [S]
    std::vector<uint8_t> records_;
    std::vector<uint32_t> vertex_blocks_;  // a position's first vertex: that of every kRowBlock-th position, and from there
    std::vector<uint16_t> vertex_rows_;
    std::vector<uint32_t> wide_rows_;     // instead, where 16 bits are too few
    std::vector<PackedVertex> vertices_;  // [D]
    std::vector<std::array<uint8_t, 4>> colours_;
    std::vector<std::array<uint32_t, 3>> base_faces_;
    std::vector<uint16_t> base_surfaces_;
    std::vector<uint32_t> roots_;
    std::vector<Surface> surfaces_;
    std::vector<float> error_by_code_, radius_by_code_;
};

}  // namespace overlook::caveclod
