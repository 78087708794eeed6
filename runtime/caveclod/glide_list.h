// What one camera has on its way: splits, and the vertices that they draw meanwhile.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/caveclod/handle_table.h"

namespace overlook::caveclod {

// A vertex on its way to vertex `to`, as drawing reads it: at the share `share` (0..1) from a mixture of three vertices, in
// normal, texture coordinates and colour; and in its place too where it glides (then the three are one). One that fades stands
// at its place from the beginning.
struct GlideVertex {
    static constexpr uint32_t kGlides = uint32_t(1) << 31;
    uint32_t to_bits = 0;  // `to`, and kGlides
    float share = 0;
    std::array<uint16_t, 2> weights{};  // of from[0] and from[1], 65535ths; the rest is from[2]'s
    std::array<uint32_t, 3> from{};

    uint32_t to() const { return to_bits & ~kGlides; }
    bool glides() const { return (to_bits & kGlides) != 0; }
};
static_assert(sizeof(GlideVertex) == 24);

// A split on its way.
struct Glide {
    uint32_t split = 0;
    uint32_t first_slot = ~0u;  // of its vertices, the youngest; GlideList knows the others
    float share = 0;
    bool is_collapsing = false, moves = false;
};
static_assert(sizeof(Glide) == 16);

// 28 bytes a vertex and 21 a split. Slots of vertices stay where they are; glides do not.
class GlideList {
  public:
    bool is_empty() const { return glides_.empty(); }
    std::span<const Glide> all() const { return glides_; }
    const Glide& of(uint32_t split) const { return glides_[handles_[find(split)]]; }  // one that is there
    // Slots that nothing uses keep what was there.
    std::span<const GlideVertex> vertices() const { return vertices_; }

    void add(const Glide& glide, std::span<const GlideVertex> vertices, std::vector<uint32_t>& slots);  // slots: of each vertex
    void remove(uint32_t split);
    void turn_back(uint32_t split) { glides_[handles_[find(split)]].is_collapsing = false; }
    // All by this share of the way; those that are there now go into `arrived`, in order of splits.
    void advance(float step, std::vector<Glide>& arrived);
    uint64_t bytes() const;

  private:
    static constexpr uint32_t kNone = ~0u;
    size_t find(uint32_t split) const {
        return handles_.find(split, [&](uint32_t handle) { return glides_[handle].split; });
    }
    uint32_t take_slot(const GlideVertex& vertex, uint32_t next);
    void resize_table(uint64_t count);

    std::vector<Glide> glides_;
    HandleTable handles_;  // places in glides_
    std::vector<GlideVertex> vertices_;
    std::vector<uint32_t> next_slot_;  // [as vertices_] the same split's next, or the next free one
    uint32_t first_free_ = kNone;
};

}  // namespace overlook::caveclod
