#include "runtime/terrain/draw.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>
#include <vector>

#include "runtime/gl/background.h"
#include "runtime/gl/surface_shaders.h"
#include "runtime/terrain/draw_shaders.h"

namespace overlook::terrain {
namespace {

// Heights above the middle of their range, so that a float holds them to a ten-millionth of the range.
struct HeightsAboveBase {
    double base_m = 0, lowest_m = 0, highest_m = 0;
    std::vector<float> samples;
};

HeightsAboveBase heights_above_base(const Terrain& terrain) {
    int32_t lowest = std::numeric_limits<int32_t>::max(), highest = kVoid;
    for (int32_t height : terrain.heights) {
        if (height != kVoid) lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    if (highest == kVoid) lowest = highest = 0;

    int64_t base = (int64_t(lowest) + int64_t(highest)) / 2;
    HeightsAboveBase heights;
    heights.base_m = terrain.height_offset_m + terrain.height_step_m * double(base);
    heights.lowest_m = terrain.height_step_m * double(lowest - base);
    heights.highest_m = terrain.height_step_m * double(highest - base);
    heights.samples.reserve(terrain.heights.size());
    for (int32_t height : terrain.heights) {
        heights.samples.push_back(height == kVoid ? 0.0f : float(terrain.height_step_m * double(height - base)));
    }
    return heights;
}

// Its border stands where the raster's does.
Result<gl::Texture> make_clamped(const ImageRgb8& image) {
    Result<gl::Texture> texture = gl::make_texture(image);
    if (!texture) return texture;
    glTextureParameteri(texture->id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture->id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

Result<Drawing> Drawing::make(const Terrain& terrain) {
    assert(terrain.heights.size() == size_t(terrain.shape.width) * terrain.shape.height && !terrain.heights.empty());
    GLint most_samples = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_samples);
    if (terrain.heights.size() > uint32_t(most_samples)) {
        return impossible("a raster of {} x {} samples is too large to draw at once", terrain.shape.width, terrain.shape.height);
    }
    Drawing made;
    made.width_ = terrain.shape.width;
    made.height_ = terrain.shape.height;
    made.metres_per_column_ = terrain.frame.metres_per_column;
    made.metres_per_row_ = terrain.frame.metres_per_row;

    HeightsAboveBase heights = heights_above_base(terrain);
    made.base_m_ = heights.base_m;
    made.lowest_m_ = heights.lowest_m;
    made.highest_m_ = heights.highest_m;
    made.heights_ = gl::make_buffer(std::as_bytes(std::span(heights.samples)));
    if (glGetError() == GL_OUT_OF_MEMORY) return impossible("the terrain does not fit into the renderer's memory");

    made.heights_view_ = gl::make_view(made.heights_.id(), GL_R32F);
    made.heights_view_id_ = made.heights_view_.id();
    made.has_texture_ = !terrain.texture.pixels.empty();
    if (made.has_texture_) {
        Result<gl::Texture> texture = make_clamped(terrain.texture);
        if (!texture) return tl::unexpected(texture.error());
        made.texture_ = std::move(*texture);
        made.texture_id_ = made.texture_.id();
    }
    if (Result<void> own = made.make_own(); !own) return tl::unexpected(own.error());
    return made;
}

Result<Drawing> Drawing::sharing(const Drawing& first) {
    Drawing made;
    made.width_ = first.width_;
    made.height_ = first.height_;
    made.metres_per_column_ = first.metres_per_column_;
    made.metres_per_row_ = first.metres_per_row_;
    made.base_m_ = first.base_m_;
    made.lowest_m_ = first.lowest_m_;
    made.highest_m_ = first.highest_m_;
    made.has_texture_ = first.has_texture_;
    made.heights_view_id_ = first.heights_view_id_;
    made.texture_id_ = first.texture_id_;
    if (Result<void> own = made.make_own(); !own) return tl::unexpected(own.error());
    return made;
}

// What each context has for itself.
Result<void> Drawing::make_own() {
    const Cut::Morph none{};
    morphs_.fill(std::as_bytes(std::span(&none, 1)));
    morphs_view_ = gl::make_view(morphs_.id(), GL_RG32UI);
    vertices_ = gl::make_vertex_array();
    nothing_ = gl::make_vertex_array();
    glVertexArrayElementBuffer(vertices_.id(), indices_.id());
    return make_programs();
}

Result<gl::Program> Drawing::program(const gl::SurfaceShader& shader) const {
    std::string vertex = shaders::kTerrainVertexInputs + (shader.vertex.empty() ? gl::shaders::kUnmoved : shader.vertex) +
                         shaders::kTerrainVertexMain;
    std::string fragment = std::string(gl::shaders::kEncoding) + shaders::kAir + shaders::kTerrainFragment + shader.fragment;
    return gl::Program::make(shader.name, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}});
}

Result<void> Drawing::make_programs() {
    const std::string vertex_source =
        std::string(shaders::kTerrainVertexInputs) + gl::shaders::kUnmoved + shaders::kTerrainVertexMain;
    const std::string ground_source = std::string(gl::shaders::kEncoding) + shaders::kAir + shaders::kTerrainFragment;
    const std::string wireframe_source = ground_source + shaders::kWireframeMain;
    auto shaded = program({"terrain", "", gl::shaders::kShadedMain});
    if (!shaded) return tl::unexpected(shaded.error());
    auto wireframe = gl::Program::make("wireframe", {{GL_VERTEX_SHADER, vertex_source},
                                                     {GL_GEOMETRY_SHADER, shaders::kWireframeGeometry},
                                                     {GL_FRAGMENT_SHADER, wireframe_source}});
    if (!wireframe) return tl::unexpected(wireframe.error());
    std::string sky_source = std::string(gl::shaders::kBackgroundDirection) + shaders::kSkyFragment;
    auto sky = gl::Program::make("sky", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, sky_source}});
    if (!sky) return tl::unexpected(sky.error());
    shaded_ = std::move(*shaded);
    wireframe_ = std::move(*wireframe);
    sky_ = std::move(*sky);
    return make_sky_row();
}

// Colours once and for all, so that a pixel of the sky costs a look-up.
Result<void> Drawing::make_sky_row() {
    std::string row_source = std::string(gl::shaders::kEncoding) + shaders::kAir + shaders::kSkyRowFragment;
    auto row =
        gl::Program::make("sky row", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, row_source}});
    if (!row) return tl::unexpected(row.error());
    GLuint texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    sky_row_ = gl::Texture(texture);
    glTextureStorage2D(texture, 1, GL_RGBA32F, shaders::kSkyColours, 1);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, &framebuffer);
    gl::Framebuffer into(framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    gl::bind_for_drawing(framebuffer, shaders::kSkyColours, 1);
    glDisable(GL_DEPTH_TEST);
    row->use();
    glUniform1f(row->at("count"), float(shaders::kSkyColours));
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    return {};
}

namespace {

view::Part part_of(const view::Camera& camera, const DrawOptions& options) {
    return options.part.value_or(view::Part{0, 0, camera.width_px, camera.height_px});
}

}  // namespace

void Drawing::set_camera(const gl::Program& program, const view::Camera& camera, const DrawOptions& options) const {
    constexpr double kFarthestCell = 1 << 30;
    glm::dvec3 place_m = camera.position_m - options.origin_m;
    double column = place_m.x / metres_per_column_, row = -place_m.y / metres_per_row_;
    double whole_column = std::clamp(std::floor(column), -kFarthestCell, kFarthestCell);
    double whole_row = std::clamp(std::floor(row), -kFarthestCell, kFarthestCell);
    double width_m = metres_per_column_ * width_, height_m = metres_per_row_ * height_;

    glm::mat4 clip_from_relative = view::projection(camera) * view::rotation(camera);
    glUniform1ui(program.at("width"), width_);
    glUniform1ui(program.at("sample_count"), width_ * height_);
    glUniform2i(program.at("camera_sample"), GLint(whole_column), GLint(whole_row));
    glUniform2f(program.at("camera_rest"), float(column - whole_column), float(row - whole_row));
    glUniform2f(program.at("metres_per_cell"), float(metres_per_column_), float(-metres_per_row_));
    glUniform1f(program.at("camera_height_m"), float(place_m.z - base_m_));
    glUniformMatrix4fv(program.at("clip_from_relative"), 1, GL_FALSE, glm::value_ptr(clip_from_relative));
    view::PartMap map = view::part_map(camera, part_of(camera, options));
    glUniform4f(program.at("part"), float(map.scale.x), float(map.scale.y), float(map.shift.x), float(map.shift.y));
    glUniform2f(program.at("raster_size"), float(width_), float(height_));
    glUniform1i(program.at("has_texture"), has_texture_ ? 1 : 0);
    glUniform1i(program.at("colours"), 0);
    glUniform2f(program.at("height_range_m"), float(lowest_m_), float(highest_m_));
    glUniform2f(program.at("place_per_m"), float(1 / width_m), float(-1 / height_m));
    glUniform1f(program.at("haze_per_m"), float(0.5 * options.haze / std::hypot(width_m, height_m)));
    glUniform1f(program.at("line_px"), float(options.line_px));
}

void Drawing::draw_sky(const view::Camera& camera, const DrawOptions& options) const {
    glBindTextureUnit(3, sky_row_.id());
    gl::draw_background(sky_, camera, part_of(camera, options), nothing_);
}

// Of its own texture; a shared one is as its owner has it.
void Drawing::set_anisotropy(float anisotropy) {
    if (texture_.id() == 0 || anisotropy == anisotropy_) return;
    anisotropy_ = anisotropy;
    if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTextureParameterf(texture_.id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, std::clamp(anisotropy, 1.0f, most));
}

void Drawing::draw_with(const gl::Program& program, const view::Camera& camera, const DrawOptions& options, TriangleRange range) {
    program.use();
    set_camera(program, camera, options);
    glBindVertexArray(vertices_.id());
    glBindTextureUnit(1, heights_view_id_);
    glBindTextureUnit(2, morphs_view_.id());
    if (has_texture_) glBindTextureUnit(0, texture_id_);
    set_anisotropy(options.anisotropy);
    uint64_t triangles = uint64_t(index_count_) / 3, first = std::min(range.first, triangles);
    GLsizei count = GLsizei(3 * std::min(range.count, triangles - first));
    if (count == 0) return;
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * 3 * sizeof(uint32_t)));
}

void Drawing::take(const Cut& cut) {
    // A draw call counts in 31 bits; a cut of so many triangles would be hours of work anyway.
    size_t most_indices = size_t(std::numeric_limits<GLsizei>::max()) / 3 * 3;
    std::span<const uint32_t> indices = std::span(cut.indices).first(std::min(cut.indices.size(), most_indices));
    indices_.fill(std::as_bytes(indices));
    index_count_ = GLsizei(indices.size());
    static_assert(sizeof(Cut::Morph) == 8);
    if (!cut.morphs.empty()) morphs_.fill(std::as_bytes(std::span(cut.morphs)));
    uploaded_bytes_ = indices.size_bytes() + cut.morphs.size() * sizeof(Cut::Morph);
}

void Drawing::draw(const gl::Target& target, const Cut& cut, const view::Camera& camera, const DrawOptions& options) {
    take(cut);
    target.bind();
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glDisable(GL_CULL_FACE);

    GLint half_px = GLint(target.width_px() / 2);
    if (options.look == Look::split) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, half_px, GLsizei(target.height_px()));
        draw_with(wireframe_, camera, options);
        glScissor(half_px, 0, GLsizei(target.width_px()) - half_px, GLsizei(target.height_px()));
        draw_with(shaded_, camera, options);
        glDisable(GL_SCISSOR_TEST);
    } else {
        draw_with(options.look == Look::wireframe ? wireframe_ : shaded_, camera, options);
    }
    draw_sky(camera, options);
    target.resolve();
}

}  // namespace overlook::terrain
