// Instances of a chain of levels, drawn from frame to frame by one of the variants.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/discrete/budget.h"
#include "runtime/discrete/director.h"
#include "runtime/discrete/draw.h"
#include "runtime/discrete/draw_turns.h"
#include "runtime/discrete/settings.h"

namespace overlook::discrete {

// What one frame took: exact, and the same on every run.
struct FrameCounts {
    uint64_t triangle_count = 0;          // submitted for this frame
    uint64_t settled_triangle_count = 0;  // that a frame will take when the changes under way are over
    uint64_t draw_call_count = 0;
    uint64_t uploaded_bytes = 0;
    uint64_t tested_count = 0;    // instances looked at
    uint64_t in_view_count = 0;   // of them
    uint64_t begun_count = 0;     // changes of level begun, turned or done at once
    uint64_t fading_count = 0;    // under way
    uint64_t combined_px = 0;     // pixels of squares in which two frames may differ; of variants that draw by turns
    uint64_t resident_bytes = 0;  // of buffers that this variant has beside the chain
    uint64_t state_bytes = 0;     // what instances keep in main memory
    double error_px = 0;          // the greatest bound of what is drawn, against the finest level
    double coarser_times = 1;     // as levels are than is asked, so that a budget is kept
};

// A chain, and where it stands.
struct Stand {
    const Drawing* drawing = nullptr;  // must outlive what draws it
    std::span<const Placement> placements;
};

// Chains that stand in one picture. Frames come in their order: each decide(), then draw(), then perhaps draw() again into other
// targets, which gives the same picture. A context must be current.
class FrameDrawer {
  public:
    // stands: one at least, 2^32 - 2 placements in all at most. Fails with Exit::our_bug if a shader of ours does not compile.
    static Result<std::unique_ptr<FrameDrawer>> make(std::span<const Stand> stands, const FrameOptions& options);
    // Of one chain.
    static Result<std::unique_ptr<FrameDrawer>> make(const Drawing& drawing, std::span<const Placement> placements,
                                                     const FrameOptions& options);
    FrameDrawer(const FrameDrawer&) = delete;
    FrameDrawer& operator=(const FrameDrawer&) = delete;

    // From the next frame on those of a chain, by its place among the stands, stand there; as many as before.
    void place(std::span<const Placement> placements, size_t chain = 0);
    // dt_s: since the last frame; clip_s: where the parts' clip is, any time. Another size than the frame's before forgets that
    // one's picture.
    void decide(const view::Camera& camera, double dt_s, double clip_s);
    // Draws and resolves; need not wait until it is drawn. Fails as Turns::draw.
    Result<FrameCounts> draw(const gl::Target& target, const DrawOptions& look);
    // Pixels for which the last draw() into a target of so many samples a pixel put two frames together: combined_px or fewer, as
    // whole blocks of 8 x 8 are counted, also at the picture's sides. Waits until it has.
    uint64_t searched_px(uint32_t samples) const { return turns_ ? turns_->searched_px(samples) : 0; }
    // Draws into the target, whose picture is lost, what changes of level are drawn by, so that no frame waits for shaders when
    // the first one begins. Fails as Turns::draw.
    Result<void> prepare(const view::Camera& camera, const gl::Target& target);
    // From the next frame on; levels and changes under way stay as they are. Fails as make().
    Result<void> change(const FrameOptions& options);
    // Triangles of a frame from the next one on, when changes under way are over (BudgetKeeper); 0: as many as what is asked
    // takes.
    void set_budget(double triangles) { budget_.set_triangles(triangles); }

    const Director& director(size_t chain = 0) const { return groups_[chain].director; }
    const FrameCounts& counts() const { return counts_; }  // of the frame decided last, before it is drawn

  private:
    // The instances of one chain.
    struct Group {
        const Drawing* drawing = nullptr;
        Director director;
        uint32_t first_instance = 0;  // instances of the groups before
        ListBuffers buffers;
        DrawList now, before;
        std::vector<Placement> placed_before;
    };
    FrameDrawer(std::span<const Stand> stands, const FrameOptions& options);
    Result<void> make_turns();
    void keep_budget(const view::Camera& camera, double dt_s);
    // balance: of all groups (Director::decide).
    void decide_group(Group& group, const view::Camera& camera, double dt_s, double clip_s, int64_t& balance);
    Combination combination_for(const view::Camera& camera) const;

    FrameOptions options_;
    BudgetKeeper budget_;
    std::vector<Group> groups_;
    std::optional<Turns> turns_;
    Combination combination_;
    uint64_t frame_ = 0;
    bool has_before_ = false;
    FrameCounts counts_;
};

}  // namespace overlook::discrete
