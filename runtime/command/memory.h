// The cap that --memory sets.
#pragma once

#include <cstdint>

#include "formats/result.h"

namespace overlook::command {

// From here on the process gets at most `cap_bytes` of memory of its own: private and writable, as RLIMIT_DATA counts it - what
// is allocated and the threads' stacks, not the files that are mapped to be read. An allocation beyond it throws std::bad_alloc.
// Call after set_thread_count, before any thread is started. Fails with Exit::impossible where the program and its threads alone
// take more:
// "--memory 1000000: is less than this program needs to begin with; give it 192M or more".
Result<void> keep_memory_cap(uint64_t cap_bytes);

}  // namespace overlook::command
