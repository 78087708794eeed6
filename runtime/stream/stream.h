// Blocks of a baked file that come while it is drawn: decoded by worker threads, taken over between two frames, dropped when
// others need their room. The frame never waits for one: what it stands on is there, what it misses it asks for.
//
// Based on: the working sets of P. Denning, The Working Set Model for Program Behavior, 1968 (what the present frame uses stays,
// the least recently used goes first), over a hierarchy in which a block comes after those that it needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/result.h"

namespace overlook::stream {

class Workers;

using Bytes = std::vector<std::byte>;

// What can be streamed: n blocks, numbered coarse to fine.
struct Source {
    std::vector<uint64_t> decoded_bytes;         // [n], 1 at least
    std::vector<uint32_t> need_begin{0}, needs;  // [n + 1], [..] compressed rows: blocks that come before block i, all below i

    std::vector<uint64_t> upload_bytes;  // [n] of what a frame takes over with a block; empty: all of it
    // The source itself keeps what it decodes, in decoded_bytes at most, until the block is dropped.
    bool keeps_blocks = false;

    // A block as exactly its decoded_bytes, or as nothing if the source keeps it; needed: the bytes of its needs, in their order.
    // Called by several workers at once, for different blocks. Must not touch what the frame's thread changes.
    std::function<Result<Bytes>(uint32_t block, std::span<const std::span<const std::byte>> needed)> decode;

    uint32_t block_count() const { return uint32_t(decoded_bytes.size()); }
    uint64_t upload_bytes_of(uint32_t block) const { return upload_bytes.empty() ? decoded_bytes[block] : upload_bytes[block]; }
    std::span<const uint32_t> needs_of(uint32_t block) const {
        return std::span(needs).subspan(need_begin[block], need_begin[block + 1] - need_begin[block]);
    }
};

struct Settings {
    uint64_t residency_budget_bytes = uint64_t(1) << 30;  // of all blocks that are there or on their way
    uint64_t upload_budget_bytes = uint64_t(16) << 20;    // of the blocks that one frame takes over
    unsigned worker_count = 1;                            // at least 1
    // None: a block comes when it is decoded. n >= 1: n frames after it was sent for (and in that order), whatever the workers'
    // speed, for which begin_frame() then waits: the same frames give the same pictures.
    std::optional<uint32_t> latency_frames;
};

struct Counts {
    // Of the frame begun last.
    uint64_t used_count = 0;      // blocks used, counting those that they, and what is asked for, need
    uint64_t asked_count = 0;     // blocks asked for that are not there
    uint64_t refused_count = 0;   // those for which there was no room
    uint64_t uploaded_bytes = 0;  // of the blocks taken over
    // Of all frames.
    uint64_t sent_for_count = 0, arrived_count = 0, dropped_count = 0, failed_count = 0;
    // Now.
    uint64_t resident_bytes = 0, on_the_way_bytes = 0;
};

// All calls by one thread, that of the frames: begin_frame, then use() and ask(), then end_frame.
class Stream {
  public:
    // Fails with Exit::impossible if a block alone is beyond a budget:
    //   "valley.ovl: block 3 takes 83,205 bytes; an upload budget of 65,536 is too small for it"
    static Result<std::unique_ptr<Stream>> open(std::string name, Source source, const Settings& settings);
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream();  // waits for the blocks that are being decoded now

    // Decodes blocks at once, in this thread, that never go: those that everything stands on, in an order in which their needs
    // come first. Before the first frame. Fails as `decode`, and with Exit::impossible if they are beyond the residency budget:
    //   "valley.ovl: its coarsest blocks take 1,048,576 bytes; 65,536 for what is streamed are too few"
    Result<void> keep(std::span<const uint32_t> blocks);

    // What has changed since the frame before. A block that cannot be decoded is told of once, and never asked for again.
    struct Changes {
        std::vector<uint32_t> arrived, dropped;  // dropped: before those that arrived
        std::vector<Error> faults;
    };
    const Changes& begin_frame();

    bool is_resident(uint32_t block) const { return slots_[block].held_bytes > 0; }
    // Empty if it is not there, or if the source keeps it.
    std::span<const std::byte> bytes(uint32_t block) const { return slots_[block].bytes; }
    // Of a source that keeps its blocks: this one, which is there, takes so many bytes in truth, 1 at least and its decoded_bytes
    // at most.
    void set_held_bytes(uint32_t block, uint64_t bytes);

    // The present frame draws with this block, which is there: neither it nor what it needs goes before end_frame() of a later
    // frame that does not use it.
    void use(uint32_t block);
    // The present frame would be finer with this block; those it needs come first. The greatest priority goes first, among
    // equals the lowest number. Who still wants it in the next frame asks again.
    void ask(uint32_t block, float priority);

    // Drops and sends for what the frame asked for, as the budgets allow.
    void end_frame();

    // Nothing is on its way: after end_frame(), what the frame asked for is there, has failed or has no room.
    bool is_settled() const { return on_the_way_.empty(); }
    const Counts& counts() const { return counts_; }
    const Settings& settings() const { return settings_; }

  private:
    struct Slot {
        Bytes bytes;
        uint64_t held_bytes = 0;
        uint64_t used_frame = 0;
        bool is_kept = false, is_on_the_way = false, has_failed = false;
    };
    struct Wish {
        float priority;
        uint32_t block;
    };
    struct Order {
        uint32_t block;
        uint64_t due_frame;
    };

    Stream(std::string name, Source source, const Settings& settings);
    void take_over(uint32_t block, Result<Bytes> decoded);
    void take_due();
    void take_finished();
    void send_for_missing(uint32_t block);
    void send_for(uint32_t block);
    bool make_room(uint64_t wanted_bytes);
    void find_droppable();
    void hold_needs(uint32_t block);
    void order_wishes();

    std::string name_;
    Source source_;
    Settings settings_;
    std::vector<Slot> slots_;
    std::deque<Order> on_the_way_;  // as sent for
    std::vector<Wish> wishes_;
    std::vector<uint32_t> droppable_;  // of this end_frame(), the next to go last
    bool knows_droppable_ = false;
    uint64_t droppable_bytes_ = 0, uploads_on_the_way_bytes_ = 0;
    Changes changes_;
    std::vector<uint32_t> dropped_;  // since begin_frame()
    Counts counts_;
    uint64_t frame_ = 0;
    std::unique_ptr<Workers> workers_;  // last: they use the others
};

}  // namespace overlook::stream
