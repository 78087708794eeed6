#include "runtime/wang_ldi/draw_frames.h"

#include <algorithm>
#include <chrono>

#include "formats/parallel.h"
#include "runtime/gl/context.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/wang_ldi/plain.h"
#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kAhead_s = 0.5;  // images are asked for where the eye will be then

class Clock {
  public:
    double elapsed_ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

view::Camera moved(view::Camera camera, const glm::dvec3& by_m) {
    camera.position_m += by_m;
    return camera;
}

}  // namespace

glm::dvec3 origin_of(const Land& land, const view::Camera& camera) {
    return land.is_plain ? plain_origin_m(camera.position_m) : glm::dvec3(0);
}

view::Camera with_clear_near_plane(const terrain::Terrain& terrain, bool is_plain, const view::Camera& camera) {
    glm::dvec3 origin_m = is_plain ? plain_origin_m(camera.position_m) : glm::dvec3(0);
    view::Camera clear = camera;
    clear.near_m = terrain::with_clear_near_plane(terrain, moved(camera, -origin_m)).near_m;
    return clear;
}

FrameDrawer::FrameDrawer(const PlantedField& planted, const Land& land, const FrameOptions& options,
                         const ImageStreaming& streaming)
    : planted_(planted), land_(land), options_(options), streaming_(streaming) {}

FrameDrawer::~FrameDrawer() {
    wait();
}

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::make(const PlantedField& planted, const Land& land, const FrameOptions& options,
                                                       const ImageStreaming& streaming) {
    std::unique_ptr<FrameDrawer> made(new FrameDrawer(planted, land, options, streaming));
    Result<std::unique_ptr<ImageStore>> store = ImageStore::open(planted.name(), planted.images(), streaming.settings);
    if (!store) return tl::unexpected(store.error());
    made->store_ = std::move(*store);
    Result<Composite> composite = Composite::make();
    if (!composite) return tl::unexpected(composite.error());
    made->composite_.emplace(std::move(*composite));
    Result<gl::Renderer> renderer = gl::describe_current_context();
    if (!renderer) return tl::unexpected(renderer.error());
    made->is_software_ = renderer->is_software;
    if (Result<void> ready = made->change(options); !ready) return tl::unexpected(ready.error());

    const ImageSet& set = planted.images().set();
    const ImageStore& images = *made->store_;
    ImageAt image_at = [&](uint64_t index) {
        const StoredImage* image = images.at(index);
        return image == nullptr ? nullptr : &image->ldi;
    };
    std::optional<TextureSet> of_images;
    if (!planted.textures()) of_images = textures_of_images(set, image_at);
    const TextureSet& textures = of_images ? *of_images : *planted.textures();
    if (Result<void> fits = FarImages::check(textures, planted.name()); !fits) return tl::unexpected(fits.error());
    made->far_ = FarImages(textures);
    Result<Field> field = Field::of(planted.parts(), field_options_of(set, options, {}, made->far_.side_px()));
    if (!field) return tl::unexpected(field.error());
    return made;
}

Result<void> FrameDrawer::change(const FrameOptions& options) {
    wait();
    options_ = options;
    are_plants_by_processor_ = can_draw_plants() && !land_.plants->shapes().empty();
    if (!is_warped_by_card()) splats_.reset();
    if (!is_warped_by_card() || splats_) return {};
    Result<Splats> splats = Splats::make();
    if (!splats) return tl::unexpected(splats.error());
    splats_.emplace(std::move(*splats));
    return {};
}

bool FrameDrawer::is_warped_by_card() const {
    if (options_.variant == Variant::paper || options_.is_exact || !options_.is_by_depth) return false;
    return options_.warper == Warper::card || (options_.warper == Warper::by_renderer && !is_software_);
}

// Whether the processor is to draw plants, if they can be shaped.
bool FrameDrawer::can_draw_plants() const {
    bool has_plants = options_.variant == Variant::own && options_.has_geometry && land_.plants != nullptr;
    if (!has_plants || is_warped_by_card() || !options_.is_by_depth) return false;
    bool is_best = options_.geometry_by == Warper::by_renderer && is_software_ && options_.samples <= 1;
    return options_.geometry_by == Warper::processor || is_best;
}

void FrameDrawer::wait() {
    if (warping_.valid()) warping_.get();
}

Result<void> FrameDrawer::decide(const view::Camera& camera, double dt_s, double morph) {
    wait();
    size_t ready = shown_, next = 1 - shown_;
    if (has_next_) ready = 1 - shown_, next = shown_;
    const Warped& done = slots_[ready].picture;
    view::Camera as_warped = warped_camera(options_, camera);
    bool fits = done.width_px == as_warped.width_px && done.height_px == as_warped.height_px;
    bool is_late = options_.is_pipelined && !splats_ && fits;
    if (Result<void> prepared = prepare(camera, dt_s, morph, slots_[next]); !prepared) return prepared;
    before_ = camera;
    if (splats_)
        slots_[next].picture.clear(0, 0);  // the card warps, and none is left of an earlier way
    else
        warping_ =
            std::async(std::launch::async, [this, &slot = slots_[next]] { paint(slot, options_, slot.picture, slot.counts); });
    shown_ = is_late ? ready : next, has_next_ = is_late;
    slots_[shown_].counts.latency_frames = is_late ? 1 : 0;
    return {};
}

Result<void> FrameDrawer::prepare(const view::Camera& camera, double dt_s, double morph, Slot& slot) {
    slot.counts = {};
    slot.origin_m = origin_of(land_, camera);
    slot.camera = with_clear_near_plane(*land_.terrain, land_.is_plain, camera);
    Clock clock;
    if (Result<void> listed = list(slot, morph); !listed) return listed;
    if (Result<void> fetched = fetch(slot, dt_s); !fetched) return fetched;
    FrameCounts& counts = slot.counts;
    counts.plants = counts_of(slot.plants), counts.are_plants_by_processor = are_plants_by_processor_;
    counts.list_ms = clock.elapsed_ms();
    counts.triangle_count = slot.cut.triangle_count(), counts.void_rim_triangle_count = slot.cut.void_rim_triangle_count;
    counts.terrain_tested_count = slot.cut.tested_count;
    slot.images_error_px = planting_error_px(*slot.field, slot.list, slot.camera);
    counts.threads = thread_count();
    const Cell& cell = planted_.images().set().cell;
    double above_m = slot.camera.position_m.z - planted_.ground().height_m(glm::dvec2(slot.camera.position_m));
    counts.is_eye_outside = !(above_m >= cell.eye_low_m && above_m <= cell.eye_high_m);
    return {};
}

// At the error that keeps the budget.
Result<void> FrameDrawer::list(Slot& slot, double morph) {
    LandLister lister(planted_, *land_.refiner, land_.plants != nullptr ? &land_.plants->forms() : nullptr);
    FrameOptions options = options_;
    Result<void> listed;
    slot.counts.asked_error_px = fitting_error_.error_px(options_.error_px, [&](double error_px) {
        options.error_px = error_px;
        if (listed) listed = lister.list(slot.camera, slot.origin_m, options, far_.side_px(), morph, slot);
        return double(slot.triangle_count());
    });
    if (listed)
        lister.fill_with_ground(slot.camera, slot.origin_m, options_.error_px, slot.counts.asked_error_px, fitting_error_, morph,
                                slot);
    slot.counts.times_listed = fitting_error_.count_count(), slot.counts.field = slot.list.counts;
    return listed;
}

// Has its images at hand, or others in their place.
Result<void> FrameDrawer::fetch(Slot& slot, double dt_s) {
    uint64_t streamed_bytes = 0;
    faults_.clear();
    if (streaming_.waits) wanted_ = slot.list;
    bool has_stand_ins = false;  // in the list
    do {
        const std::vector<Error>& faults = store_->begin_frame();
        faults_.insert(faults_.end(), faults.begin(), faults.end());
        if (streaming_.waits && !faults_.empty()) return tl::unexpected(faults_.front());
        if (has_stand_ins) slot.list = wanted_;
        has_stand_ins = true;
        slot.counts.images = store_->take(*slot.field, slot.list);
        if (!streaming_.waits) look_ahead(slot, dt_s);
        store_->end_frame();
        streamed_bytes += store_->counts().uploaded_bytes;
    } while (streaming_.waits && !store_->is_settled());
    slot.counts.stream = store_->counts();
    slot.counts.stream.uploaded_bytes = streamed_bytes;
    if (options_.shows_rings) rings_.take(*slot.field, slot.list, *store_);
    return {};
}

void FrameDrawer::look_ahead(Slot& slot, double dt_s) {
    if (!before_ || !(dt_s > 0)) return;
    glm::dvec3 way_m = (slot.camera.position_m - before_->position_m) * (kAhead_s / dt_s);
    double turn_deg = std::remainder(slot.camera.heading_deg - before_->heading_deg, 360.0) * (kAhead_s / dt_s);
    if (way_m == glm::dvec3(0) && turn_deg == 0) return;
    view::Camera camera = moved(slot.camera, way_m);
    camera.heading_deg += std::clamp(turn_deg, -90.0, 90.0);
    slot.field->list(camera, ahead_, slot.scratch);
    store_->look_ahead(*slot.field, ahead_);
}

const StoredImage* FrameDrawer::image_at(uint64_t index) const {
    const StoredImage* ring = options_.shows_rings ? rings_.at(index) : nullptr;
    return ring != nullptr ? ring : store_->at(index);
}

// By the graphics card, as the frame is drawn.
void FrameDrawer::splat(Slot& slot, const FrameOptions& options) {
    Clock clock;
    PreparedAt at = [this](uint64_t index) {
        const StoredImage* image = image_at(index);
        return image == nullptr ? nullptr : &image->prepared;
    };
    SplatCounts drawn = splats_->draw(warped_camera(options, slot.camera), *slot.field, slot.list, at, options.fills_holes, &far_,
                                      *composite_, warped_finer(options, slot.camera));
    slot.counts.warp = {}, slot.counts.warp.samples = drawn.samples, slot.counts.warp.images_missing = drawn.images_missing;
    slot.counts.uploaded_bytes += drawn.uploaded_bytes, slot.counts.is_warped_by_card = true;
    slot.counts.warp_ms = clock.elapsed_ms();
}

// By the processor, as wide as the options warp it; plants that it draws at the same time.
void FrameDrawer::paint(const Slot& slot, const FrameOptions& options, Warped& picture, FrameCounts& counts) {
    if (!slot.counts.are_plants_by_processor) return paint_images(slot, options, picture, counts);
    parallel_both(
        [&] {
            Clock clock;
            raster_.draw(warped_camera(options, slot.camera), land_.plants->shapes(), land_.plants->light(), slot.plants);
            counts.plants_ms = clock.elapsed_ms();
        },
        [&] { paint_images(slot, options, picture, counts); });
    raster_.lay_over(picture);
}

void FrameDrawer::paint_images(const Slot& slot, const FrameOptions& options, Warped& picture, FrameCounts& counts) {
    Clock clock;
    bool is_paper = options.variant == Variant::paper;
    view::Camera camera = warped_camera(options, slot.camera);
    uint32_t finer = warped_finer(options, slot.camera);
    if (is_paper || options.is_exact) {
        picture.clear(camera.width_px, camera.height_px);
        ImageAt at = [this](uint64_t index) {
            const StoredImage* image = image_at(index);
            return image == nullptr ? nullptr : &image->ldi;
        };
        Hiding hiding = is_paper || !options.is_by_depth ? Hiding::by_order : Hiding::by_depth;
        counts.warp = warp_field(camera, *slot.field, slot.list, at, hiding, picture, &far_, finer);
    } else {
        PreparedAt at = [this](uint64_t index) {
            const StoredImage* image = image_at(index);
            return image == nullptr ? nullptr : &image->prepared;
        };
        FastOptions fast;
        fast.fills_holes = options.fills_holes, fast.finer = finer;
        fast.hiding = options.is_by_depth ? Hiding::by_depth : Hiding::by_order;
        counts.warp = fast_.warp(camera, *slot.field, slot.list, at, fast, picture, &far_);
        counts.holes_filled = fast_.holes_filled();
    }
    counts.warp_ms = clock.elapsed_ms();
}

// The frame's own, or warped anew if these options take another.
const Warped& FrameDrawer::picture_for(const Slot& slot, const FrameOptions& options) {
    view::Camera camera = warped_camera(options, slot.camera);
    if (camera.width_px == slot.picture.width_px && camera.height_px == slot.picture.height_px) return slot.picture;
    wait();  // what is warped meanwhile has the same tools
    FrameCounts counts;
    paint(slot, options, other_, counts);
    return other_;
}

void FrameDrawer::draw(const gl::Target& target, const terrain::DrawOptions& look) {
    Slot& slot = slots_[shown_];
    view::Camera local = moved(slot.camera, -slot.origin_m);
    land_.drawing->draw(target, slot.cut, local, look);
    if (land_.plants != nullptr && !slot.counts.are_plants_by_processor)
        slot.counts.plants = land_.plants->draw(target, slot.camera, slot.plants, land_.drawing->haze_per_m(look));
    if (!has_next_) {
        glFlush();  // so that a renderer with threads of its own begins
        wait();
    }
    slot.counts.planting_error_px = std::max(slot.images_error_px, slot.counts.plants.error_px);
    slot.counts.predicted_error_px = std::max(slot.cut.predicted_error_px, slot.counts.planting_error_px);
    slot.counts.uploaded_bytes = land_.drawing->uploaded_bytes() + slot.counts.plants.uploaded_bytes;
    FrameOptions options = options_;
    options.samples = target.samples();
    if (splats_)
        splat(slot, options);
    else
        slot.counts.uploaded_bytes += composite_->take(picture_for(slot, options));
    composite_->draw(target, slot.camera, land_.drawing->haze_per_m(look));
}

}  // namespace overlook::wang_ldi
