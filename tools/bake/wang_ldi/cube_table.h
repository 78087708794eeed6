// Small cubes of a tile by their place: a table of open addresses, which grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {

class CubeTable {
  public:
    static constexpr uint32_t kNone = 0xffffffff;

    CubeTable() : slots_(1 << 12) {}

    // The number of a cube; if it has none yet, it gets the next one (0, 1, 2 ...).
    uint32_t number_of(uint64_t cube) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = slots_[place_of(cube)];
        if (slot.number == kNone) slot = {cube, uint32_t(count_++)};
        return slot.number;
    }
    // Asks memory for what number_of() or find() will look at first.
    void fetch(uint64_t cube) const { __builtin_prefetch(&slots_[size_t(mixed(cube)) & (slots_.size() - 1)]); }
    // The same, or kNone.
    uint32_t find(uint64_t cube) const { return slots_[place_of(cube)].number; }
    size_t count() const { return count_; }

  private:
    struct Slot {
        uint64_t cube = 0;
        uint32_t number = kNone;
    };

    size_t place_of(uint64_t cube) const {
        size_t mask = slots_.size() - 1, place = size_t(mixed(cube)) & mask;
        while (slots_[place].number != kNone && slots_[place].cube != cube) place = (place + 1) & mask;
        return place;
    }
    void grow() {
        std::vector<Slot> before(slots_.size() * 4);
        before.swap(slots_);
        for (const Slot& slot : before)
            if (slot.number != kNone) slots_[place_of(slot.cube)] = slot;
    }

    std::vector<Slot> slots_;
    size_t count_ = 0;
};

}  // namespace overlook::wang_ldi
