// LOD-sprite as its paper has it, frame by frame: what decides (paper_sprite.h) and what draws (draw_paper.h) put together.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/setting.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/lod_sprite/draw_paper.h"
#include "runtime/lod_sprite/paper_sprite.h"
#include "runtime/view/error_budget.h"

namespace overlook::lod_sprite::paper {

struct FrameOptions {
    double error_px = 1;       // of the high cut, > 0
    double low_error_px = 16;  // of the low cut, > 0
    // That a frame may have: the low cut's errors become larger until it fits (view::ErrorController). The paper has no budgets:
    // keyframes are drawn whole, whatever it is. 0 = none.
    double triangles = 0;
    Options decide;
    terrain::DrawOptions look;
};

// All that people may set of it, with the defaults of the structs above.
std::span<const SettingKind> setting_kinds();
// name: of one of them; value: within its range.
void set(FrameOptions& options, std::string_view name, double value);

// As lod_sprite::FrameDrawer. Of its counts, error_p99_px is the root mean square of equation 2, and the share lost is not known:
// the paper predicts none.
class FrameDrawer {
  public:
    // All must outlive it.
    FrameDrawer(const terrain::Terrain& terrain, const terrain::Refiner& refiner, terrain::Drawing& ground,
                const FrameOptions& options);
    FrameDrawer(const FrameDrawer&) = delete;
    FrameDrawer& operator=(const FrameDrawer&) = delete;

    void decide(const view::Camera& camera);
    // Fails as Drawing::make.
    Result<FrameCounts> draw(const gl::Target& target);
    // From the next frame on.
    void set_triangles(double triangles) { controller_.set_budget({triangles, 1, false}); }

    // Of the key that the novel frame drawn last is made from; none of a keyframe. And which of the novel frame's pixels are from
    // it (Drawing::draw_mask).
    std::optional<view::Camera> key_camera() const;
    void draw_mask(const gl::Target& target);

  private:
    void decide_key();
    void decide_novel();
    Result<void> take_key(const gl::Target& target);
    void count(const terrain::Cut& cut);

    const terrain::Refiner& refiner_;
    terrain::Drawing& ground_;
    FrameOptions options_;
    view::ErrorController controller_;  // of how many times as large the low cut's errors are
    Sprite sprite_;
    std::optional<Drawing> drawing_;
    view::Camera camera_;
    terrain::Cut high_, low_;
    Decision decision_;
    std::span<const uint8_t> flags_;
    std::vector<float> depth_;
    FrameCounts counts_;
    bool is_kept_ = false;
};

}  // namespace overlook::lod_sprite::paper
