#include "tools/measure/paper/caveclod/draw.h"

#include <algorithm>

#include "runtime/caveclod/draw.h"
#include "runtime/gl/timer.h"
#include "tools/measure/full_geometry.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::cameras {
namespace {

Result<std::vector<gl::Target>> targets_of(const std::vector<view::Part>& places, uint32_t samples) {
    std::vector<gl::Target> targets;
    for (const view::Part& place : places) {
        Result<gl::Target> target = gl::Target::make(place.width_px, place.height_px, samples);
        if (!target) return tl::unexpected(target.error());
        targets.push_back(std::move(*target));
    }
    return targets;
}

// Cameras that are refined and drawn.
class Screen {
  public:
    Screen(const Subject& subject, const Flying& flying, Way way, std::vector<gl::Target>& targets)
        : subject_(subject), flying_(flying), targets_(targets), team_(make_team(subject, way, flying.settings, targets.size())) {
        for (size_t i = 0; i < (way == Way::shared ? 1 : targets.size()); ++i)
            buffers_.push_back(std::make_unique<caveclod::CameraBuffers>(subject.mesh()));
    }

    void settle(double time_s) { team_->settle(cameras_of(time_s)); }
    void refine(double time_s) { team_->refine(cameras_of(time_s), subject_.step_s(), {}); }
    // Milliseconds until everything is drawn.
    double draw(double time_s) {
        std::vector<view::Camera> cameras = cameras_of(time_s);
        glFinish();
        gl::Timer timer;
        team_->refine(cameras, subject_.step_s(), [&](const Ready& ready) {
            caveclod::CameraBuffers& buffers = *buffers_[buffers_.size() == 1 ? 0 : ready.camera];
            buffers.take(*ready.refinement);
            const MeshWorld& mesh = *subject_.world.mesh;
            mesh.drawing->draw(targets_[ready.camera], buffers, cameras[ready.camera], mesh.look);
        });
        return timer.finished_ms();
    }
    const Team& team() const { return *team_; }

  private:
    std::vector<view::Camera> cameras_of(double time_s) const {
        return cameras_at(subject_, uint32_t(targets_.size()), time_s, flying_.width_px, flying_.height_px);
    }

    const Subject& subject_;
    const Flying& flying_;
    std::vector<gl::Target>& targets_;
    std::unique_ptr<Team> team_;
    std::vector<std::unique_ptr<caveclod::CameraBuffers>> buffers_;  // one of each camera; one in all where they share
};

struct Times {
    std::vector<double> frame_s, with_ms, without_ms;  // of counted frames
};

std::vector<Rate> rates_of(const Times& times) {
    std::vector<Rate> rates;
    for (size_t begin = 0; begin < times.frame_s.size(); begin += kClipFrames) {
        size_t end = std::min(times.frame_s.size(), begin + kClipFrames);
        auto fps = [&](const std::vector<double>& ms) {
            double sum_ms = 0;
            for (size_t i = begin; i < end; ++i) sum_ms += ms[i];
            return 1000 * double(end - begin) / sum_ms;
        };
        rates.push_back({0.5 * (times.frame_s[begin] + times.frame_s[end - 1]), fps(times.with_ms), fps(times.without_ms)});
    }
    return rates;
}

}  // namespace

Result<std::vector<Rate>> frame_rates(const Subject& subject, const Flying& flying, const std::function<void(double)>& done) {
    std::vector<view::Part> places = places_of(kMostCameras, flying.width_px, flying.height_px);
    Result<std::vector<gl::Target>> targets = targets_of(places, 1);
    if (!targets) return tl::unexpected(targets.error());
    Screen own(subject, flying, Way::own, *targets), shared(subject, flying, Way::shared, *targets);
    Times times;
    uint32_t turn = 0;
    std::vector<Clip> clips = clips_of(subject, flying);
    over_frames(
        clips, true,
        [&](uint32_t frame) {
            own.settle(frame * subject.step_s());
            shared.settle(frame * subject.step_s());
        },
        [&](uint32_t frame, bool is_counted) {
            double time_s = frame * subject.step_s(), with_ms = 0, without_ms = 0;
            if (!is_counted) return own.refine(time_s);  // what is shared begins anew in every frame
            bool is_own_first = turn++ % 2 == 0;
            for (bool is_own : {is_own_first, !is_own_first})
                (is_own ? with_ms : without_ms) = (is_own ? own : shared).draw(time_s);
            times.frame_s.push_back(time_s);
            times.with_ms.push_back(with_ms);
            times.without_ms.push_back(without_ms);
            done(double(times.frame_s.size()) / flying.frames);
        });
    return rates_of(times);
}

double mean_fps(const std::vector<Rate>& rates, double Rate::*which) {
    double seconds = 0;
    for (const Rate& rate : rates) seconds += 1 / (rate.*which);
    return double(rates.size()) / seconds;
}

Result<Picture> flyover_picture(const Subject& subject, const Flying& flying, int figure, uint32_t cameras, double time_s) {
    std::vector<view::Part> places = places_of(cameras, flying.width_px, flying.height_px);
    Result<std::vector<gl::Target>> targets = targets_of(places, kPictureSamples);
    if (!targets) return tl::unexpected(targets.error());
    Screen screen(subject, flying, Way::own, *targets);
    screen.settle(time_s);
    screen.draw(time_s);
    Picture picture{figure, fmt::format("figure-{}", figure), "", {}};
    std::vector<ImageRgb8> images;
    for (uint32_t i = 0; i < cameras; ++i) {
        images.push_back((*targets)[i].read());
        picture.caption += fmt::format("{}{}: {}", i == 0 ? "" : ", ", char('A' + i),
                                       short_count(double(screen.team().reports()[i].triangle_count)));
    }
    picture.caption = fmt::format("{:.0f} s into the flights; triangles of camera {}.", time_s, picture.caption);
    picture.image = composed(images, places, flying.width_px, flying.height_px);
    return picture;
}

Result<Picture> coloured_picture(World& coloured, int figure, const view::Camera& camera, const std::string& caption) {
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, kPictureSamples);
    if (!target) return tl::unexpected(target.error());
    FullGeometry geometry(coloured);
    Counters counters = geometry.draw(*target, camera);
    return Picture{figure, fmt::format("figure-{}", figure),
                   fmt::format("{} {} triangles.", caption, short_count(double(counters.triangle_count))), target->read()};
}

}  // namespace overlook::measure::paper::cameras
