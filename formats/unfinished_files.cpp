#include "formats/unfinished_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>

#include "formats/atomic_file.h"

namespace overlook {
namespace {

enum State : int { kFree, kBeingFilled, kTaken };

struct Slot {
    std::atomic<int> state{kFree};
    pid_t process = 0;  // a forked child must not remove its parent's files
    char path[PATH_MAX] = {};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may use lock-free atomics only");

std::array<Slot, kMaxUnfinishedFiles> slots;

}  // namespace

int remember_unfinished_file(const std::string& path) noexcept {
    if (path.size() >= PATH_MAX) return kNoUnfinishedSlot;
    for (int i = 0; i < kMaxUnfinishedFiles; i++) {
        Slot& slot = slots[size_t(i)];
        int expected = kFree;
        if (!slot.state.compare_exchange_strong(expected, kBeingFilled)) continue;
        slot.process = getpid();
        std::memcpy(slot.path, path.c_str(), path.size() + 1);
        slot.state.store(kTaken);
        return i;
    }
    return kNoUnfinishedSlot;
}

void forget_unfinished_file(int slot) noexcept {
    if (slot != kNoUnfinishedSlot) slots[size_t(slot)].state.store(kFree);
}

void remove_unfinished_files() noexcept {
    int saved_errno = errno;
    for (Slot& slot : slots) {
        if (slot.state.load() == kTaken && slot.process == getpid()) unlink(slot.path);
    }
    errno = saved_errno;
}

}  // namespace overlook
