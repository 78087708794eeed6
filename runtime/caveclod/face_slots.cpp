#include "runtime/caveclod/face_slots.h"

#include <algorithm>
#include <cassert>

namespace overlook::caveclod {
namespace {

constexpr size_t kLeastTable = 64;

// 85 % full at most.
bool is_full(uint64_t count, size_t size) {
    return count * 20 > uint64_t(size) * 17;
}

}  // namespace

FaceSlots::FaceSlots(uint32_t surface_count, uint32_t slot_bits)
    : slot_bits_(slot_bits),
      slot_mask_(uint32_t((uint64_t(1) << slot_bits) - 1)),
      surfaces_(surface_count),
      table_(kLeastTable, kNone) {}

size_t FaceSlots::find(uint32_t face) const {
    for (size_t place = home(face);; place = place + 1 == table_.size() ? 0 : place + 1) {
        if (table_[place] == kNone) return kEmpty;
        if (face_of(table_[place]) == face) return place;
    }
}

void FaceSlots::insert(uint32_t face, uint32_t handle) {
    size_t place = home(face);
    while (table_[place] != kNone) place = place + 1 == table_.size() ? 0 : place + 1;
    table_[place] = handle;
}

// What stands behind moves up as far as its home allows, so that no gap is left.
void FaceSlots::erase(size_t place) {
    size_t gap = place;
    for (size_t at = place + 1 == table_.size() ? 0 : place + 1; table_[at] != kNone; at = at + 1 == table_.size() ? 0 : at + 1) {
        size_t wanted = home(face_of(table_[at]));
        size_t from_home = at >= wanted ? at - wanted : at + table_.size() - wanted;
        size_t from_gap = at >= gap ? at - gap : at + table_.size() - gap;
        if (from_home < from_gap) continue;
        table_[gap] = table_[at];
        gap = at;
    }
    table_[gap] = kNone;
}

void FaceSlots::grow() {
    std::vector<uint32_t> handles;
    table_.swap(handles);
    table_.assign(handles.size() + handles.size() / 4, kNone);
    for (uint32_t handle : handles)
        if (handle != kNone) insert(face_of(handle), handle);
}

void FaceSlots::add(uint32_t surface, uint32_t face, const std::array<uint32_t, 3>& indices) {
    if (is_full(face_count_ + 1, table_.size())) grow();
    OneSurface& to = surfaces_[surface];
    uint32_t slot = to.count++;
    if (slot / kPageFaces == to.pages.size()) to.pages.push_back(std::make_unique<FacePage>());
    FacePage& page = *to.pages[slot / kPageFaces];
    page.faces[slot % kPageFaces] = face;
    std::copy(indices.begin(), indices.end(), page.indices.begin() + ptrdiff_t(3 * (slot % kPageFaces)));
    page.touch(slot % kPageFaces);
    insert(face, surface << slot_bits_ | slot);
    ++face_count_;
}

void FaceSlots::remove(uint32_t face) {
    size_t place = find(face);
    assert(place != kEmpty);
    uint32_t handle = table_[place], surface = uint32_t(uint64_t(handle) >> slot_bits_);
    OneSurface& from = surfaces_[surface];
    uint32_t last = surface << slot_bits_ | (from.count - 1);
    erase(place);
    if (last != handle) {
        FacePage &to = page_of(handle), &moved_from = page_of(last);
        uint32_t slot = handle % kPageFaces, last_slot = last % kPageFaces, moved = moved_from.faces[last_slot];
        table_[find(moved)] = handle;
        std::copy_n(moved_from.indices.begin() + ptrdiff_t(3 * last_slot), 3, to.indices.begin() + ptrdiff_t(3 * slot));
        to.faces[slot] = moved;
        to.touch(slot);
    }
    --from.count, --face_count_;
    if (from.count % kPageFaces == 0) from.pages.pop_back();
}

void FaceSlots::set(uint32_t corner, uint32_t index) {
    size_t place = find(corner / 4);
    assert(place != kEmpty);
    uint32_t slot = table_[place] % kPageFaces;
    FacePage& page = page_of(table_[place]);
    page.indices[3 * slot + corner % 4] = index;
    page.touch(slot);
}

uint32_t FaceSlots::index_at(uint32_t corner) const {
    size_t place = find(corner / 4);
    assert(place != kEmpty);
    return page_of(table_[place]).indices[3 * (table_[place] % kPageFaces) + corner % 4];
}

void FaceSlots::clear_dirty() {
    for (OneSurface& surface : surfaces_)
        for (auto& page : surface.pages) page->dirty_begin = kPageFaces, page->dirty_end = 0;
}

uint64_t FaceSlots::bytes() const {
    uint64_t bytes = table_.capacity() * sizeof(uint32_t) + surfaces_.capacity() * sizeof(OneSurface);
    for (const OneSurface& surface : surfaces_)
        bytes += surface.pages.size() * sizeof(FacePage) + surface.pages.capacity() * sizeof(surface.pages[0]);
    return bytes;
}

}  // namespace overlook::caveclod
