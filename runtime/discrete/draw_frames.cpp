#include "runtime/discrete/draw_frames.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "runtime/discrete/select.h"

namespace overlook::discrete {

FrameDrawer::FrameDrawer(std::span<const Stand> stands, const FrameOptions& options) : options_(options) {
    uint32_t instance_count = 0;
    for (const Stand& stand : stands) {
        Director director(facts_of(stand.drawing->chain()), stand.placements, options);
        director.set_grain_m(stand.drawing->grain_m());
        std::vector<Placement> placed(stand.placements.begin(), stand.placements.end());
        groups_.push_back({stand.drawing, std::move(director), instance_count, {}, {}, {}, std::move(placed)});
        instance_count += uint32_t(stand.placements.size());
    }
}

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::make(std::span<const Stand> stands, const FrameOptions& options) {
    assert(!stands.empty());
    std::unique_ptr<FrameDrawer> made(new FrameDrawer(stands, options));
    if (Result<void> turns = made->make_turns(); !turns) return tl::unexpected(turns.error());
    return made;
}

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::make(const Drawing& drawing, std::span<const Placement> placements,
                                                       const FrameOptions& options) {
    Stand one{&drawing, placements};
    return make(std::span(&one, 1), options);
}

Result<void> FrameDrawer::make_turns() {
    turns_.reset();
    if (!draws_by_turns(options_.variant)) return {};
    Result<Turns> turns = Turns::make(*groups_.front().drawing, options_);
    if (!turns) return tl::unexpected(turns.error());
    turns_.emplace(std::move(*turns));
    return {};
}

void FrameDrawer::place(std::span<const Placement> placements, size_t chain) {
    groups_[chain].director.place(placements);
}

Result<void> FrameDrawer::change(const FrameOptions& options) {
    FrameOptions before = std::exchange(options_, options);
    for (Group& group : groups_) group.director.change(options);
    bool draws_alike = before.variant == options.variant && before.remedies == options.remedies &&
                       before.is_half_precise == options.is_half_precise;
    return draws_alike ? Result<void>() : make_turns();
}

void FrameDrawer::keep_budget(const view::Camera& camera, double dt_s) {
    std::vector<Demand> demands;
    if (budget_.triangles() > 0)
        for (const Group& group : groups_) demands.push_back(group.director.demand(camera, dt_s));
    counts_.coarser_times = budget_.times(demands);
    for (Group& group : groups_) group.director.coarsen(counts_.coarser_times);
}

void FrameDrawer::decide_group(Group& group, const view::Camera& camera, double dt_s, double clip_s, int64_t& balance) {
    Director& director = group.director;
    director.decide(camera, dt_s, balance);
    const FrameList& frame = director.frame();
    std::swap(group.before, group.now);
    group.now = draw_list(group.drawing->layout(), group.drawing->chain(), frame, director.placements(), camera, clip_s,
                          group.first_instance);
    counts_.triangle_count += frame.triangle_count;
    counts_.settled_triangle_count += frame.settled_triangle_count;
    counts_.tested_count += frame.tested_count;
    counts_.in_view_count += frame.in_view_count;
    counts_.begun_count += frame.begun_count;
    counts_.fading_count += frame.fading.size();
    counts_.state_bytes += director.bytes();
    counts_.error_px = std::max(counts_.error_px, frame.error_px);
}

Combination FrameDrawer::combination_for(const view::Camera& camera) const {
    std::vector<UnderWay> all;
    for (const Group& group : groups_) {
        const Director& director = group.director;
        all.push_back({&director.frame(), &director.facts(), group.placed_before, director.placements(), group.first_instance});
    }
    return combination_of(options_, all, has_before_ ? groups_.front().before.camera : camera, camera);
}

void FrameDrawer::decide(const view::Camera& camera, double dt_s, double clip_s) {
    counts_ = {};
    keep_budget(camera, dt_s);
    int64_t balance = 0;
    for (const Group& group : groups_) balance += group.director.balance();
    for (Group& group : groups_) decide_group(group, camera, dt_s, clip_s, balance);
    ++frame_;
    const view::Camera& old_camera = groups_.front().before.camera;
    has_before_ = frame_ > 1 && old_camera.width_px == camera.width_px && old_camera.height_px == camera.height_px;
    if (turns_) combination_ = combination_for(camera);
    for (Group& group : groups_) group.placed_before = group.director.placements();
}

Result<FrameCounts> FrameDrawer::draw(const gl::Target& target, const DrawOptions& look) {
    FrameCounts counts = counts_;
    if (turns_) {
        std::vector<TurnPart> parts;
        for (const Group& group : groups_) parts.push_back({group.drawing, &group.now, &group.before});
        Result<uint64_t> calls = turns_->draw(target, look, frame_, parts, has_before_, combination_, counts.uploaded_bytes);
        if (!calls) return tl::unexpected(calls.error());
        counts.draw_call_count = *calls;
        counts.resident_bytes = turns_->bytes(target.samples());
        counts.combined_px = turns_->combined_px();
        return counts;
    }
    std::vector<Drawn> parts;
    for (Group& group : groups_) {
        counts.uploaded_bytes += group.buffers.fill(group.now);
        parts.push_back({group.drawing, &group.buffers, &group.now});
    }
    counts.draw_call_count = discrete::draw(target, parts, look);
    return counts;
}

Result<void> FrameDrawer::prepare(const view::Camera& camera, const gl::Target& target) {
    if (turns_) return turns_->prepare(target);
    if (options_.variant != Variant::blend) return {};
    Group& group = groups_.front();
    FrameList frame;
    frame.translucent = {{0, uint32_t(group.director.facts().levels.size()) - 1, Show::translucent, 0.5, 0, 1}};
    DrawList list = draw_list(group.drawing->layout(), group.drawing->chain(), frame, group.director.placements(), camera, 0);
    group.buffers.fill(list);
    Drawn part{group.drawing, &group.buffers, &list};
    discrete::draw(target, {&part, 1}, {});
    return {};
}

}  // namespace overlook::discrete
