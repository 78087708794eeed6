#include "tools/measure/paper/caveclod/fly.h"

#include <algorithm>

namespace overlook::measure::paper::cameras {
namespace {

constexpr uint32_t kShortLead = 2;  // of those that begin anew in every frame

// Which render vertices cameras draw.
class UsedVertices {
  public:
    explicit UsedVertices(const caveclod::Mesh& mesh) : mesh_(mesh), is_used_(mesh.vertex_count(), false) {}

    void add(const Ready& ready) {
        if (ready.refinement != nullptr) add(*ready.refinement);
        if (ready.by_surface == nullptr) return;
        for (const std::vector<uint32_t>& indices : *ready.by_surface)
            for (uint32_t vertex : indices) is_used_[vertex] = true;
    }
    double share() const {
        return double(std::count(is_used_.begin(), is_used_.end(), true)) / double(std::max<size_t>(1, is_used_.size()));
    }

  private:
    // A vertex on its way is made of up to four.
    void add(const caveclod::Refinement& refinement) {
        auto use = [&](uint32_t index) {
            if (index < mesh_.vertex_count()) {
                is_used_[index] = true;
                return;
            }
            const caveclod::GlideVertex& glide = refinement.glide_vertices()[index - mesh_.vertex_count()];
            for (uint32_t from : glide.from) is_used_[from] = true;
            is_used_[glide.to()] = true;
        };
        const caveclod::FaceSlots& faces = refinement.faces();
        for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
            for (uint32_t page = 0; page < faces.pages(surface).size(); ++page) {
                const caveclod::FacePage& one = *faces.pages(surface)[page];
                std::for_each(one.indices.begin(), one.indices.begin() + 3 * faces.page_count(surface, page), use);
            }
    }

    const caveclod::Mesh& mesh_;
    std::vector<bool> is_used_;
};

FlownFrame counted(const Team& team, uint32_t frame) {
    FlownFrame flown{frame, {}, std::nullopt};
    for (size_t i = 0; i < team.reports().size(); ++i) {
        const caveclod::FrameReport& report = team.reports()[i];
        flown.cameras.push_back(
            {report.split_count, report.collapse_count, report.evaluated_count, report.triangle_count, team.memory_of(i)});
    }
    return flown;
}

double per_s(const Flyover& flyover, const std::function<double(const CameraRecord&)>& of) {
    double sum = 0;
    for (const FlownFrame& frame : flyover.frames)
        for (const CameraRecord& camera : frame.cameras) sum += of(camera);
    return sum / (double(flyover.frames.size()) * flyover.step_s * flyover.cameras);
}

}  // namespace

uint32_t frame_count(const Subject& subject, const Flying& flying) {
    return std::max(1u, subject.frame_count() / flying.stride);
}
double step_s(const Subject& subject, const Flying& flying) {
    return subject.step_s() * flying.stride;
}
std::vector<Clip> clips_of(const Subject& subject, const Flying& flying) {
    return clips_of(frame_count(subject, flying), flying.frames);
}
std::vector<view::Camera> cameras_at(const Subject& subject, const Flying& flying, uint32_t count, uint32_t frame) {
    return cameras_at(subject, count, frame * step_s(subject, flying), flying.width_px, flying.height_px);
}

void over_frames(std::span<const Clip> clips, bool has_memory, const std::function<void(uint32_t)>& settle,
                 const std::function<void(uint32_t, bool)>& of) {
    uint32_t lead = has_memory ? kLeadFrames : kShortLead;
    for (size_t i = 0; i < clips.size(); ++i) {
        if (i == 0 || clips[i - 1].end != clips[i].begin) {
            auto before = [&](uint32_t frames) { return clips[i].begin - std::min(clips[i].begin, frames); };
            settle(before(lead));
            for (uint32_t frames = lead; frames > 0; --frames) of(before(frames), false);
        }
        for (uint32_t frame = clips[i].begin; frame < clips[i].end; ++frame) of(frame, true);
    }
}

Flyover fly(const Subject& subject, const Flying& flying, Way way, uint32_t cameras) {
    Flyover flyover{way, cameras, step_s(subject, flying), clips_of(subject, flying), {}};
    std::unique_ptr<Team> team = make_team(subject, way, flying.settings, cameras);
    auto cameras_of = [&](uint32_t frame) { return cameras_at(subject, flying, cameras, frame); };
    OnReady clear = [](const Ready& ready) {
        if (ready.refinement != nullptr) ready.refinement->clear_dirty();
    };
    over_frames(
        flyover.clips, team->has_memory(), [&](uint32_t frame) { team->settle(cameras_of(frame)); },
        [&](uint32_t frame, bool is_counted) {
            bool is_covered = is_counted && flyover.frames.size() % kCoverageStep == 0;
            UsedVertices used(subject.mesh());
            OnReady use = [&](const Ready& ready) {
                clear(ready);
                used.add(ready);
            };
            team->refine(cameras_of(frame), flyover.step_s, is_covered ? use : OnReady());
            if (!is_counted) return;
            flyover.frames.push_back(counted(*team, frame));
            if (is_covered) flyover.frames.back().used_share = used.share();
        });
    return flyover;
}

double operations_per_s(const Flyover& flyover) {
    return per_s(flyover, [](const CameraRecord& camera) { return double(camera.split_count) + camera.collapse_count; });
}
double splits_per_s(const Flyover& flyover) {
    return per_s(flyover, [](const CameraRecord& camera) { return double(camera.split_count); });
}

std::vector<Window> windows_of(const Flyover& flyover) {
    std::vector<Window> windows;
    for (size_t begin = 0; begin < flyover.frames.size(); begin += kClipFrames) {
        size_t end = std::min(flyover.frames.size(), begin + kClipFrames);
        Window window;
        window.frames.assign(flyover.frames.begin() + ptrdiff_t(begin), flyover.frames.begin() + ptrdiff_t(end));
        window.time_s = 0.5 * (window.frames.front().frame + window.frames.back().frame) * flyover.step_s;
        windows.push_back(std::move(window));
    }
    return windows;
}

}  // namespace overlook::measure::paper::cameras
