// Threads that decode blocks beside the frames.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/stream/stream.h"

namespace overlook::stream {

// To be used, made and ended by one thread. The source must outlive it, and so must the bytes of an order until it is done.
class Workers {
  public:
    Workers(const Source& source, unsigned count);
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    ~Workers();  // gives up what has not begun

    struct Order {
        uint32_t block = 0;
        std::vector<std::span<const std::byte>> needed;
    };
    using Done = std::pair<uint32_t, Result<Bytes>>;

    void begin(Order order);
    // One that is done, the first that was; none if none is.
    std::optional<Done> take();
    // This one, begun before; waits for it.
    Result<Bytes> wait_for(uint32_t block);

    // What a source decodes, with what it throws made an error and its length checked.
    static Result<Bytes> decode(const Source& source, const Order& order);

  private:
    void run();

    const Source& source_;
    std::mutex mutex_;  // of all below
    std::condition_variable begun_, finished_;
    std::deque<Order> orders_;
    std::deque<Done> done_;
    bool is_ending_ = false;
    std::vector<std::thread> threads_;  // last: they use the others
};

}  // namespace overlook::stream
