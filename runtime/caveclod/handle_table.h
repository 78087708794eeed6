// Where things that have a number stand: 32-bit handles found by that number, which the things themselves know.
//
// Based on: D. Knuth, The Art of Computer Programming 3, 6.4, 1998 (linear probing, deletion by shifting back).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace overlook::caveclod {

// key_of: the number of the thing that a handle stands for. Whoever adds or removes things asks wants_resize() and enters all of
// them anew where it says so: then 3/4 to 7/8 of the table is full, 4.6 to 5.3 bytes a thing.
class HandleTable {
  public:
    static constexpr uint32_t kNone = ~0u;
    static constexpr size_t kNowhere = ~size_t(0);

    HandleTable() : handles_(kLeast, kNone) {}

    template <class KeyOf>
    size_t find(uint32_t key, const KeyOf& key_of) const {
        for (size_t place = home(key);; place = next(place)) {
            if (handles_[place] == kNone) return kNowhere;
            if (key_of(handles_[place]) == key) return place;
        }
    }
    uint32_t& operator[](size_t place) { return handles_[place]; }
    uint32_t operator[](size_t place) const { return handles_[place]; }

    // Of a key that is not there.
    void insert(uint32_t key, uint32_t handle) {
        size_t place = home(key);
        while (handles_[place] != kNone) place = next(place);
        handles_[place] = handle;
    }
    // What stands behind moves up as far as its home allows, so that no gap is left.
    template <class KeyOf>
    void erase(size_t place, const KeyOf& key_of) {
        size_t gap = place;
        for (size_t at = next(place); handles_[at] != kNone; at = next(at)) {
            if (way(home(key_of(handles_[at])), at) < way(gap, at)) continue;
            handles_[gap] = handles_[at];
            gap = at;
        }
        handles_[gap] = kNone;
    }

    // Whether so many would leave too little or too much room.
    bool wants_resize(uint64_t count) const {
        uint64_t size = handles_.size();
        return count * 8 > size * 7 || (size > kLeast && count * 4 < size * 3);
    }
    // Of the size for so many, and empty.
    void reset(uint64_t count) {
        std::vector<uint32_t>(std::max<size_t>(kLeast, size_t(count * 16 / 13 + 1)), kNone).swap(handles_);
    }
    uint64_t bytes() const { return handles_.capacity() * sizeof(uint32_t); }

  private:
    static constexpr size_t kLeast = 64;

    size_t home(uint32_t key) const { return size_t((uint64_t(key * 0x9e3779b1u) * handles_.size()) >> 32); }
    size_t next(size_t place) const { return place + 1 == handles_.size() ? 0 : place + 1; }
    // How many places on from one to the other.
    size_t way(size_t from, size_t to) const { return to >= from ? to - from : to + handles_.size() - from; }

    std::vector<uint32_t> handles_;
};

}  // namespace overlook::caveclod
