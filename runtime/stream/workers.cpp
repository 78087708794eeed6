#include "runtime/stream/workers.h"

#include <algorithm>
#include <new>

namespace overlook::stream {

Workers::Workers(const Source& source, unsigned count) : source_(source) {
    for (unsigned i = 0; i < count; ++i) threads_.emplace_back([this] { run(); });
}

Workers::~Workers() {
    {
        std::lock_guard lock(mutex_);
        is_ending_ = true;
        orders_.clear();
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

Result<Bytes> Workers::decode(const Source& source, const Order& order) {
    try {
        Result<Bytes> decoded = source.decode(order.block, order.needed);
        uint64_t wanted = source.keeps_blocks ? 0 : source.decoded_bytes[order.block];
        if (decoded && decoded->size() != wanted)
            return tl::unexpected(Error{Exit::our_bug, fmt::format("a streamed block {} decodes to {} bytes, {} were announced",
                                                                   order.block, decoded->size(), wanted)});
        return decoded;
    } catch (const std::bad_alloc&) {
        return impossible("there is not enough memory for a streamed block of {} bytes", source.decoded_bytes[order.block]);
    }
}

void Workers::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        begun_.wait(lock, [&] { return is_ending_ || !orders_.empty(); });
        if (is_ending_) return;
        Order order = std::move(orders_.front());
        orders_.pop_front();
        lock.unlock();
        Result<Bytes> decoded = decode(source_, order);
        lock.lock();
        done_.emplace_back(order.block, std::move(decoded));
        finished_.notify_one();
    }
}

void Workers::begin(Order order) {
    {
        std::lock_guard lock(mutex_);
        orders_.push_back(std::move(order));
    }
    begun_.notify_one();
}

std::optional<Workers::Done> Workers::take() {
    std::lock_guard lock(mutex_);
    if (done_.empty()) return std::nullopt;
    Done first = std::move(done_.front());
    done_.pop_front();
    return first;
}

Result<Bytes> Workers::wait_for(uint32_t block) {
    std::unique_lock lock(mutex_);
    auto found = done_.end();
    finished_.wait(lock, [&] {
        found = std::find_if(done_.begin(), done_.end(), [&](const Done& done) { return done.first == block; });
        return found != done_.end();
    });
    Result<Bytes> decoded = std::move(found->second);
    done_.erase(found);
    return decoded;
}

}  // namespace overlook::stream
