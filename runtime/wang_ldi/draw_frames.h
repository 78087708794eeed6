// Planted ground from frame to frame: the terrain by OpenGL, what is planted warped by the processor, both in one picture.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/stream/stream.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/counted_error.h"
#include "runtime/wang_ldi/draw_composite.h"
#include "runtime/wang_ldi/draw_plants.h"
#include "runtime/wang_ldi/draw_splats.h"
#include "runtime/wang_ldi/fast_warp.h"
#include "runtime/wang_ldi/image_store.h"
#include "runtime/wang_ldi/land_list.h"
#include "runtime/wang_ldi/plant_raster.h"
#include "runtime/wang_ldi/planted_field.h"
#include "runtime/wang_ldi/rings.h"
#include "runtime/wang_ldi/settings.h"
#include "runtime/wang_ldi/warp_field.h"

namespace overlook::wang_ldi {

// What is planted on. All must outlive what draws it.
struct Land {
    const terrain::Terrain* terrain = nullptr;
    const terrain::Refiner* refiner = nullptr;  // of terrain
    terrain::Drawing* drawing = nullptr;        // of terrain
    bool is_plain = false;                      // plain_terrain(), which goes where the eye goes
    Plants* plants = nullptr;                   // for near tiles; null: they are drawn as far ones
};
// Where the origin of its terrain lies for a camera, and the camera with a near plane that cuts nothing off the terrain.
glm::dvec3 origin_of(const Land& land, const view::Camera& camera);
view::Camera with_clear_near_plane(const terrain::Terrain& terrain, bool is_plain, const view::Camera& camera);

// How images are read.
struct ImageStreaming {
    stream::Settings settings;
    // Every picture waits for what memory has room for, and an image that cannot be read ends the drawing with its error; needs
    // latency_frames.
    bool waits = false;
};

// What one frame was and took. Exact, and the same on every run, but for the times.
struct FrameCounts {
    uint64_t triangle_count = 0;  // of the terrain
    uint64_t void_rim_triangle_count = 0;
    uint64_t terrain_tested_count = 0;
    uint64_t uploaded_bytes = 0;
    FieldCounts field;
    PlantCounts plants;  // drawn as geometry
    WarpCounts warp;
    uint64_t holes_filled = 0;    // pixels
    bool is_eye_outside = false;  // not as high above the ground below it as images were sampled for
    ImageStore::Taken images;
    stream::Counts stream;
    uint32_t latency_frames = 0;  // so many frames ago the picture's camera was given
    uint32_t threads = 1;
    bool are_plants_by_processor = false;  // as geometry
    bool is_warped_by_card = false;        // of warp then only `samples`, of all that is drawn, and images_missing are counted
    // plants_ms: of geometry that the processor draws, at the same time as warp_ms, which may each have waited for the other, and
    // both for what draws the terrain meanwhile. warp_ms of the card: until it has its orders.
    double list_ms = 0, plants_ms = 0, warp_ms = 0;
    double asked_error_px = 0;      // the options', or above it where a budget forces it
    int times_listed = 0;           // until it was found
    double planting_error_px = 0;   // of what is planted: planting_error_px, and of geometry what its levels are off
    double predicted_error_px = 0;  // of terrain and planting, the greater
};

// Frames come in their order: each decide(), then draw(), then perhaps draw() again into other targets, which shows the same from
// the same eye: what is warped is warped anew for a target whose samples take other places of it than those of the options'
// `samples`. A context must be current.
class FrameDrawer {
  public:
    // Fails as ImageStore::open, Composite::make, Splats::make, describe_current_context and Field::of.
    static Result<std::unique_ptr<FrameDrawer>> make(const PlantedField& planted, const Land& land, const FrameOptions& options,
                                                     const ImageStreaming& streaming);
    FrameDrawer(const FrameDrawer&) = delete;
    FrameDrawer& operator=(const FrameDrawer&) = delete;
    ~FrameDrawer();

    // From the next frame on. Images stay. What the processor draws plants from is made here, once. Fails as Splats::make.
    Result<void> change(const FrameOptions& options);
    const FrameOptions& options() const { return options_; }
    // Triangles, of terrain and plants, that a frame may have from the next on; 0: as many as the options' error takes. Counted
    // before a frame is drawn, as the error that is asked is raised (view::CountedError).
    void set_budget(double triangles) { fitting_error_.set_most(triangles); }

    // morph: as Refiner::cut_by_pixels. Fails if it waits for an image that cannot be read.
    Result<void> decide(const view::Camera& camera, double dt_s, double morph);
    // Draws what was decided, or one frame earlier if it is pipelined, and resolves; need not wait until it is drawn.
    void draw(const gl::Target& target, const terrain::DrawOptions& look);
    const FrameCounts& counts() const { return slots_[shown_].counts; }  // of the frame that is drawn
    // What the frame that is drawn shows, and of which field.
    const FieldList& list() const { return slots_[shown_].list; }
    const Field& field() const { return *slots_[shown_].field; }
    const std::vector<Error>& faults() const { return faults_; }  // images of this frame that cannot be read
    uint64_t budget_bytes() const { return store_->settings().residency_budget_bytes; }

  private:
    struct Slot : LandList {
        view::Camera camera;         // whose near plane cuts nothing off
        glm::dvec3 origin_m{0};      // of the terrain, in the camera's world
        double images_error_px = 0;  // planting_error_px
        Warped picture;
        FrameCounts counts;
    };
    FrameDrawer(const PlantedField& planted, const Land& land, const FrameOptions& options, const ImageStreaming& streaming);
    Result<void> prepare(const view::Camera& camera, double dt_s, double morph, Slot& slot);
    Result<void> list(Slot& slot, double morph);
    Result<void> fetch(Slot& slot, double dt_s);
    void look_ahead(Slot& slot, double dt_s);
    void paint(const Slot& slot, const FrameOptions& options, Warped& picture, FrameCounts& counts);
    void paint_images(const Slot& slot, const FrameOptions& options, Warped& picture, FrameCounts& counts);
    const Warped& picture_for(const Slot& slot, const FrameOptions& options);
    bool is_warped_by_card() const;
    bool can_draw_plants() const;
    void splat(Slot& slot, const FrameOptions& options);
    const StoredImage* image_at(uint64_t index) const;
    void wait();

    const PlantedField& planted_;
    Land land_;
    FrameOptions options_;
    ImageStreaming streaming_;
    std::unique_ptr<ImageStore> store_;
    std::optional<Composite> composite_;
    std::optional<Splats> splats_;  // while the card warps
    bool is_software_ = false;      // the renderer
    bool are_plants_by_processor_ = false;
    FarImages far_;
    RingImages rings_;
    FastWarp fast_;
    PlantRaster raster_;
    FieldList wanted_, ahead_;  // were all images at hand, of this frame and of a later one
    view::CountedError fitting_error_;
    std::optional<view::Camera> before_;  // the camera of the frame before
    std::vector<Error> faults_;
    Warped other_;  // of the frame drawn last, for a target of other samples
    Slot slots_[2];
    size_t shown_ = 0;
    bool has_next_ = false;      // the other slot is warped, or being warped, for a picture that is not shown yet
    std::future<void> warping_;  // of the slot decided last; last: it uses the others
};

}  // namespace overlook::wang_ldi
