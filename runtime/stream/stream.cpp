#include "runtime/stream/stream.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "formats/numbers.h"
#include "runtime/stream/workers.h"

namespace overlook::stream {
namespace {

// Blocks on their way are worth so many frames' uploads at most, so that the latest wishes wait for few of the older ones.
constexpr uint64_t kFramesOnTheWay = 2;

}  // namespace

Result<std::unique_ptr<Stream>> Stream::open(std::string name, Source source, const Settings& settings) {
    assert(settings.worker_count >= 1 && settings.latency_frames.value_or(1) >= 1);
    for (uint32_t block = 0; block < source.block_count(); ++block) {
        uint64_t bytes = source.decoded_bytes[block], upload = source.upload_bytes_of(block);
        bool is_upload =
            upload > settings.upload_budget_bytes &&
            (bytes <= settings.residency_budget_bytes || settings.upload_budget_bytes <= settings.residency_budget_bytes);
        if (!is_upload && bytes <= settings.residency_budget_bytes) continue;
        return impossible("{}: block {} takes {} bytes; {} budget of {} is too small for it", name, block,
                          with_commas(is_upload ? upload : bytes), is_upload ? "an upload" : "a residency",
                          with_commas(is_upload ? settings.upload_budget_bytes : settings.residency_budget_bytes));
    }
    return std::unique_ptr<Stream>(new Stream(std::move(name), std::move(source), settings));
}

Stream::Stream(std::string name, Source source, const Settings& settings)
    : name_(std::move(name)),
      source_(std::move(source)),
      settings_(settings),
      slots_(source_.block_count()),
      workers_(std::make_unique<Workers>(source_, settings.worker_count)) {}

Stream::~Stream() = default;

Result<void> Stream::keep(std::span<const uint32_t> blocks) {
    uint64_t bytes = counts_.resident_bytes;
    for (uint32_t block : blocks) bytes += is_resident(block) ? 0 : source_.decoded_bytes[block];
    if (bytes > settings_.residency_budget_bytes)
        return impossible("{}: its coarsest blocks take {} bytes; {} for what is streamed are too few", name_, with_commas(bytes),
                          with_commas(settings_.residency_budget_bytes));
    for (uint32_t block : blocks) {
        slots_[block].is_kept = true;
        if (is_resident(block)) continue;
        Workers::Order order{block, {}};
        for (uint32_t need : source_.needs_of(block)) order.needed.push_back(slots_[need].bytes);
        Result<Bytes> decoded = Workers::decode(source_, order);
        if (!decoded) return tl::unexpected(decoded.error());
        slots_[block].bytes = std::move(*decoded);
        slots_[block].held_bytes = source_.decoded_bytes[block];
        counts_.resident_bytes += source_.decoded_bytes[block];
    }
    return {};
}

void Stream::take_over(uint32_t block, Result<Bytes> decoded) {
    Slot& slot = slots_[block];
    slot.is_on_the_way = false;
    counts_.on_the_way_bytes -= source_.decoded_bytes[block];
    uploads_on_the_way_bytes_ -= source_.upload_bytes_of(block);
    if (!decoded) {
        slot.has_failed = true;
        ++counts_.failed_count;
        changes_.faults.push_back(decoded.error());
        return;
    }
    slot.bytes = std::move(*decoded);
    slot.held_bytes = source_.decoded_bytes[block];
    slot.used_frame = frame_ - 1;  // as what it needs
    counts_.resident_bytes += slot.held_bytes;
    counts_.uploaded_bytes += source_.upload_bytes_of(block);
    ++counts_.arrived_count;
    changes_.arrived.push_back(block);
}

// In the order sent for, as far as one frame's uploads reach.
void Stream::take_due() {
    while (!on_the_way_.empty() && on_the_way_.front().due_frame <= frame_) {
        uint32_t block = on_the_way_.front().block;
        if (counts_.uploaded_bytes + source_.upload_bytes_of(block) > settings_.upload_budget_bytes) return;
        on_the_way_.pop_front();
        take_over(block, workers_->wait_for(block));
    }
}

void Stream::take_finished() {
    // A block is taken only if the greatest would still fit: which one is next, nobody knows before.
    uint64_t greatest = 0;
    for (const Order& order : on_the_way_) greatest = std::max(greatest, source_.upload_bytes_of(order.block));
    while (counts_.uploaded_bytes + greatest <= settings_.upload_budget_bytes) {
        std::optional<Workers::Done> done = workers_->take();
        if (!done) return;
        std::erase_if(on_the_way_, [&](const Order& order) { return order.block == done->first; });
        take_over(done->first, std::move(done->second));
    }
}

const Stream::Changes& Stream::begin_frame() {
    ++frame_;
    changes_ = {};
    changes_.dropped.swap(dropped_);
    counts_.used_count = counts_.asked_count = counts_.refused_count = counts_.uploaded_bytes = 0;
    if (settings_.latency_frames)
        take_due();
    else
        take_finished();
    return changes_;
}

void Stream::set_held_bytes(uint32_t block, uint64_t bytes) {
    Slot& slot = slots_[block];
    assert(source_.keeps_blocks && is_resident(block) && bytes >= 1 && bytes <= source_.decoded_bytes[block]);
    counts_.resident_bytes = counts_.resident_bytes - slot.held_bytes + bytes;
    slot.held_bytes = bytes;
}

void Stream::use(uint32_t block) {
    Slot& slot = slots_[block];
    assert(is_resident(block));
    if (slot.used_frame == frame_) return;
    slot.used_frame = frame_;
    ++counts_.used_count;
    for (uint32_t need : source_.needs_of(block)) use(need);
}

void Stream::ask(uint32_t block, float priority) {
    if (!is_resident(block)) wishes_.push_back({priority, block});
}

// What goes first last: the longest unused, and of equals the finest. A block was never used later than what it needs, so this
// order drops nothing before what needs it.
void Stream::find_droppable() {
    knows_droppable_ = true;
    droppable_.clear(), droppable_bytes_ = 0;
    for (uint32_t block = 0; block < slots_.size(); ++block) {
        const Slot& slot = slots_[block];
        if (!is_resident(block) || slot.is_kept || slot.used_frame == frame_) continue;
        droppable_.push_back(block);
        droppable_bytes_ += slot.held_bytes;
    }
    std::sort(droppable_.begin(), droppable_.end(), [&](uint32_t a, uint32_t b) {
        uint64_t used_a = slots_[a].used_frame, used_b = slots_[b].used_frame;
        return used_a != used_b ? used_a > used_b : a < b;
    });
}

// Drops nothing unless that is enough.
bool Stream::make_room(uint64_t wanted_bytes) {
    uint64_t held = counts_.resident_bytes + counts_.on_the_way_bytes;
    if (held + wanted_bytes <= settings_.residency_budget_bytes) return true;
    if (!knows_droppable_) find_droppable();
    if (held - droppable_bytes_ + wanted_bytes > settings_.residency_budget_bytes) return false;
    while (counts_.resident_bytes + counts_.on_the_way_bytes + wanted_bytes > settings_.residency_budget_bytes) {
        uint32_t block = droppable_.back();
        droppable_.pop_back();
        uint64_t bytes = slots_[block].held_bytes;
        slots_[block].bytes = Bytes();
        slots_[block].held_bytes = 0;
        counts_.resident_bytes -= bytes, droppable_bytes_ -= bytes;
        ++counts_.dropped_count;
        dropped_.push_back(block);
    }
    return true;
}

void Stream::send_for(uint32_t block) {
    uint64_t bytes = source_.decoded_bytes[block], upload = source_.upload_bytes_of(block),
             most_on_the_way = kFramesOnTheWay * settings_.upload_budget_bytes * settings_.latency_frames.value_or(1);
    if (uploads_on_the_way_bytes_ + upload > most_on_the_way) return;
    if (!make_room(bytes)) {
        ++counts_.refused_count;
        return;
    }
    Workers::Order order{block, {}};
    for (uint32_t need : source_.needs_of(block)) order.needed.push_back(slots_[need].bytes);
    slots_[block].is_on_the_way = true;
    counts_.on_the_way_bytes += bytes;
    uploads_on_the_way_bytes_ += upload;
    ++counts_.sent_for_count;
    on_the_way_.push_back({block, frame_ + settings_.latency_frames.value_or(1)});
    workers_->begin(std::move(order));
}

// The block, if all that it needs is there, else what of that is missing.
void Stream::send_for_missing(uint32_t block) {
    Slot& slot = slots_[block];
    if (is_resident(block) || slot.is_on_the_way || slot.has_failed) return;
    bool is_ready = true;
    for (uint32_t need : source_.needs_of(block)) {
        if (is_resident(need)) continue;
        is_ready = false;
        send_for_missing(need);
    }
    if (is_ready) send_for(block);
}

// What it needs, and is there, counts as used.
void Stream::hold_needs(uint32_t block) {
    for (uint32_t need : source_.needs_of(block)) {
        if (is_resident(need))
            use(need);
        else
            hold_needs(need);
    }
}

// Each block once, with its greatest priority, in the order in which they are served.
void Stream::order_wishes() {
    std::sort(wishes_.begin(), wishes_.end(),
              [](const Wish& a, const Wish& b) { return a.block != b.block ? a.block < b.block : a.priority > b.priority; });
    auto is_same = [](const Wish& a, const Wish& b) { return a.block == b.block; };
    wishes_.erase(std::unique(wishes_.begin(), wishes_.end(), is_same), wishes_.end());
    std::stable_sort(wishes_.begin(), wishes_.end(), [](const Wish& a, const Wish& b) { return a.priority > b.priority; });
}

void Stream::end_frame() {
    order_wishes();
    counts_.asked_count = wishes_.size();
    for (const Order& order : on_the_way_) hold_needs(order.block);
    for (const Wish& wish : wishes_) hold_needs(wish.block);

    knows_droppable_ = false;
    for (const Wish& wish : wishes_) send_for_missing(wish.block);
    wishes_.clear();
}

}  // namespace overlook::stream
