#include "tools/measure/terrain_method.h"

#include "tools/measure/honesty/terrain_honesty.h"

namespace overlook::measure {
namespace {

constexpr double kSplitAll_m = -1;  // below every error, 0 as well
constexpr uint64_t kDrawCalls = 2;  // sky and ground

class Refined : public Method {
  public:
    Refined(World& world, const view::ErrorBudget& budget, double morph) : world_(world), controller_(budget), morph_(morph) {}

    void decide(const view::Camera& camera, uint32_t) override {
        camera_ = camera;
        error_px_ = controller_.error_px();
        world_.refiner->cut_by_pixels(camera, error_px_, cut_, morph_);
        controller_.frame_done(double(cut_.triangle_count()));
    }
    Counters draw(const gl::Target& target) override {
        return draw_cut(*world_.drawing, world_.resident_bytes, target, cut_, camera_, world_.look);
    }
    // The same cut again, with what it is worth: the frames that are timed do without.
    std::optional<Promises> promises() override {
        terrain::Cut cut;
        cut.wants_codes = true;
        world_.refiner->cut_by_pixels(camera_, error_px_, cut, morph_);
        return promises_of(*world_.terrain, cut, camera_, error_px_);
    }

  private:
    World& world_;
    view::ErrorController controller_;
    double morph_;
    double error_px_ = 0;  // of the frame decided last
    view::Camera camera_;
    terrain::Cut cut_;
};

}  // namespace

Counters draw_cut(terrain::Drawing& drawing, uint64_t resident_bytes, const gl::Target& target, const terrain::Cut& cut,
                  const view::Camera& camera, const terrain::DrawOptions& look) {
    drawing.draw(target, cut, camera, look);
    Counters counters;
    counters.triangle_count = cut.triangle_count();
    counters.vertex_reference_count = cut.indices.size();
    counters.draw_call_count = kDrawCalls;
    counters.uploaded_bytes = drawing.uploaded_bytes();
    counters.tested_count = cut.tested_count;
    counters.resident_bytes = resident_bytes + counters.uploaded_bytes;
    counters.predicted_error_px = cut.predicted_error_px;
    return counters;
}

std::unique_ptr<Method> make_terrain_method(World& world, const view::ErrorBudget& budget, double morph) {
    return std::make_unique<Refined>(world, budget, morph);
}

terrain::Cut full_cut(const World& world) {
    terrain::Cut cut;
    world.refiner->cut_by_metres(kSplitAll_m, cut);
    cut.tested_count = 0;  // nothing is decided from frame to frame
    cut.predicted_error_px = 0;
    return cut;
}

}  // namespace overlook::measure
