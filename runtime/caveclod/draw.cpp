#include "runtime/caveclod/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "formats/srgb.h"
#include "runtime/caveclod/draw_shaders.h"
#include "runtime/gl/background.h"
#include "runtime/gl/png.h"
#include "runtime/gl/surface_shaders.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kPageBytes = 3 * kPageFaces * sizeof(uint32_t);

gl::Buffer new_buffer(size_t pages) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    gl::Buffer buffer(id);
    glNamedBufferData(id, GLsizeiptr(pages * kPageBytes), nullptr, GL_DYNAMIC_DRAW);
    return buffer;
}

view::Part part_of(const view::Camera& camera, const DrawOptions& options) {
    return options.part.value_or(view::Part{0, 0, camera.width_px, camera.height_px});
}

// What of a range lies among the next face_count; the range goes on behind them.
gl::TriangleRange take_from(gl::TriangleRange& range, uint64_t face_count) {
    gl::TriangleRange part{std::min(range.first, face_count), 0};
    part.count = std::min(range.count, face_count - part.first);
    range.first -= part.first;
    range.count -= part.count;
    return part;
}

}  // namespace

CameraBuffers::CameraBuffers(const Mesh& mesh) : surfaces_(mesh.surface_count()) {
    const GlideVertex none{};
    glides_.fill(std::as_bytes(std::span(&none, 1)));
    glides_view_ = gl::make_view(glides_.id(), GL_RGB32UI);
}

void CameraBuffers::take_surface(const FaceSlots& faces, uint32_t surface) {
    Indices& indices = surfaces_[surface];
    auto pages = faces.pages(surface);
    bool is_new = pages.size() > indices.capacity_pages;
    if (is_new) {
        indices.capacity_pages = pages.size() + pages.size() / 4;
        indices.buffer = new_buffer(indices.capacity_pages);
    }
    for (uint32_t p = 0; p < pages.size(); ++p) {
        const FacePage& page = *pages[p];
        uint32_t begin = is_new ? 0 : page.dirty_begin;
        uint32_t end = is_new ? faces.page_count(surface, p) : std::min<uint32_t>(page.dirty_end, faces.page_count(surface, p));
        if (begin >= end) continue;
        size_t bytes = 3 * sizeof(uint32_t) * (end - begin);
        glNamedBufferSubData(indices.buffer.id(), GLintptr(p * kPageBytes + 3 * sizeof(uint32_t) * begin), GLsizeiptr(bytes),
                             page.indices.data() + 3 * size_t(begin));
        uploaded_bytes_ += bytes;
    }
    indices.face_count = faces.face_count(surface);
}

void CameraBuffers::take(Refinement& refinement) {
    uploaded_bytes_ = 0;
    for (uint32_t surface = 0; surface < surfaces_.size(); ++surface) take_surface(refinement.faces(), surface);
    static_assert(sizeof(GlideVertex) == 24);  // two texels
    auto glides = std::as_bytes(refinement.glide_vertices());
    if (!glides.empty()) glides_.fill(glides);
    uploaded_bytes_ += glides.size();
    refinement.clear_dirty();
}

void CameraBuffers::take(std::span<const std::vector<uint32_t>> by_surface) {
    uploaded_bytes_ = 0;
    for (size_t surface = 0; surface < surfaces_.size(); ++surface) {
        const std::vector<uint32_t>& from = by_surface[surface];
        Indices& indices = surfaces_[surface];
        indices.face_count = uint32_t(from.size() / 3);
        if (from.empty()) continue;
        size_t bytes = from.size() * sizeof(uint32_t), pages = (bytes + kPageBytes - 1) / kPageBytes;
        if (pages > indices.capacity_pages) {
            indices.capacity_pages = pages;
            indices.buffer = new_buffer(pages);
        }
        glNamedBufferSubData(indices.buffer.id(), 0, GLsizeiptr(bytes), from.data());
        uploaded_bytes_ += bytes;
    }
}

uint64_t CameraBuffers::draw_call_count(gl::TriangleRange range) const {
    uint64_t calls = 0;
    for (const Indices& indices : surfaces_) calls += take_from(range, indices.face_count).count > 0;
    return calls;
}

uint64_t CameraBuffers::triangle_count() const {
    uint64_t count = 0;
    for (const Indices& indices : surfaces_) count += indices.face_count;
    return count;
}

Result<Drawing> Drawing::make(const Mesh& mesh) {
    Drawing made;
    made.origin_m_ = mesh.origin_m(), made.grid_ = mesh.grid(), made.glide_begin_ = mesh.glide_begin();
    if (Result<uint64_t> taken = made.take_vertices(mesh); !taken) return tl::unexpected(taken.error());
    made.grid_.normal_bits = mesh.attributes().normals ? made.grid_.normal_bits : 0;
    made.has_colours_ = made.colours_.id() != 0;
    made.nothing_ = gl::make_vertex_array();
    if (Result<void> looks = made.make_looks(mesh); !looks) return tl::unexpected(looks.error());
    if (Result<void> programs = made.make_programs(); !programs) return tl::unexpected(programs.error());
    return made;
}

Result<Drawing> Drawing::sharing(const Drawing& first) {
    Drawing made;
    made.origin_m_ = first.origin_m_, made.grid_ = first.grid_, made.glide_begin_ = first.glide_begin_;
    made.has_colours_ = first.has_colours_;
    made.first_ = &first;
    made.nothing_ = gl::make_vertex_array();
    if (Result<void> programs = made.make_programs(); !programs) return tl::unexpected(programs.error());
    return made;
}

// What was uploaded stays, as far as there is room.
void Drawing::resize_buffers(uint32_t capacity, bool has_colours) {
    auto resize = [&](gl::Buffer& buffer, gl::Texture& view, size_t vertex_bytes, GLenum format) {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        gl::Buffer resized(id);
        glNamedBufferStorage(id, GLsizeiptr(capacity * vertex_bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
        if (vertex_count_ > 0) glCopyNamedBufferSubData(buffer.id(), id, 0, 0, GLsizeiptr(vertex_count_ * vertex_bytes));
        buffer = std::move(resized);
        view = gl::make_view(buffer.id(), format);
    };
    resize(vertices_, vertices_view_, sizeof(PackedVertex), GL_RGBA32UI);
    if (has_colours) resize(colours_, colours_view_, sizeof(uint32_t), GL_R32UI);
    capacity_ = capacity;
}

Result<uint64_t> Drawing::take_vertices(const Mesh& mesh) {
    uint32_t count = mesh.vertex_count(), before = std::min(vertex_count_, count);
    GLint most_texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_texels);
    if (count > uint32_t(most_texels))
        return impossible("a mesh of {} vertices is too large to draw at once ({} at most)", count, most_texels);
    vertex_count_ = before;
    if (count > capacity_ || count < capacity_ / 2) {
        // One that is there as a whole never grows.
        uint32_t more = count < mesh.glide_begin() ? count / 4 : 0;
        resize_buffers(std::min({count + more, mesh.glide_begin(), uint32_t(most_texels)}), !mesh.colours().empty());
    }
    if (count == before) return 0;
    auto upload = [&](const gl::Buffer& buffer, auto all) {
        auto fresh = std::as_bytes(all.subspan(before));
        glNamedBufferSubData(buffer.id(), GLintptr(before * sizeof(all[0])), GLsizeiptr(fresh.size()), fresh.data());
        return uint64_t(fresh.size());
    };
    uint64_t bytes = upload(vertices_, mesh.vertices());
    if (!mesh.colours().empty()) bytes += upload(colours_, mesh.colours());
    vertex_count_ = count;
    if (glGetError() == GL_OUT_OF_MEMORY) return impossible("the mesh does not fit into the renderer's memory");
    return bytes;
}

Result<void> Drawing::make_looks(const Mesh& mesh) {
    for (const caveclod::Surface& surface : mesh.surfaces()) {
        ImageRgba8 picture{1, 1, {255, 255, 255, 255}};
        if (!surface.texture_bytes.empty()) {
            Result<ImageRgba8> decoded = decode_png(surface.texture, surface.texture_bytes);
            if (!decoded)
                faults_.push_back(decoded.error().message);
            else
                picture = std::move(*decoded);
        }
        Result<gl::Texture> texture =
            surface.is_alpha_masked ? gl::make_masked_texture(picture, surface.alpha_cutoff) : gl::make_texture(picture);
        if (!texture) return impossible("{}: {}", surface.texture, texture.error().message);
        Look look;
        look.picture = std::move(*texture);
        look.colour = {float(linear_from_srgb_code(surface.colour[0])), float(linear_from_srgb_code(surface.colour[1])),
                       float(linear_from_srgb_code(surface.colour[2])), float(surface.colour[3]) / 255};
        if (surface.is_alpha_masked) look.alpha_cutoff = surface.alpha_cutoff;
        look.is_two_sided = surface.is_two_sided;
        looks_.push_back(std::move(look));
    }
    return {};
}

Result<void> Drawing::make_programs() {
    auto shaded = program({"mesh", "", gl::shaders::kShadedMain});
    if (!shaded) return tl::unexpected(shaded.error());
    std::string behind = std::string(gl::shaders::kBackgroundDirection) + shaders::kBackgroundFragment;
    auto background =
        gl::Program::make("background", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, behind}});
    if (!background) return tl::unexpected(background.error());
    shaded_ = std::move(*shaded);
    background_ = std::move(*background);
    return {};
}

Result<gl::Program> Drawing::program(const gl::SurfaceShader& shader) const {
    std::string vertex =
        shaders::kMeshVertexInputs + (shader.vertex.empty() ? gl::shaders::kUnmoved : shader.vertex) + shaders::kMeshVertexMain;
    std::string fragment = std::string(gl::shaders::kEncoding) + shaders::kMeshFragment + shader.fragment;
    return gl::Program::make(shader.name, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}});
}

void Drawing::set_camera(const gl::Program& program, const view::Camera& camera, const DrawOptions& options) const {
    constexpr double kFarthestStep = 1 << 30;
    glm::dvec3 place = (camera.position_m - options.origin_m - origin_m_) / grid_.position_step_m;
    glm::dvec3 whole = glm::clamp(glm::floor(place), -kFarthestStep, kFarthestStep), rest = place - whole;
    glm::mat4 clip_from_relative = view::projection(camera) * view::rotation(camera);
    view::PartMap map = view::part_map(camera, part_of(camera, options));
    glUniform4f(program.at("part"), float(map.scale.x), float(map.scale.y), float(map.shift.x), float(map.shift.y));
    glUniform1ui(program.at("glide_begin"), glide_begin_);
    glUniform1ui(program.at("low_bits"), grid_.position_bits > 16 ? grid_.position_bits - 16 : 0);
    glUniform1i(program.at("has_colours"), has_colours_ ? 1 : 0);
    glUniform3i(program.at("camera_steps"), GLint(whole.x), GLint(whole.y), GLint(whole.z));
    glUniform3f(program.at("camera_rest"), float(rest.x), float(rest.y), float(rest.z));
    glUniform1f(program.at("step_m"), float(grid_.position_step_m));
    glUniform2f(program.at("uv_low"), float(grid_.uv_low.x), float(grid_.uv_low.y));
    glUniform1f(program.at("uv_step"), float(grid_.uv_step));
    glUniform1i(program.at("has_normals"), grid_.normal_bits > 0 ? 1 : 0);
    glUniform1f(program.at("normal_step"), grid_.normal_bits > 0 ? 1.0f / float((1u << (grid_.normal_bits - 1)) - 1) : 1.0f);
    glUniformMatrix4fv(program.at("clip_from_relative"), 1, GL_FALSE, glm::value_ptr(clip_from_relative));
}

void Drawing::draw_with(const gl::Program& program, const CameraBuffers& buffers, const view::Camera& camera,
                        const DrawOptions& options, gl::TriangleRange range) const {
    const Drawing& on_card = first_ != nullptr ? *first_ : *this;
    program.use();
    set_camera(program, camera, options);
    glBindTextureUnit(1, on_card.vertices_view_.id());
    glBindTextureUnit(2, buffers.glides_view_.id());
    glBindTextureUnit(3, has_colours_ ? on_card.colours_view_.id() : on_card.vertices_view_.id());
    glBindVertexArray(nothing_.id());
    for (size_t i = 0; i < on_card.looks_.size(); ++i) {
        const CameraBuffers::Indices& indices = buffers.surfaces_[i];
        gl::TriangleRange part = take_from(range, indices.face_count);
        if (part.count == 0) continue;
        const Look& look = on_card.looks_[i];
        if (options.culls_back_faces && !look.is_two_sided)
            glEnable(GL_CULL_FACE);
        else
            glDisable(GL_CULL_FACE);
        glBindTextureUnit(0, look.picture.id());
        glUniform4fv(program.at("base_colour"), 1, glm::value_ptr(look.colour));
        glUniform1f(program.at("alpha_cutoff"), look.alpha_cutoff);
        glVertexArrayElementBuffer(nothing_.id(), indices.buffer.id());
        glDrawElements(GL_TRIANGLES, GLsizei(3 * part.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(3 * sizeof(uint32_t) * part.first));
    }
    glDisable(GL_CULL_FACE);
}

void Drawing::draw_background(const view::Camera& camera, const DrawOptions& options) const {
    gl::draw_background(background_, camera, part_of(camera, options), nothing_);
}

void Drawing::draw(const gl::Target& target, const CameraBuffers& buffers, const view::Camera& camera,
                   const DrawOptions& options) const {
    target.bind();
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    if (options.is_wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    draw_with(shaded_, buffers, camera, options);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    draw_background(camera, options);
    target.resolve();
}

}  // namespace overlook::caveclod
