// Short work that comes again and again, shared between threads that are still awake from the last.
#pragma once

#include <functional>

namespace overlook {

// Calls body(0) in this thread and body(1), body(2), ... in others at the same time, `most` in all (or 1) and thread_count() at
// most; returns when all have returned. Others come when they can: bodies take their work from a common store, and one that comes
// late, or never, must find nothing left to do. body must not throw, nor call this again. Where another thread has the crew
// already, body(0) alone is called.
//
// Waking a thread takes tens of microseconds, as much as the work of a frame may. So one that has had work waits awake for
// kAwake_us more; for kAwakeLonger_us where the work before came within that time of the one before it.
constexpr int kAwake_us = 50, kAwakeLonger_us = 1000;
void work_together(unsigned most, const std::function<void(unsigned worker)>& body);

}  // namespace overlook
