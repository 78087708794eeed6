// Small numbers of tiles that take long to find out, remembered for tiles that are asked about again: those near each other.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace overlook::wang_ldi {

// Of a function of a tile's place. A tile is forgotten when one is asked about that lies a multiple of kSide tiles from it along
// both axes. Any thread, at the same time: each finds the function's value. Memory: 8 MiB.
class PlaceCache {
  public:
    static constexpr int64_t kSide = 1024;  // a power of two
    static constexpr int64_t kFarthest = int64_t(1) << 27;

    PlaceCache() : entries_(new std::atomic<uint64_t>[size_t(kSide * kSide)]()) {}

    // value(): from 0 to 255. Tiles as far away as kFarthest are not remembered.
    template <class Value>
    uint8_t at(int64_t x, int64_t y, const Value& value) {
        if (x <= -kFarthest || x >= kFarthest || y <= -kFarthest || y >= kFarthest) return uint8_t(value());
        uint64_t place = uint64_t(x + kFarthest) << 36 | uint64_t(y + kFarthest) << 8;  // never 0, as an empty entry is
        std::atomic<uint64_t>& entry = entries_[size_t((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
        uint64_t found = entry.load(std::memory_order_relaxed);
        if ((found & ~uint64_t(255)) == place) return uint8_t(found & 255);
        auto made = uint8_t(value());
        entry.store(place | made, std::memory_order_relaxed);
        return made;
    }

  private:
    std::unique_ptr<std::atomic<uint64_t>[]> entries_;
};

}  // namespace overlook::wang_ldi
