#include "tests/bench/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<uint64_t> calls{0};

void* counted(std::size_t bytes) {
    calls.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    throw std::bad_alloc();
}

}  // namespace

// Those that are not replaced here (arrays, nothrow) call these; over-aligned ones are nobody's in the measured code.
void* operator new(std::size_t bytes) {
    return counted(bytes);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace overlook::bench {

uint64_t allocation_count() {
    return calls.load(std::memory_order_relaxed);
}

}  // namespace overlook::bench
