#include "formats/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <memory>

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

void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    if (count == 0) return;
    grain = std::max<size_t>(1, grain);
    size_t ranges = (count + grain - 1) / grain;
    tbb::parallel_for(size_t(0), ranges, [&](size_t i) { body(i * grain, std::min(count, (i + 1) * grain)); });
}

}  // namespace overlook
