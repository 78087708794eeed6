// Values that stand once each.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::mesh {

// Numbers values of a plain type by their first occurrence, equal bytes equal numbers. Open addressing with linear probing.
template <class T>
class UniqueValues {
  public:
    explicit UniqueValues(size_t expected_count)
        : table_(std::bit_ceil(2 * expected_count + 2), kNone), mask_(table_.size() - 1) {}

    // The number of a value; more values than expected may not come.
    uint32_t number_of(const T& value) {
        for (size_t at = hash_of(value) & mask_;; at = (at + 1) & mask_) {
            uint32_t& number = table_[at];
            if (number == kNone) {
                number = uint32_t(values_.size());
                values_.push_back(value);
                return number;
            }
            if (std::memcmp(&values_[number], &value, sizeof(T)) == 0) return number;
        }
    }
    std::vector<T> take() { return std::move(values_); }

  private:
    static size_t hash_of(const T& value) {
        static_assert(sizeof(T) % 4 == 0);
        uint64_t hash = 0x9e3779b97f4a7c15;
        for (size_t i = 0; i < sizeof(T); i += 4) {
            uint32_t word = 0;
            std::memcpy(&word, reinterpret_cast<const char*>(&value) + i, 4);
            hash = (hash ^ word) * 0xff51afd7ed558ccd;
            hash ^= hash >> 32;
        }
        return size_t(hash);
    }

    std::vector<T> values_;
    std::vector<uint32_t> table_;
    size_t mask_;
};

}  // namespace overlook::mesh
