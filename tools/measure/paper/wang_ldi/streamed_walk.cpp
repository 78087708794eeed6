// A walk through a quarter of the memory that all images take.
#include <algorithm>

#include "runtime/terrain/refine.h"
#include "tools/measure/paper/wang_ldi/flown_fields.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr uint64_t kTimesTheBudget = 4, kUploads = 8;  // uploads: budgets of a frame that make up the whole
constexpr uint32_t kLatency_frames = 2;

uint64_t bytes_of_all(const wang_ldi::ImageReader& images, uint64_t& largest) {
    uint64_t all = 0;
    for (uint64_t i = 0; i < images.set().ldi_count(); ++i) {
        uint64_t bytes = wang_ldi::bytes_of(images.set(), wang_ldi::which_of(images.set(), i).level, images.entries()[size_t(i)]);
        all += bytes, largest = std::max(largest, bytes);
    }
    return all;
}

void add_frame(const wang_ldi::FrameCounts& counts, StreamedWalk& walk) {
    ++walk.frames;
    walk.most_resident_bytes = std::max(walk.most_resident_bytes, counts.stream.resident_bytes + counts.stream.on_the_way_bytes);
    walk.most_uploaded_bytes = std::max(walk.most_uploaded_bytes, counts.stream.uploaded_bytes);
    walk.uploaded_bytes += counts.stream.uploaded_bytes, walk.dropped = counts.stream.dropped_count;
    walk.late_frames += counts.images.stand_ins + counts.images.missing > 0;
    walk.shown += counts.images.images, walk.late += counts.images.stand_ins, walk.missing += counts.images.missing;
}

}  // namespace

Result<StreamedWalk> walk_streamed(Land& land, const std::vector<view::Camera>& cameras, double step_s) {
    StreamedWalk walk;
    uint64_t largest = 0;
    walk.all_bytes = bytes_of_all(land.planted().images(), largest);
    walk.budget_bytes = walk.all_bytes / kTimesTheBudget;
    walk.upload_budget_bytes = std::max(walk.budget_bytes / kUploads, largest);
    wang_ldi::ImageStreaming streaming;
    streaming.settings.residency_budget_bytes = walk.budget_bytes;
    streaming.settings.upload_budget_bytes = walk.upload_budget_bytes;
    streaming.settings.latency_frames = kLatency_frames;
    auto frames = wang_ldi::FrameDrawer::make(land.planted(), land.world.planted->land(),
                                              wang_ldi::defaults_of(wang_ldi::Variant::own), streaming);
    if (!frames) {
        walk.refused = frames.error().message;
        return walk;
    }
    auto target = gl::Target::make(cameras.front().width_px, cameras.front().height_px, 1);
    if (!target) return tl::unexpected(target.error());
    for (const view::Camera& camera : cameras) {
        if (auto decided = (*frames)->decide(camera, step_s, terrain::kDefaultMorph); !decided)
            return tl::unexpected(decided.error());
        (*frames)->draw(*target, land.world.look);
        add_frame((*frames)->counts(), walk);
    }
    return walk;
}

}  // namespace overlook::measure::paper::wang
