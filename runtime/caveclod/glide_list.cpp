#include "runtime/caveclod/glide_list.h"

#include <algorithm>

namespace overlook::caveclod {
namespace {

// With an eighth more room at most than is needed.
template <class T>
void append(std::vector<T>& vector, const T& value) {
    if (vector.size() == vector.capacity()) vector.reserve(vector.size() + vector.size() / 8 + 8);
    vector.push_back(value);
}

}  // namespace

void GlideList::resize_table(uint64_t count) {
    handles_.reset(count);
    for (uint32_t place = 0; place < glides_.size(); ++place) handles_.insert(glides_[place].split, place);
}

uint32_t GlideList::take_slot(const GlideVertex& vertex, uint32_t next) {
    uint32_t slot = first_free_;
    if (slot == kNone) {
        append(vertices_, vertex), append(next_slot_, next);
        return uint32_t(vertices_.size() - 1);
    }
    first_free_ = next_slot_[slot];
    vertices_[slot] = vertex, next_slot_[slot] = next;
    return slot;
}

void GlideList::add(const Glide& glide, std::span<const GlideVertex> vertices, std::vector<uint32_t>& slots) {
    if (handles_.wants_resize(glides_.size() + 1)) resize_table(glides_.size() + 1);
    handles_.insert(glide.split, uint32_t(glides_.size()));
    append(glides_, glide);
    Glide& added = glides_.back();
    added.first_slot = kNone;
    slots.clear();
    for (const GlideVertex& vertex : vertices) {
        added.first_slot = take_slot(vertex, added.first_slot);
        slots.push_back(added.first_slot);
    }
}

void GlideList::remove(uint32_t split) {
    size_t place = find(split);
    uint32_t at = handles_[place], slot = glides_[at].first_slot;
    if (slot != kNone) {
        uint32_t first = slot;
        while (next_slot_[slot] != kNone) slot = next_slot_[slot];
        next_slot_[slot] = first_free_;
        first_free_ = first;
    }
    handles_.erase(place, [&](uint32_t handle) { return glides_[handle].split; });
    if (at + 1 != glides_.size()) {
        handles_[find(glides_.back().split)] = at;
        glides_[at] = glides_.back();
    }
    glides_.pop_back();
    if (handles_.wants_resize(glides_.size())) resize_table(glides_.size());
}

void GlideList::advance(float step, std::vector<Glide>& arrived) {
    arrived.clear();
    for (Glide& glide : glides_) {
        glide.share = std::clamp(glide.share + (glide.is_collapsing ? -step : step), 0.0f, 1.0f);
        for (uint32_t slot = glide.first_slot; slot != kNone; slot = next_slot_[slot]) vertices_[slot].share = glide.share;
        if (glide.share == (glide.is_collapsing ? 0.0f : 1.0f)) arrived.push_back(glide);
    }
    std::sort(arrived.begin(), arrived.end(), [](const Glide& a, const Glide& b) { return a.split < b.split; });
}

uint64_t GlideList::bytes() const {
    return glides_.capacity() * sizeof(Glide) + handles_.bytes() + vertices_.capacity() * sizeof(GlideVertex) +
           next_slot_.capacity() * sizeof(uint32_t);
}

}  // namespace overlook::caveclod
