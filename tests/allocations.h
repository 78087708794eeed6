// How often the program asks for memory: `new` is counted wherever it is called.
#pragma once

#include <cstdint>

namespace overlook::test {

// Calls of operator new by all threads so far, malloc's other users not counted.
uint64_t allocation_count();

}  // namespace overlook::test
