// A table from three numbers to one that is emptied every frame, and takes no memory once it is as large as it needs to be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace overlook::lod_sprite::paper {

struct Triple {
    uint32_t a = 0, b = 0, c = 0;
    bool operator==(const Triple&) const = default;
};

class TripleTable {
  public:
    // Empties it. O(1) but once in 2^32 times; keeps its memory.
    void clear() {
        count_ = 0;
        if (++generation_ != 0) return;
        for (Entry& entry : entries_) entry.generation = 0;
        generation_ = 1;
    }
    // What is kept under a key; if nothing was, `value` is kept from now on and is_new says so. The reference holds until the
    // next call. O(1); takes memory only if there are more keys than ever before.
    uint32_t& at(const Triple& key, uint32_t value, bool& is_new) {
        if (2 * (count_ + 1) > entries_.size()) grow();
        Entry& entry = entries_[place_of(key)];
        is_new = entry.generation != generation_;
        if (is_new) {
            entry = {key, generation_, value};
            ++count_;
        }
        return entry.value;
    }
    size_t size() const { return count_; }
    size_t capacity_bytes() const { return entries_.capacity() * sizeof(Entry); }

  private:
    struct Entry {
        Triple key;
        uint32_t generation = 0;  // filled if it is the table's
        uint32_t value = 0;
    };

    size_t place_of(const Triple& key) const {
        uint64_t hash = (uint64_t(key.a) << 32 | key.b) * 0x9e3779b97f4a7c15u;
        hash = (hash ^ (hash >> 29) ^ key.c) * 0xbf58476d1ce4e5b9u;
        size_t mask = entries_.size() - 1, place = size_t(hash >> 32) & mask;
        while (entries_[place].generation == generation_ && entries_[place].key != key) place = (place + 1) & mask;
        return place;
    }
    void grow() {
        std::vector<Entry> before(entries_.empty() ? 1024 : 2 * entries_.size());
        before.swap(entries_);
        for (const Entry& entry : before)
            if (entry.generation == generation_) entries_[place_of(entry.key)] = entry;
    }

    std::vector<Entry> entries_;  // a power of two of them, at most half filled
    size_t count_ = 0;
    uint32_t generation_ = 1;
};

}  // namespace overlook::lod_sprite::paper
