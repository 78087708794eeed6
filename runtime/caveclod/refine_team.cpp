// Several cameras refined at once: whoever has none of its own left helps with the parts of another's.
#include <algorithm>
#include <atomic>
#include <deque>
#include <thread>

#include "formats/crew.h"
#include "formats/parallel.h"
#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {

// One frame of all cameras.
class TeamFrame {
  public:
    TeamFrame(std::span<Refinement* const> refinements, std::span<const view::Camera> cameras, const Settings& settings,
              double dt_s, std::span<FrameReport> reports)
        : dt_s_(dt_s), reports_(reports), unshared_(refinements.size()) {
        for (size_t i = 0; i < refinements.size(); ++i) ones_.emplace_back(*refinements[i], cameras[i], settings);
    }

    // What one thread does. Cameras are taken from both ends, so that a thread mostly has those that it had in the last frame.
    void work(unsigned worker) {
        for (size_t k = 0; k < ones_.size(); ++k) {
            size_t i = worker % 2 == 0 ? k : ones_.size() - 1 - k;
            if (!ones_[i].is_taken.exchange(true)) refine(ones_[i], reports_[i]);
        }
        while (unshared_.load() > 0) {
            for (One& one : ones_) help(one);
            std::this_thread::yield();
        }
    }

  private:
    static constexpr size_t kNotBegun = ~size_t(0);
    struct One {
        One(Refinement& camera_refinement, const view::Camera& camera, const Settings& settings)
            : refinement(camera_refinement), frame(refinement.mesh_, camera, settings, nullptr) {}
        Refinement& refinement;
        Refinement::Frame frame;
        size_t part_count = 0;
        std::atomic<bool> is_taken{false};
        std::atomic<size_t> next_part{kNotBegun}, done_count{0};
    };

    void refine(One& one, FrameReport& report) {
        one.refinement.begin(one.frame, dt_s_);
        one.part_count = one.refinement.parts_.size();
        if (one.part_count == 0) --unshared_;
        one.next_part.store(0);
        help(one);
        while (one.done_count.load() < one.part_count) std::this_thread::yield();
        one.refinement.finish(one.frame);
        report = one.frame.report;
    }

    // Looks at parts as long as there are any that nobody has.
    void help(One& one) {
        size_t part = one.next_part.load();
        while (part != kNotBegun && part < one.part_count) {
            if (!one.next_part.compare_exchange_weak(part, part + 1)) continue;
            if (part + 1 == one.part_count) --unshared_;
            one.refinement.look(one.frame, part);
            ++one.done_count;
            part = one.next_part.load();
        }
    }

    double dt_s_;
    std::span<FrameReport> reports_;
    std::deque<One> ones_;
    std::atomic<size_t> unshared_;  // cameras of which parts are left that nobody has
};

void refine_all(std::span<Refinement* const> refinements, std::span<const view::Camera> cameras, const Settings& settings,
                double dt_s, std::span<FrameReport> reports) {
    if (refinements.size() < 2 || thread_count() == 1) {
        for (size_t i = 0; i < refinements.size(); ++i) reports[i] = refinements[i]->refine(cameras[i], settings, dt_s);
        return;
    }
    TeamFrame frame(refinements, cameras, settings, dt_s, reports);
    size_t most = 0;
    for (const Refinement* refinement : refinements) most += std::max<size_t>(refinement->part_count(), 1);
    work_together(unsigned(std::min<size_t>(most, thread_count())), [&](unsigned worker) { frame.work(worker); });
}

void refine_in_turn(Refinement& shared, std::span<const view::Camera> cameras, const Settings& settings,
                    const std::function<void(size_t camera)>& draw, std::span<FrameReport> reports) {
    Settings at_once = settings;
    at_once.most_operations = 0, at_once.glide_s = 0;
    for (size_t i = 0; i < cameras.size(); ++i) {
        reports[i] = shared.refine(cameras[i], at_once, 0);
        draw(i);
    }
}

}  // namespace overlook::caveclod
