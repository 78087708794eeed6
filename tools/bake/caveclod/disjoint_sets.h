// Sets that only ever grow together (union-find), with a result that does not depend on the order of the unions.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace overlook::caveclod {

// Elements 0..count-1, each at first alone. A set is named by its least element, so that names depend on the sets alone. Path
// halving: O(log count) a call, amortised.
struct DisjointSets {
    std::vector<uint32_t> parent;

    explicit DisjointSets(size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0u); }
    uint32_t find(uint32_t element) {
        while (parent[element] != element) element = parent[element] = parent[parent[element]];
        return element;
    }
    void unite(uint32_t a, uint32_t b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parent[b] = a;
        else
            parent[a] = b;
    }
};

}  // namespace overlook::caveclod
