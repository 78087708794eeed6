// The temporary files of this process that a signal handler must be able to remove: a table of fixed size, no locks.
#pragma once

#include <string>

namespace overlook {

constexpr int kMaxUnfinishedFiles = 64;
constexpr int kNoUnfinishedSlot = -1;

// Enters a path, so that remove_unfinished_files() removes it. Returns its slot, or kNoUnfinishedSlot if all are taken or the
// path is longer than a path can be (4,095 bytes). Any thread.
int remember_unfinished_file(const std::string& path) noexcept;

// Frees a slot; kNoUnfinishedSlot is allowed and does nothing.
void forget_unfinished_file(int slot) noexcept;

}  // namespace overlook
