// Cameras that refine one mesh at once, in each of the ways that are held beside each other.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/caveclod/paper.h"
#include "runtime/caveclod/refine.h"
#include "tools/measure/paper/caveclod/subject.h"

namespace overlook::measure::paper::cameras {

enum class Way {
    own,        // each camera its own faces, Overlook's form
    printed,    // each camera its own lists, as printed, at the same pixel error
    shared,     // one refinement brought to each camera in turn
    printed_7,  // as printed, at the paper's 7 %
};
constexpr Way kWays[] = {Way::own, Way::printed, Way::shared, Way::printed_7};
// "caveclod", "caveclod:paper", "caveclod:shared", "caveclod:paper at 7 %".
std::string name_of(Way way);

// What one camera keeps.
struct CameraMemory {
    uint64_t fixed_bytes = 0, active_bytes = 0;
    uint64_t glide_bytes = 0;                    // of the active ones: of what is on its way
    uint64_t node_count = 0, polygon_count = 0;  // active ones; nodes of the paper's structures alone
};

// What a camera draws, when it is settled. One of the two.
struct Ready {
    size_t camera = 0;
    caveclod::Refinement* refinement = nullptr;
    const std::vector<std::vector<uint32_t>>* by_surface = nullptr;  // three vertices a face
};
using OnReady = std::function<void(const Ready&)>;

class Team {
  public:
    virtual ~Team() = default;
    // Brings all faces to what the cameras ask for, whatever that takes.
    virtual void settle(std::span<const view::Camera> cameras) = 0;
    // One frame. ready: called of each camera when it can be drawn; may be empty.
    virtual void refine(std::span<const view::Camera> cameras, double dt_s, const OnReady& ready) = 0;
    // Of the frame refined last, a camera each.
    std::span<const caveclod::FrameReport> reports() const { return reports_; }
    // Of cameras that share one refinement, the first keeps it.
    virtual CameraMemory memory_of(size_t camera) const = 0;
    // Whether what a frame costs depends on where the cameras were before it, by more than the last frame.
    virtual bool has_memory() const { return true; }

  protected:
    explicit Team(size_t cameras) : reports_(cameras) {}
    std::vector<caveclod::FrameReport> reports_;
};

// The subject must outlive it.
std::unique_ptr<Team> make_team(const Subject& subject, Way way, const caveclod::Settings& settings, size_t cameras);

}  // namespace overlook::measure::paper::cameras
