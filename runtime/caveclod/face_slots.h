// The faces that one camera draws: an index buffer for each surface, in pages, and where each face stands in it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/caveclod/handle_table.h"

namespace overlook::caveclod {

// Few, since the last page of each surface is half empty in the mean.
constexpr uint32_t kPageFaces = 64;

// A piece of one index buffer. Its first `count` faces are drawn, three indices each.
struct FacePage {
    std::array<uint32_t, 3 * kPageFaces> indices;
    std::array<uint32_t, kPageFaces> faces;
    // Faces [dirty_begin, dirty_end) have changed since clear_dirty().
    uint16_t dirty_begin = kPageFaces, dirty_end = 0;

    void touch(uint32_t slot) {
        dirty_begin = uint16_t(std::min<uint32_t>(dirty_begin, slot));
        dirty_end = uint16_t(std::max<uint32_t>(dirty_end, slot + 1));
    }
};

// 16 bytes a face in pages, and what HandleTable takes for its handle.
class FaceSlots {
  public:
    FaceSlots(uint32_t surface_count, uint32_t slot_bits);

    void add(uint32_t surface, uint32_t face, const std::array<uint32_t, 3>& indices);
    void remove(uint32_t face);
    // One corner (face * 4 + 0..2) of a face that is there.
    void set(uint32_t corner, uint32_t index);
    uint32_t index_at(uint32_t corner) const;
    bool has(uint32_t face) const { return find(face) != HandleTable::kNowhere; }

    uint64_t face_count() const { return face_count_; }
    uint32_t surface_count() const { return uint32_t(surfaces_.size()); }
    uint32_t face_count(uint32_t surface) const { return surfaces_[surface].count; }
    std::span<const std::unique_ptr<FacePage>> pages(uint32_t surface) const { return surfaces_[surface].pages; }
    // How many of a page's faces are drawn.
    uint32_t page_count(uint32_t surface, uint32_t page) const {
        return std::min(kPageFaces, surfaces_[surface].count - page * kPageFaces);
    }
    void clear_dirty();

    uint64_t bytes() const;  // taken, used or not

  private:
    struct OneSurface {
        std::vector<std::unique_ptr<FacePage>> pages;
        uint32_t count = 0;
    };

    FacePage& page_of(uint32_t handle) const {
        return *surfaces_[handle >> slot_bits_].pages[(handle & slot_mask_) / kPageFaces];
    }
    uint32_t face_of(uint32_t handle) const { return page_of(handle).faces[handle % kPageFaces]; }
    size_t find(uint32_t face) const {
        return handles_.find(face, [&](uint32_t handle) { return face_of(handle); });
    }
    void resize_table(uint64_t count);

    uint32_t slot_bits_, slot_mask_;
    std::vector<OneSurface> surfaces_;
    HandleTable handles_;
    uint64_t face_count_ = 0;
};

}  // namespace overlook::caveclod
