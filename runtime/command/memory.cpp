#include "runtime/command/memory.h"

#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "formats/parallel.h"

namespace overlook::command {
namespace {

// For the threads that libraries start, one a core; the system's own 8 MiB would be counted in full.
constexpr size_t kStackBytes = 1 << 20;
// What oneTBB gives each of its threads.
constexpr uint64_t kWorkerStackBytes = 4 << 20;
// For small inputs, and for messages about large ones.
constexpr uint64_t kWorkingRoomBytes = 80 << 20;

// What RLIMIT_DATA counts of this process, 0 if the system does not say.
uint64_t private_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string key; status >> key;) {
        uint64_t kilobytes = 0;
        if (key == "VmData:" && status >> kilobytes) return kilobytes << 10;
        status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return 0;
}

void shrink_stacks() {
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return;
    if (pthread_attr_setstacksize(&attributes, kStackBytes) == 0) pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
}

}  // namespace

Result<void> keep_memory_cap(uint64_t cap_bytes) {
    uint64_t library_threads = std::max(1u, std::thread::hardware_concurrency());
    uint64_t least = private_bytes() + library_threads * kStackBytes + thread_count() * kWorkerStackBytes + kWorkingRoomBytes;
    if (cap_bytes < least)
        return impossible("--memory {}: is less than this program needs to begin with; give it {}M or more", cap_bytes,
                          (least >> 20) + 1);

    shrink_stacks();
    struct rlimit limit {};
    if (getrlimit(RLIMIT_DATA, &limit) != 0)
        return impossible("--memory {}: the system keeps no cap: {}", cap_bytes, std::strerror(errno));
    if (cap_bytes >= limit.rlim_cur) return {};  // a stricter one is kept already
    limit.rlim_cur = cap_bytes;
    if (setrlimit(RLIMIT_DATA, &limit) != 0)
        return impossible("--memory {}: the system keeps no cap: {}", cap_bytes, std::strerror(errno));

    // The worker threads now, while there is room for their stacks.
    parallel_ranges(thread_count(), 1, [](size_t, size_t) {});
    return {};
}

}  // namespace overlook::command
