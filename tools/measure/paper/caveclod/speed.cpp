#include "tools/measure/paper/caveclod/speed.h"

#include <algorithm>
#include <numeric>

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

// The least that each frame took, over all runs.
class LeastTimes {
  public:
    void begin_run() { next_ = 0; }
    void take(double ms) {
        if (next_ == least_ms_.size()) least_ms_.push_back(ms);
        least_ms_[next_] = std::min(least_ms_[next_], ms);
        ++next_;
    }
    double sum_ms() const { return std::accumulate(least_ms_.begin(), least_ms_.end(), 0.0); }

  private:
    std::vector<double> least_ms_;
    size_t next_ = 0;
};

// One run of four cameras on one thread and on all.
void run_four(const Subject& subject, const Flying& flying, const Threads& threads, LeastTimes& single_ms,
              LeastTimes& parallel_ms, bool& is_same) {
    Crew single(subject, flying, Way::own, kMostCameras), parallel(subject, flying, Way::own, kMostCameras);
    uint32_t turn = 0;
    single_ms.begin_run(), parallel_ms.begin_run();
    over_frames(
        clips_of(subject, flying), true, [&](uint32_t frame) { single.settle(frame), parallel.settle(frame); },
        [&](uint32_t frame, bool is_counted) {
            bool is_parallel_first = turn++ % 2 == 1;
            for (bool is_parallel : {is_parallel_first, !is_parallel_first}) {
                is_parallel ? threads.many() : threads.one();
                double ms = (is_parallel ? parallel : single).refine(frame);
                if (is_counted) (is_parallel ? parallel_ms : single_ms).take(ms);
            }
            if (turn % kClipFrames == 0) is_same = is_same && single.hash(frame) == parallel.hash(frame);
        });
}

// One run of camera A alone. Writes what is counted, the same in every run, into `speed`.
void run_one(const Subject& subject, const Flying& flying, LeastTimes& own_ms, LeastTimes& printed_ms, Speed& speed) {
    Crew own(subject, flying, Way::own, 1), printed(subject, flying, Way::printed, 1);
    speed.own_faces = speed.printed_faces = speed.own_bytes = 0;
    own_ms.begin_run(), printed_ms.begin_run();
    over_frames(
        clips_of(subject, flying), true, [&](uint32_t frame) { own.settle(frame), printed.settle(frame); },
        [&](uint32_t frame, bool is_counted) {
            double one_ms = own.refine(frame), other_ms = printed.refine(frame);
            if (!is_counted) return;
            own_ms.take(one_ms), printed_ms.take(other_ms);
            const caveclod::FrameReport& report = own.team().reports()[0];
            speed.own_faces += double(report.triangle_count);
            speed.printed_faces += double(printed.team().reports()[0].triangle_count);
            speed.own_bytes += least_bytes({report.split_count, report.collapse_count, report.evaluated_count, 0, {}},
                                           subject.mesh().split_count());
        });
}

}  // namespace

double least_bytes(const CameraRecord& camera, uint64_t split_count) {
    constexpr double kOperationBytes = 6 * 3 * sizeof(uint32_t);
    return double(split_count) / 8 + double(sizeof(caveclod::Bounds)) * camera.evaluated_count +
           kOperationBytes * (double(camera.split_count) + camera.collapse_count);
}

Speed measure_speed(const Subject& subject, const Flying& flying, const std::function<void(double)>& done) {
    Threads threads;
    Speed speed;
    speed.threads = threads.all();
    LeastTimes single_ms, parallel_ms, own_ms, printed_ms;
    for (int repeat = 0; repeat < kSpeedRepeats; ++repeat) {
        run_four(subject, flying, threads, single_ms, parallel_ms, speed.is_same);
        threads.one();
        run_one(subject, flying, own_ms, printed_ms, speed);
        done(double(repeat + 1) / kSpeedRepeats);
    }
    speed.single_ms = single_ms.sum_ms(), speed.parallel_ms = parallel_ms.sum_ms();
    speed.own_ms = own_ms.sum_ms(), speed.printed_ms = printed_ms.sum_ms();
    threads.many();
    speed.bandwidth_gb_s = memory_bandwidth_gb_s();
    return speed;
}

}  // namespace overlook::measure::paper::cameras
