// A terrain in the player: by its own triangles, or by LOD-sprite on them.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "formats/terrain.h"
#include "runtime/gl/timer.h"
#include "runtime/lod_sprite/draw_on_terrain.h"
#include "runtime/player/draw_cut.h"
#include "runtime/player/draw_sprite.h"
#include "runtime/player/flight.h"
#include "runtime/player/subject.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/terrain/refine.h"

namespace overlook::player {
namespace {

class TerrainSubject : public Subject {
  public:
    TerrainSubject(terrain::Terrain terrain, const LayerMethod& layer)
        : terrain_(std::move(terrain)), refiner_(terrain_), ground_(terrain_), layer_(layer) {}

    Result<void> upload(const gl::SecondContextMaker& second) override {
        second_context_ = second;
        Result<terrain::Drawing> drawing = terrain::Drawing::make(terrain_);
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    view::Camera overview(uint32_t width_px, uint32_t height_px) const override {
        return player::overview(terrain_, refiner_.lowest_m(), refiner_.highest_m(), width_px, height_px);
    }
    Thing thing() const override { return Thing::terrain; }
    double near_m() const override { return std::min(0.5, 0.25 * step_m()); }
    std::optional<double> height_m(double x_m, double y_m) const override { return ground_.height_m(x_m, y_m); }
    double distance_m(const glm::dvec3& place_m) const override { return ground_.distance_m(place_m); }
    double step_m() const override { return ground_.step_m(); }
    double least_speed_m_s() const override { return ground_.least_speed_m_s(); }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value());
        view::Camera local = terrain::with_clear_near_plane(terrain_, camera);
        bool goes_on = style.method == Method::lod_sprite_paper && style.error_px == paper_error_px_;
        if (!goes_on) paper_.reset();
        if (style.method != Method::lod_sprite) sprite_.pause();

        FrameRecord record;
        record.asked_error_px = style.error_px;
        Result<void> drawn;
        if (style.method == Method::terrain) {
            draw_triangles(target, local, style, record);
        } else if (style.method == Method::lod_sprite) {
            auto make_thing = [&] { return std::make_unique<lod_sprite::DrawnTerrain>(refiner_, *drawing_, sprite_look(style)); };
            drawn = sprite_.draw(target, local, style, make_thing, second_context_, record);
        } else {
            ready_paper(style);
            drawn = draw_sprite(*paper_, target, local, record);
        }
        if (!drawn) return tl::unexpected(drawn.error());
        return record;
    }

  private:
    static terrain::DrawOptions sprite_look(const FrameStyle& style) {
        terrain::DrawOptions look = style.look;
        look.look = terrain::Look::shaded;
        return look;
    }

    void ready_paper(const FrameStyle& style) {
        if (paper_) return;
        lod_sprite::paper::FrameOptions options = with_error(layer_.paper, style.error_px);
        options.look = sprite_look(style);
        paper_ = std::make_unique<lod_sprite::paper::FrameDrawer>(terrain_, refiner_, *drawing_, options);
        paper_error_px_ = style.error_px;
    }

    void draw_triangles(const gl::Target& target, const view::Camera& local, const FrameStyle& style, FrameRecord& record) {
        gl::Timer refining;
        refiner_.cut_by_pixels(local, style.error_px, cut_, style.morph);
        record.refine_ms = refining.elapsed_ms();
        draw_cut(*drawing_, target, cut_, local, style.look, record);
    }

    const terrain::Terrain terrain_;
    const terrain::Refiner refiner_;
    TerrainGround ground_;
    LayerMethod layer_;
    gl::SecondContextMaker second_context_;
    std::optional<terrain::Drawing> drawing_;
    terrain::Cut cut_;
    SpriteDrawing sprite_{layer_.sprite};
    std::unique_ptr<lod_sprite::paper::FrameDrawer> paper_;  // while it is drawn with
    double paper_error_px_ = 0;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_terrain(const container::Reader& file, const LayerMethod& layer) {
    Result<terrain::Terrain> terrain = terrain::read(file);
    if (!terrain) return tl::unexpected(terrain.error());
    return std::make_unique<TerrainSubject>(std::move(*terrain), layer);
}

}  // namespace overlook::player
