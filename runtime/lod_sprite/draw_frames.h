// LOD-sprite frame by frame: what decides (director.h), what draws (draw.h) and the thing that is drawn (draw_geometry.h), put
// together in the one way in which everybody uses them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "formats/setting.h"
#include "runtime/lod_sprite/director.h"
#include "runtime/lod_sprite/draw.h"
#include "runtime/lod_sprite/draw_geometry.h"
#include "runtime/lod_sprite/draw_key_thread.h"

namespace overlook::lod_sprite {

struct FrameOptions {
    Settings decide;
    NovelOptions draw;  // low and near error, near depth and slack are settled by the frames
};

// All that people may set of it, with the defaults of the structs above.
std::span<const SettingKind> setting_kinds();
// name: of one of them; value: within its range.
void set(FrameOptions& options, std::string_view name, double value);

// What one frame was: exact, and the same on every run, for the same frames before it.
struct FrameCounts {
    uint64_t triangle_count = 0;      // of the frame's cut, and those drawn into keys; a frame draws its cut several times over
    uint64_t key_triangle_count = 0;  // of keys drawn by a thread, in the frame that gets them back
    uint64_t key_pixel_count = 0;     // of the keys begun
    uint64_t near_triangle_count = 0;
    uint64_t vertex_reference_count = 0;  // submitted, by all passes
    uint64_t draw_call_count = 0;
    uint64_t tested_count = 0;
    uint64_t uploaded_bytes = 0;
    uint64_t resident_bytes = 0;                // of the keys, on the card
    uint32_t live_key_count = 0;                // whole, whether this frame looks into them or not
    uint32_t used_key_count = 0;                // that it looks into
    double error_p99_px = 0, error_max_px = 0;  // predicted, over the pixels
    double lost_share = 0;                      // predicted: 1 where there is no key
    Cause rekeyed = Cause::none;                // why the key that took over with this frame was made
};

// "jump", "turned", ...: as reports have it.
std::string_view name_of(Cause cause);

// Frames come in their order: each decide(), then draw(), then perhaps draw() again into other targets, which must give the same
// picture. A context must be current, also when it goes.
class FrameDrawer {
  public:
    // second: how KeyMode::thread comes by its context. Fails as Painter::make and KeyThread::start.
    static Result<std::unique_ptr<FrameDrawer>> make(std::unique_ptr<DrawnGeometry> thing, const FrameOptions& options,
                                                     const gl::SecondContextMaker& second = gl::second_context);
    FrameDrawer(const FrameDrawer&) = delete;
    FrameDrawer& operator=(const FrameDrawer&) = delete;

    // Draws, for nobody to see, with every program that frames like this one may need: renderers compile where they first draw.
    // Before the first frame; the frames are the same as without. Fails as draw().
    Result<void> prepare(const view::Camera& camera, const gl::Target& target);
    // camera: in the thing's own frame, of the size of the target. Another size than the frame's before forgets all keys.
    void decide(const view::Camera& camera);
    // Draws and resolves; need not wait until it is drawn. Fails as Painter::begin_key and Painter::draw.
    Result<FrameCounts> draw(const gl::Target& target);

    // The cameras of the keys that the frame drawn last looks into, as Painter::texel_camera says, in the order of the mask's
    // sources; and which of them, near geometry or nothing, each pixel is from (Painter's is_mask).
    std::vector<view::Camera> texel_cameras() const;
    Result<void> draw_mask(const gl::Target& target);

    // From the next frame on it is as if newly made: no key, no way flown. What was drawn stays on the card until drawn over.
    void forget();
    // Goes on with other settings, but for `slots` and whether keys have a thread, and forgets.
    void change(const FrameOptions& options);
    // From the next frame on; nothing is forgotten.
    void set_triangles(double triangles);
    // Changes the colours alone: grey where the first key is seen, yellow another, blue near geometry, red what no key shows.
    void show_sources(bool shows) { novel_.shows_sources = shows; }

  private:
    FrameDrawer(std::unique_ptr<DrawnGeometry> thing, const FrameOptions& options);
    void settle(const FrameOptions& options);
    Result<void> rehearse(const view::Camera& camera, const gl::Target& target);
    Result<void> draw_key();
    Result<void> draw_slice();
    Result<void> draw_beside();
    void count_key(const CutCount& count, uint64_t draw_call_count, uint64_t uploaded_bytes);
    void plan();
    Result<void> paint(const gl::Target& target, const NovelOptions& options);
    uint32_t grid_step() const;

    std::unique_ptr<DrawnGeometry> thing_;
    Settings settings_;
    NovelOptions novel_;
    std::optional<Director> director_;
    std::optional<Painter> painter_;
    std::unique_ptr<KeyThread> thread_;  // with KeyMode::thread; after the painter, whose textures it draws into
    std::vector<bool> is_whole_;         // of the slots
    view::Camera camera_;
    std::optional<KeyWork> work_;
    const Novel* plan_ = nullptr;
    bool is_drawn_ = false;
    FrameCounts counts_;
    uint64_t uploaded_bytes_ = 0;  // by the picture painted last
};

}  // namespace overlook::lod_sprite
