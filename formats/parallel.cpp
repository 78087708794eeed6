#include "formats/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace overlook {
namespace {
std::unique_ptr<tbb::global_control> thread_limit;
}  // namespace

void set_thread_count(unsigned threads) {
    size_t count = threads != 0 ? threads : size_t(tbb::info::default_concurrency());
    thread_limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
}

unsigned thread_count() {
    size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return unsigned(std::max<size_t>(1, allowed));
}

#if defined(__SANITIZE_THREAD__)
#define OVERLOOK_PLAIN_THREADS
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define OVERLOOK_PLAIN_THREADS
#endif
#endif

#ifdef OVERLOOK_PLAIN_THREADS
// The thread sanitizer cannot see into Debian's oneTBB and takes every hand-over for a race: plain threads stand in for it.
void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    grain = std::max<size_t>(1, grain);
    size_t ranges = (count + grain - 1) / grain;
    std::atomic<size_t> next = 0;
    auto work = [&] {
        for (size_t i = next++; i < ranges; i = next++) body(i * grain, std::min(count, (i + 1) * grain));
    };
    std::vector<std::thread> others;
    for (size_t i = 1; i < std::min<size_t>(thread_count(), ranges); ++i) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
}
void parallel_both(const std::function<void()>& one, const std::function<void()>& other) {
    parallel_ranges(2, 1, [&](size_t which, size_t) { which == 0 ? one() : other(); });
}
#else
void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    if (count == 0) return;
    grain = std::max<size_t>(1, grain);
    size_t ranges = (count + grain - 1) / grain;
    tbb::parallel_for(size_t(0), ranges, [&](size_t i) { body(i * grain, std::min(count, (i + 1) * grain)); });
}
void parallel_both(const std::function<void()>& one, const std::function<void()>& other) {
    tbb::parallel_invoke(one, other);
}
#endif

void by_one_thread(const std::function<void()>& body) {
    tbb::task_arena(1).execute(body);
}

}  // namespace overlook
