#include "runtime/terrain/draw.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "runtime/gl/background.h"
#include "runtime/gl/surface_shaders.h"
#include "runtime/terrain/draw_shaders.h"

namespace overlook::terrain {
namespace {

// Lowest and highest height; empty if all are void.
StepRange range_of(const Terrain& terrain) {
    StepRange range;
    for (int32_t height : terrain.heights) {
        if (height != kVoid) range = {std::min(range.low, height), std::max(range.high, height)};
    }
    return range;
}

// Heights above the middle of their range, so that a float holds them to a ten-millionth of the range.
std::vector<float> above_base(std::span<const int32_t> heights, double step_m, int64_t base) {
    std::vector<float> above;
    above.reserve(heights.size());
    for (int32_t height : heights) above.push_back(height == kVoid ? 0.0f : float(step_m * double(height - base)));
    return above;
}

// A buffer that parts are written into.
gl::Buffer make_room(size_t bytes) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, GLsizeiptr(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return gl::Buffer(id);
}

// Fails where so many places are more than a buffer that is read as a texture can have.
Result<void> check_places(uint64_t count, const Terrain& head) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (count <= uint32_t(most)) return {};
    return impossible("a raster of {} x {} samples is too large to draw at once", head.shape.width, head.shape.height);
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

void Drawing::set_head(const Terrain& head, StepRange whole) {
    if (whole.is_empty()) whole = {0, 0};
    width_ = head.shape.width;
    height_ = head.shape.height;
    sample_count_ = width_ * height_;
    metres_per_column_ = head.frame.metres_per_column;
    metres_per_row_ = head.frame.metres_per_row;
    base_ = (int64_t(whole.low) + int64_t(whole.high)) / 2;
    base_m_ = head.height_offset_m + head.height_step_m * double(base_);
    lowest_m_ = head.height_step_m * double(whole.low - base_);
    highest_m_ = head.height_step_m * double(whole.high - base_);
}

Result<void> Drawing::set_texture(const ImageRgb8& image) {
    has_texture_ = !image.pixels.empty();
    if (!has_texture_) return {};
    Result<gl::Texture> texture = make_clamped(image);
    if (!texture) return tl::unexpected(texture.error());
    texture_ = std::move(*texture);
    texture_id_ = texture_.id();
    return {};
}

Result<Drawing> Drawing::make(const Terrain& terrain) {
    assert(terrain.heights.size() == size_t(terrain.shape.width) * terrain.shape.height && !terrain.heights.empty());
    if (Result<void> fits = check_places(terrain.heights.size(), terrain); !fits) return tl::unexpected(fits.error());
    Drawing made;
    made.set_head(terrain, range_of(terrain));
    std::vector<float> above = above_base(terrain.heights, terrain.height_step_m, made.base_);
    made.heights_ = gl::make_buffer(std::as_bytes(std::span(above)));
    if (glGetError() == GL_OUT_OF_MEMORY) return impossible("the terrain does not fit into the renderer's memory");

    made.heights_view_ = gl::make_view(made.heights_.id(), GL_R32F);
    made.heights_view_id_ = made.heights_view_.id();
    if (Result<void> textured = made.set_texture(terrain.texture); !textured) return tl::unexpected(textured.error());
    if (Result<void> own = made.make_own(); !own) return tl::unexpected(own.error());
    return made;
}

Result<Drawing> Drawing::make(const Tiles& tiles) {
    uint64_t places = uint64_t(tiles.slot_count()) * kTileSamples;
    if (Result<void> fits = check_places(places, tiles.head()); !fits) return tl::unexpected(fits.error());
    Drawing made;
    made.set_head(tiles.head(), tiles.file().whole());
    made.is_tiled_ = true;
    made.sample_count_ = uint32_t(places);
    made.heights_ = make_room(places * sizeof(float));
    made.slots_ = make_room(tiles.slot_count() * sizeof(glm::uvec4));
    if (glGetError() == GL_OUT_OF_MEMORY) return impossible("the terrain's tiles do not fit into the renderer's memory");

    made.heights_view_ = gl::make_view(made.heights_.id(), GL_R32F);
    made.heights_view_id_ = made.heights_view_.id();
    made.slots_view_ = gl::make_view(made.slots_.id(), GL_RGBA32UI);
    if (Result<void> textured = made.set_texture(tiles.head().texture); !textured) return tl::unexpected(textured.error());
    if (Result<void> own = made.make_own(); !own) return tl::unexpected(own.error());
    for (uint32_t tile = 0; tile < tiles.grid().count(); ++tile)
        if (tiles.view(tile).heights != nullptr) made.take_tile(tiles, tile);
    return made;
}

void Drawing::take_tile(const Tiles& tiles, uint32_t tile) {
    const Tiles::View& view = tiles.view(tile);
    GridPlace from = tiles.grid().origin(tile);
    glm::uvec4 slot{from.x, from.y, tiles.grid().block(tile).level, 0};
    std::vector<float> above = above_base({view.heights, kTileSamples}, tiles.head().height_step_m, base_);
    GLsizeiptr bytes = GLsizeiptr(kTileSamples * sizeof(float));
    glNamedBufferSubData(heights_.id(), bytes * view.slot, bytes, above.data());
    glNamedBufferSubData(slots_.id(), GLintptr(view.slot * sizeof(slot)), sizeof(slot), &slot);
    tile_bytes_ += uint64_t(bytes) + sizeof(slot);
}

Result<Drawing> Drawing::sharing(const Drawing& first) {
    assert(!first.is_tiled_);
    Drawing made;
    made.width_ = first.width_;
    made.height_ = first.height_;
    made.sample_count_ = first.sample_count_;
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

std::string Drawing::vertex_source(const std::string& placed) const {
    return std::string(shaders::kTerrainVertexInputs) + (is_tiled_ ? shaders::kTileCells : shaders::kRasterCells) + placed +
           shaders::kTerrainVertexMain;
}

Result<gl::Program> Drawing::program(const gl::SurfaceShader& shader) const {
    std::string vertex = vertex_source(shader.vertex.empty() ? gl::shaders::kUnmoved : shader.vertex);
    std::string fragment = std::string(gl::shaders::kEncoding) + shaders::kAir + shaders::kTerrainFragment + shader.fragment;
    return gl::Program::make(shader.name, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}});
}

Result<void> Drawing::make_programs() {
    const std::string ground_source = std::string(gl::shaders::kEncoding) + shaders::kAir + shaders::kTerrainFragment;
    const std::string wireframe_source = ground_source + shaders::kWireframeMain;
    auto shaded = program({"terrain", "", gl::shaders::kShadedMain});
    if (!shaded) return tl::unexpected(shaded.error());
    auto wireframe = gl::Program::make("wireframe", {{GL_VERTEX_SHADER, vertex_source(gl::shaders::kUnmoved)},
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
    if (!is_tiled_) glUniform1ui(program.at("width"), width_);
    glUniform1ui(program.at("sample_count"), sample_count_);
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
    glUniform1f(program.at("haze_per_m"), float(haze_per_m(options)));
    glUniform1f(program.at("line_px"), float(options.line_px));
}

double Drawing::haze_per_m(const DrawOptions& options) const {
    return 0.5 * options.haze / std::hypot(metres_per_column_ * width_, metres_per_row_ * height_);
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

void Drawing::draw_with(const gl::Program& program, const view::Camera& camera, const DrawOptions& options, gl::TriangleRange range) {
    program.use();
    set_camera(program, camera, options);
    glBindVertexArray(vertices_.id());
    glBindTextureUnit(1, heights_view_id_);
    glBindTextureUnit(2, morphs_view_.id());
    if (is_tiled_) glBindTextureUnit(4, slots_view_.id());
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
    uploaded_bytes_ = indices.size_bytes() + cut.morphs.size() * sizeof(Cut::Morph) + std::exchange(tile_bytes_, 0);
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
