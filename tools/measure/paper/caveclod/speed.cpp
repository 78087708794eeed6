#include "tools/measure/paper/caveclod/speed.h"

#include <algorithm>
#include <limits>

#include "formats/parallel.h"
#include "runtime/gl/timer.h"
#include "tools/measure/numbers/memory_bandwidth.h"

namespace overlook::measure::paper::cameras {
namespace {

// Of all faces of all cameras in their places; FNV-1a over the indices.
uint64_t hash_of(uint64_t hash, const caveclod::FaceSlots& faces) {
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
        for (uint32_t page = 0; page < faces.pages(surface).size(); ++page)
            for (uint32_t i = 0; i < 3 * faces.page_count(surface, page); ++i)
                hash = (hash ^ faces.pages(surface)[page]->indices[i]) * 0x100000001b3ull;
    return hash;
}

class Crew {
  public:
    Crew(const Subject& subject, const Flying& flying, Way way, uint32_t cameras)
        : subject_(subject), flying_(flying), team_(make_team(subject, way, flying.settings, cameras)), count_(cameras) {}

    void settle(uint32_t frame) { team_->settle(cameras_of(frame)); }
    // Milliseconds that refining took.
    double refine(uint32_t frame) {
        std::vector<view::Camera> cameras = cameras_of(frame);
        gl::Timer timer;
        team_->refine(cameras, step_s(subject_, flying_), {});
        return timer.elapsed_ms();
    }
    uint64_t hash(uint32_t frame) {
        uint64_t hash = 0xcbf29ce484222325ull;
        team_->refine(cameras_of(frame), 0, [&](const Ready& ready) {
            hash = hash_of(hash, ready.refinement->faces());
            ready.refinement->clear_dirty();
        });
        return hash;
    }
    const Team& team() const { return *team_; }

  private:
    std::vector<view::Camera> cameras_of(uint32_t frame) const { return cameras_at(subject_, flying_, count_, frame); }

    const Subject& subject_;
    const Flying& flying_;
    std::unique_ptr<Team> team_;
    uint32_t count_;
};

class Threads {
  public:
    Threads() : all_(thread_count()) {}
    ~Threads() { set_thread_count(all_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
    unsigned all() const { return all_; }
    void one() const { set_thread_count(1); }
    void many() const { set_thread_count(all_); }

  private:
    unsigned all_;
};

// One run of four cameras on one thread and on all.
void run_four(const Subject& subject, const Flying& flying, const Threads& threads, Speed& least) {
    Crew single(subject, flying, Way::own, kMostCameras), parallel(subject, flying, Way::own, kMostCameras);
    double single_ms = 0, parallel_ms = 0;
    uint32_t turn = 0;
    over_frames(
        clips_of(subject, flying), true,
        [&](uint32_t frame) { single.settle(frame), parallel.settle(frame); },
        [&](uint32_t frame, bool is_counted) {
            bool is_parallel_first = turn++ % 2 == 1;
            for (bool is_parallel : {is_parallel_first, !is_parallel_first}) {
                is_parallel ? threads.many() : threads.one();
                double ms = (is_parallel ? parallel : single).refine(frame);
                if (is_counted) (is_parallel ? parallel_ms : single_ms) += ms;
            }
            if (turn % kClipFrames == 0) least.is_same = least.is_same && single.hash(frame) == parallel.hash(frame);
        });
    least.single_ms = std::min(least.single_ms, single_ms);
    least.parallel_ms = std::min(least.parallel_ms, parallel_ms);
}

// One run of camera A alone.
void run_one(const Subject& subject, const Flying& flying, Speed& least) {
    Crew own(subject, flying, Way::own, 1), printed(subject, flying, Way::printed, 1);
    Speed run;
    over_frames(
        clips_of(subject, flying), true,
        [&](uint32_t frame) { own.settle(frame), printed.settle(frame); },
        [&](uint32_t frame, bool is_counted) {
            double own_ms = own.refine(frame), printed_ms = printed.refine(frame);
            if (!is_counted) return;
            run.own_ms += own_ms, run.printed_ms += printed_ms;
            const caveclod::FrameReport& report = own.team().reports()[0];
            run.own_faces += double(report.triangle_count);
            run.printed_faces += double(printed.team().reports()[0].triangle_count);
            run.own_bytes += least_bytes({report.split_count, report.collapse_count, report.evaluated_count, 0, {}},
                                         subject.mesh().split_count());
        });
    least.own_ms = std::min(least.own_ms, run.own_ms);
    least.printed_ms = std::min(least.printed_ms, run.printed_ms);
    least.own_faces = run.own_faces, least.printed_faces = run.printed_faces, least.own_bytes = run.own_bytes;
}

}  // namespace

double least_bytes(const CameraRecord& camera, uint64_t split_count) {
    constexpr double kOperationBytes = 6 * 3 * sizeof(uint32_t);
    return double(split_count) / 8 + double(sizeof(caveclod::Bounds)) * camera.evaluated_count +
           kOperationBytes * (double(camera.split_count) + camera.collapse_count);
}

Speed measure_speed(const Subject& subject, const Flying& flying, const std::function<void(double)>& done) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Threads threads;
    Speed least;
    least.threads = threads.all();
    least.single_ms = least.parallel_ms = least.own_ms = least.printed_ms = kNone;
    for (int repeat = 0; repeat < kSpeedRepeats; ++repeat) {
        run_four(subject, flying, threads, least);
        run_one(subject, flying, least);
        done(double(repeat + 1) / kSpeedRepeats);
    }
    threads.many();
    least.bandwidth_gb_s = memory_bandwidth_gb_s();
    return least;
}

}  // namespace overlook::measure::paper::cameras
