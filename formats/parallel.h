// Work shared between threads so that the result never depends on how many there are.
#pragma once

#include <cstddef>
#include <functional>

namespace overlook {

// How many threads everything in this process may use; 0 = all that the machine has. Call once, early.
void set_thread_count(unsigned threads);
unsigned thread_count();

// Calls body(begin, end) on disjoint ranges that together are [0, count), each at most `grain` long and starting at a
// multiple of it: the ranges are the same for every thread count, only their order in time differs.
// body must not throw.
void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

// Runs both, at the same time where there are threads for it; what they share among threads is shared between all. They must not
// throw.
void parallel_both(const std::function<void()>& one, const std::function<void()>& other);

// Runs it so that libraries which it calls, and which share work among threads by themselves, have one thread there.
void by_one_thread(const std::function<void()>& body);

}  // namespace overlook
