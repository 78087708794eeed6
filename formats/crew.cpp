#include "formats/crew.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "formats/parallel.h"

namespace overlook {
namespace {

using Clock = std::chrono::steady_clock;

// state_, from the lowest bit: how many others are at the work, how many have come to it, whether more may, which piece it is.
constexpr uint64_t kCome = 1 << 16, kInside = kCome - 1, kOpen = kCome << 16, kPiece = kOpen << 1;
constexpr uint64_t come_of(uint64_t state) {
    return state % kOpen / kCome;
}

class Crew {
  public:
    ~Crew() {
        {
            std::lock_guard lock(asleep_);
            ends_ = true;
        }
        wakes_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }

    void work(unsigned most, const std::function<void(unsigned)>& body) {
        std::unique_lock mine(in_use_, std::try_to_lock);
        unsigned others = std::max(1u, std::min(most, thread_count())) - 1;
        if (!mine.owns_lock() || others == 0 || !hire(others)) {
            body(0);
            return;
        }
        body_ = &body, others_ = std::min<uint64_t>(others, threads_.size());
        state_.store((state_.load() / kPiece + 1) * kPiece + kOpen);
        if (sleeping_.load() > 0) {
            std::lock_guard lock(asleep_);
            wakes_.notify_all();
        }
        body(0);
        state_.fetch_and(~kOpen);
        while ((state_.load() & kInside) != 0) std::this_thread::yield();
    }

  private:
    // False where the system gives none.
    bool hire(size_t count) {
        try {
            while (threads_.size() < count) threads_.emplace_back([this] { stay(); });
        } catch (const std::system_error&) {
        }
        return !threads_.empty();
    }

    // One thread's life.
    void stay() {
        uint64_t seen = 0;
        Clock::time_point last = Clock::now();
        Clock::duration awake = std::chrono::microseconds(kAwake_us);
        while (wait(seen, last + awake)) {
            Clock::time_point now = Clock::now();
            bool is_soon = now - last < std::chrono::microseconds(kAwakeLonger_us);
            awake = std::chrono::microseconds(is_soon ? kAwakeLonger_us : kAwake_us);
            join(seen);
            last = Clock::now();
        }
    }

    // For a piece of work other than `seen`, which becomes it. False at the end.
    bool wait(uint64_t& seen, Clock::time_point until) {
        auto is_new = [&] { return state_.load() / kPiece != seen; };
        while (!is_new() && Clock::now() < until) std::this_thread::yield();
        if (!is_new()) {
            std::unique_lock lock(asleep_);
            ++sleeping_;
            wakes_.wait(lock, [&] { return ends_ || is_new(); });
            --sleeping_;
            if (ends_) return false;
        }
        seen = state_.load() / kPiece;
        return true;
    }

    void join(uint64_t piece) {
        uint64_t state = state_.load();
        do {
            bool may_come = state / kPiece == piece && (state & kOpen) != 0 && come_of(state) < others_.load();
            if (!may_come) return;
        } while (!state_.compare_exchange_weak(state, state + kCome + 1));
        (*body_.load())(unsigned(come_of(state)) + 1);
        state_.fetch_sub(1);
    }

    std::mutex in_use_;  // by the one who has work
    std::atomic<uint64_t> state_{0}, others_{0};
    std::atomic<const std::function<void(unsigned)>*> body_{nullptr};
    std::atomic<int> sleeping_{0};
    std::mutex asleep_;
    std::condition_variable wakes_;
    bool ends_ = false;
    std::vector<std::thread> threads_;  // last: they use the others
};

}  // namespace

void work_together(unsigned most, const std::function<void(unsigned)>& body) {
    static Crew crew;
    crew.work(most, body);
}

}  // namespace overlook
