#include "runtime/caveclod/face_slots.h"

#include <algorithm>
#include <cassert>

namespace overlook::caveclod {

FaceSlots::FaceSlots(uint32_t surface_count, uint32_t slot_bits)
    : slot_bits_(slot_bits), slot_mask_(uint32_t((uint64_t(1) << slot_bits) - 1)), surfaces_(surface_count) {}

// Page by page, as they lie in memory.
void FaceSlots::resize_table(uint64_t count) {
    handles_.reset(count);
    for (uint32_t surface = 0; surface < surfaces_.size(); ++surface) {
        const OneSurface& one = surfaces_[surface];
        uint32_t first = surface << slot_bits_;
        for (uint32_t slot = 0; slot < one.count; ++slot)
            handles_.insert(one.pages[slot / kPageFaces]->faces[slot % kPageFaces], first | slot);
    }
}

void FaceSlots::add(uint32_t surface, uint32_t face, const std::array<uint32_t, 3>& indices) {
    if (handles_.wants_resize(face_count_ + 1)) resize_table(face_count_ + 1);
    OneSurface& to = surfaces_[surface];
    uint32_t slot = to.count++;
    if (slot / kPageFaces == to.pages.size()) to.pages.push_back(std::make_unique<FacePage>());
    FacePage& page = *to.pages[slot / kPageFaces];
    page.faces[slot % kPageFaces] = face;
    std::copy(indices.begin(), indices.end(), page.indices.begin() + ptrdiff_t(3 * (slot % kPageFaces)));
    page.touch(slot % kPageFaces);
    handles_.insert(face, surface << slot_bits_ | slot);
    ++face_count_;
}

// The last of its surface takes its slot.
void FaceSlots::remove(uint32_t face) {
    size_t place = find(face);
    assert(place != HandleTable::kNowhere);
    uint32_t handle = handles_[place], surface = handle >> slot_bits_;
    OneSurface& from = surfaces_[surface];
    uint32_t last = surface << slot_bits_ | (from.count - 1);
    handles_.erase(place, [&](uint32_t other) { return face_of(other); });
    if (last != handle) {
        FacePage &to = page_of(handle), &moved_from = page_of(last);
        uint32_t slot = handle % kPageFaces, last_slot = last % kPageFaces, moved = moved_from.faces[last_slot];
        handles_[find(moved)] = handle;
        std::copy_n(moved_from.indices.begin() + ptrdiff_t(3 * last_slot), 3, to.indices.begin() + ptrdiff_t(3 * slot));
        to.faces[slot] = moved;
        to.touch(slot);
    }
    --from.count, --face_count_;
    if (from.count % kPageFaces == 0) from.pages.pop_back();
    if (handles_.wants_resize(face_count_)) resize_table(face_count_);
}

void FaceSlots::set(uint32_t corner, uint32_t index) {
    size_t place = find(corner / 4);
    assert(place != HandleTable::kNowhere);
    uint32_t slot = handles_[place] % kPageFaces;
    FacePage& page = page_of(handles_[place]);
    page.indices[3 * slot + corner % 4] = index;
    page.touch(slot);
}

uint32_t FaceSlots::index_at(uint32_t corner) const {
    size_t place = find(corner / 4);
    assert(place != HandleTable::kNowhere);
    return page_of(handles_[place]).indices[3 * (handles_[place] % kPageFaces) + corner % 4];
}

void FaceSlots::clear_dirty() {
    for (OneSurface& surface : surfaces_)
        for (auto& page : surface.pages) page->dirty_begin = kPageFaces, page->dirty_end = 0;
}

uint64_t FaceSlots::bytes() const {
    uint64_t bytes = handles_.bytes() + surfaces_.capacity() * sizeof(OneSurface);
    for (const OneSurface& surface : surfaces_)
        bytes += surface.pages.size() * sizeof(FacePage) + surface.pages.capacity() * sizeof(surface.pages[0]);
    return bytes;
}

}  // namespace overlook::caveclod
