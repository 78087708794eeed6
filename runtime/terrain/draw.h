// Drawing a cut of a terrain with OpenGL; which triangles, runtime/terrain/refine.h decides.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "formats/terrain.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/surface.h"
#include "runtime/gl/target.h"
#include "runtime/terrain/refine.h"
#include "runtime/terrain/tiles.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

enum class Look {
    shaded,     // the texture as it is, or plain shading by slope where there is none
    wireframe,  // the triangles' edges over a pale picture
    split,      // left half wireframe, right half shaded
};

struct DrawOptions {
    Look look = Look::shaded;
    double haze = 1;         // how much the air hides far things: 0 = not at all, 1 = a fair day
    float anisotropy = 1;    // texels taken along the view, at most; 1 where software draws (see player's choose_samples)
    double line_px = 1;      // width of the wireframe's lines
    glm::dvec3 origin_m{0};  // where the terrain's own origin lies in the world that the camera is in
    // What of the camera's picture the target shows, pixel by pixel; the whole of it if not said. (Pictures larger than a
    // renderer can draw are put together from parts.)
    std::optional<view::Part> part;
};

// A terrain on the graphics card: 4 bytes a sample and its texture. The terrain itself may go afterwards.
// It is drawn relative to the camera (whole cells subtracted as integers, the rest in double), so that the picture is
// the same however far from the world's origin the terrain lies.
class Drawing {
  public:
    // Fails with Exit::impossible if the texture or the raster is too large for the renderer.
    static Result<Drawing> make(const Terrain& terrain);

    // The same terrain for another context that shares the first's objects, current now: heights and texture are the first's,
    // which must outlive it; all else is its own. So both may draw at once, each in its own thread. Fails with Exit::our_bug.
    static Result<Drawing> sharing(const Drawing& first);

    // Of a terrain in tiles: 4 bytes a vertex of every slot. Cuts are TileRefiner's. Fails as the first.
    static Result<Drawing> make(const Tiles& tiles);
    // A tile has arrived and has its slot.
    void take_tile(const Tiles& tiles, uint32_t tile);

    // Draws sky and terrain into `target` and resolves it. Indices of `cut` refer to the terrain given to make().
    // The same arguments give the same picture. A part shows what the whole picture shows there, but for what rounding decides:
    // a renderer rounds places on the screen by their distance from the viewport's own corner.
    void draw(const gl::Target& target, const Cut& cut, const view::Camera& camera, const DrawOptions& options);

    // Draws with a cut what a method colours by itself, into whatever is bound.
    Result<gl::Program> program(const gl::SurfaceShader& shader) const;
    void take(const Cut& cut);  // what draw_with() draws from now on
    void draw_with(const gl::Program& program, const view::Camera& camera, const DrawOptions& options,
                   gl::TriangleRange range = {});
    void draw_sky(const view::Camera& camera, const DrawOptions& options) const;  // where nothing is drawn yet

    // How much of the air before a metre's distance hides what is behind it, as its own shaders take it.
    double haze_per_m(const DrawOptions& options) const;

    // What the last draw() or take() sent to the card, and the tiles since the one before.
    uint64_t uploaded_bytes() const { return uploaded_bytes_; }

  private:
    Drawing() = default;
    void set_anisotropy(float anisotropy);
    void set_head(const Terrain& head, StepRange whole);
    Result<void> set_texture(const ImageRgb8& image);
    Result<void> make_own();
    std::string vertex_source(const std::string& placed) const;
    Result<void> make_programs();
    Result<void> make_sky_row();
    void set_camera(const gl::Program& program, const view::Camera& camera, const DrawOptions& options) const;

    uint32_t width_ = 0, height_ = 0, sample_count_ = 0;
    bool is_tiled_ = false;
    double metres_per_column_ = 1, metres_per_row_ = 1;
    int64_t base_ = 0;  // steps; heights on the card are above this one
    double base_m_ = 0;
    double lowest_m_ = 0;   // above base_m_
    double highest_m_ = 0;  // above base_m_
    bool has_texture_ = false;
    gl::Buffer heights_, slots_;  // slots: first column, row and level of each
    gl::Texture slots_view_;
    gl::VertexArray vertices_, nothing_;
    gl::StreamBuffer indices_, morphs_;
    gl::Texture heights_view_, morphs_view_;  // the buffers as textures of one row
    GLsizei index_count_ = 0;
    gl::Texture texture_, sky_row_;
    GLuint heights_view_id_ = 0, texture_id_ = 0;  // its own or those it shares
    float anisotropy_ = 0;                         // that its texture was set to
    gl::Program shaded_, wireframe_, sky_;
    uint64_t uploaded_bytes_ = 0, tile_bytes_ = 0;
};

// A terrain's cut as a thing that any method may colour. The drawing must outlive it.
class CutSurface : public gl::Surface {
  public:
    CutSurface(Drawing& drawing, const DrawOptions& options) : drawing_(drawing), options_(options) {}

    // What is drawn from now on, by all surfaces of this drawing.
    void take(const Cut& cut) { drawing_.take(cut); }
    // Only these of what was taken.
    void take_range(gl::TriangleRange range) { range_ = range; }
    uint64_t uploaded_bytes() const { return drawing_.uploaded_bytes(); }

    Result<gl::Program> program(const gl::SurfaceShader& shader) const override { return drawing_.program(shader); }
    void draw(const gl::Program& program, const view::Camera& camera) override {
        drawing_.draw_with(program, camera, options_, range_);
    }
    uint64_t draw_call_count() const override { return 1; }
    void draw_background(const view::Camera& camera) override { drawing_.draw_sky(camera, options_); }

  private:
    Drawing& drawing_;
    DrawOptions options_;
    gl::TriangleRange range_;
};

}  // namespace overlook::terrain
