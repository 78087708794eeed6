// What of a refinement's splits wants to change: Refinement's looking, which changes nothing.
#include <algorithm>
#include <bit>
#include <functional>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kPartWords = 32, kPartSplits = 64 * kPartWords;

// The bounds of what is appended lie scattered over the mesh: they are asked for long before they are read.
void append_bits(const Mesh& mesh, size_t word, uint64_t bits, std::vector<uint32_t>& splits) {
    for (; bits != 0; bits &= bits - 1) {
        splits.push_back(uint32_t(64 * word) + uint32_t(std::countr_zero(bits)));
        mesh.prefetch_bounds(splits.back());
    }
}

}  // namespace

void Refinement::Found::clear() {
    waiting.clear(), standing.clear(), moving.clear(), splits.clear(), collapses.clear(), reserve.clear(), turned.clear(),
        arrived.clear();
    error_px = 0, greatest = evaluated_count = 0;
}

size_t Refinement::part_count() const {
    return (size_t(mesh_.split_count()) + kPartSplits - 1) / kPartSplits;
}

// All that could change of a part.
void Refinement::look(const Frame& frame, size_t part) {
    Found& found = parts_[part];
    found.clear();
    for (size_t word = part * kPartWords, end = std::min(open_.size(), word + kPartWords); word < end; ++word) {
        append_bits(mesh_, word, open_[word] & ~applied_[word], found.waiting);
        if (!frame.asks_applied) continue;
        append_bits(mesh_, word, open_[word] & applied_[word] & ~gliding_[word], found.standing);
        append_bits(mesh_, word, open_[word] & gliding_[word], found.moving);
    }
    found.evaluated_count = uint32_t(found.waiting.size() + found.standing.size() + found.moving.size());
    look_at_waiting(frame, found);
    look_at_standing(frame, found);
    for (uint32_t split : found.moving) look_at(frame, split, found);
    double known_px = frame.known_px.load();
    while (found.error_px > known_px && !frame.known_px.compare_exchange_weak(known_px, found.error_px)) continue;
}

// Most of them show at once that they stay as they are, and that none of them is the greatest error. Only what can glide begins
// before it must.
void Refinement::look_at_waiting(const Frame& frame, Found& found) const {
    const ScreenTest& test = frame.test;
    double known_px = -1, glide_px = 0, fade_px = 0, reach = 0;
    for (uint32_t split : found.waiting) {
        if (double px = std::max(frame.known_px.load(std::memory_order_relaxed), found.error_px); px != known_px) {
            known_px = px;
            glide_px = std::min(known_px, test.least_split_px()), fade_px = std::min(known_px, test.least_limit_px());
            reach = test.reach_of(glide_px);
        }
        ScreenTest::Sphere sphere = test.sphere(split);
        if (test.is_within(sphere, reach) || test.is_seen_within(sphere, mesh_.glides(split) ? glide_px : fade_px)) continue;
        look_at(frame, split, found);
    }
}

void Refinement::look_at_standing(const Frame& frame, Found& found) const {
    bool all_closely = frame.keeps_reserve || mesh_.split_limit() < mesh_.split_count();
    for (uint32_t split : found.standing)
        if (all_closely || !frame.test.is_kept(frame.test.sphere(split))) look_at(frame, split, found);
}

void Refinement::look_at(const Frame& frame, uint32_t split, Found& found) const {
    auto answer = frame.test(split);
    if (split >= mesh_.split_limit()) answer.must_split = answer.wants_split = false, answer.wants_collapse = true;
    if (!has(applied_, split)) {
        if (answer.must_split || (answer.wants_split && mesh_.glides(split)))
            found.splits.push_back({answer.error_px, split});
        else
            found.leave(split, answer.seen_error_px);
    } else if (has(gliding_, split)) {
        if (answer.wants_split) found.turned.push_back(split);
        if (!glides_.of(split).moves) return;  // it is drawn as split
        if (answer.must_split)
            found.arrived.push_back(split);
        else
            found.leave(split, answer.seen_error_px);
    } else if (answer.wants_collapse) {
        found.collapses.push_back({answer.error_px, split});
    } else if (frame.keeps_reserve) {
        found.reserve.push_back({answer.error_px, split});
    }
}

// What was the greatest error in the last frame is likely to be so again, or nearly: then little else is looked at closely.
void Refinement::guess_greatest(Frame& frame) {
    one_.clear();
    bool is_left = greatest_left_ < split_count_ && has(open_, greatest_left_) && !has(applied_, greatest_left_);
    if (is_left) look_at(frame, greatest_left_, one_);
    if (one_.error_px > frame.report.error_px) frame.report.error_px = one_.error_px, frame.greatest_left = greatest_left_;
    frame.known_px.store(frame.report.error_px);
}

void Refinement::take(Frame& frame, const Found& found) {
    for (uint32_t split : found.turned) glides_.turn_back(split);
    for (uint32_t split : found.arrived) finish_glide(split);
    auto push = [](std::vector<Wish>& heap, const std::vector<Wish>& wishes, const auto& less) {
        for (const Wish& wish : wishes) {
            heap.push_back(wish);
            std::push_heap(heap.begin(), heap.end(), less);
        }
    };
    push(splits_, found.splits, std::less<>());
    push(collapses_, found.collapses, std::greater<>());
    push(reserve_, found.reserve, std::greater<>());
    frame.report.evaluated_count += found.evaluated_count;
    if (found.error_px <= frame.report.error_px) return;
    frame.report.error_px = found.error_px;
    frame.greatest_left = found.greatest;
}

void Refinement::evaluate(Frame& frame, uint32_t split) {
    one_.clear();
    one_.evaluated_count = 1;
    look_at(frame, split, one_);
    take(frame, one_);
}

}  // namespace overlook::caveclod
