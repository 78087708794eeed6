#include "runtime/discrete/draw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "formats/srgb.h"
#include "runtime/discrete/draw_shaders.h"
#include "runtime/discrete/visibility.h"
#include "runtime/gl/background.h"
#include "runtime/gl/png.h"
#include "runtime/gl/surface_shaders.h"

namespace overlook::discrete {
namespace {

constexpr GLuint kVertices = 0, kItems = 1;  // where an array's attributes come from

// Lighter above the horizon than below: as behind meshes.
constexpr char kBackground[] = R"(
void main() {
    colour = vec4(mix(vec3(0.30, 0.33, 0.38), vec3(0.62, 0.68, 0.76), 0.5 + 0.5 * direction().z), 1.0);
}
)";

// As in draw_shaders.h.
struct PackedVisibility {
    uint32_t lookup = 0, width = 0, height = 0, depth = 0;
    float period_m = 1;
    uint32_t first = 0, pad[2] = {0, 0};
};

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& from) {
    return std::as_bytes(std::span(from));
}

enum class As { whole, number, share };  // of a whole number as it is, as it is but in floats, of its type's greatest

struct Attribute {
    GLuint location = 0, from = 0;
    GLint count = 0;
    GLenum type = GL_FLOAT;
    As as = As::number;
    size_t offset = 0;
};
// As in draw_shaders.h.
constexpr Attribute kAttributes[] = {
    {0, kVertices, 4, GL_UNSIGNED_SHORT, As::whole, offsetof(Vertex, position)},
    {1, kVertices, 2, GL_SHORT, As::share, offsetof(Vertex, normal)},
    {2, kVertices, 2, GL_UNSIGNED_SHORT, As::number, offsetof(Vertex, uv)},
    {3, kVertices, 4, GL_UNSIGNED_BYTE, As::share, offsetof(Vertex, colour)},
    {4, kItems, 4, GL_FLOAT, As::number, offsetof(PackedItem, place_m)},
    {5, kItems, 4, GL_FLOAT, As::number, offsetof(PackedItem, cosine)},
    {6, kItems, 4, GL_UNSIGNED_INT, As::whole, offsetof(PackedItem, id)},
    {7, kItems, 2, GL_FLOAT, As::number, offsetof(PackedItem, shift)},
    {8, kItems, 2, GL_UNSIGNED_INT, As::whole, offsetof(PackedItem, first_pose)},
    {9, kItems, 3, GL_FLOAT, As::number, offsetof(PackedItem, line)},
    {10, kItems, 1, GL_UNSIGNED_INT, As::whole, offsetof(PackedItem, side)},
};

void add_attribute(GLuint array, const Attribute& one) {
    glEnableVertexArrayAttrib(array, one.location);
    if (one.as == As::whole)
        glVertexArrayAttribIFormat(array, one.location, one.count, one.type, GLuint(one.offset));
    else
        glVertexArrayAttribFormat(array, one.location, one.count, one.type, one.as == As::share ? GL_TRUE : GL_FALSE,
                                  GLuint(one.offset));
    glVertexArrayAttribBinding(array, one.location, one.from);
}

}  // namespace

ListBuffers::ListBuffers() = default;

uint64_t ListBuffers::fill(const DrawList& list) {
    uint64_t bytes = 0;
    auto fill = [&](gl::StreamBuffer& buffer, std::span<const std::byte> from) {
        if (from.empty()) return;
        buffer.fill(from);
        bytes += from.size();
    };
    fill(items_, bytes_of(list.items));
    fill(commands_, bytes_of(list.commands));
    fill(poses_, bytes_of(list.poses));
    return bytes;
}

Result<Drawing> Drawing::make(const Chain& chain, uint32_t shading_rounds) {
    Drawing made;
    made.shading_rounds_ = shading_rounds;
    made.chain_ = &chain;
    made.layout_.origin_m = chain.origin_m;
    made.layout_.clip_s = is_animated(chain) ? chain.clip_s : 0;
    made.nothing_ = gl::make_vertex_array();
    if (Result<void> uploaded = made.upload_levels(); !uploaded) return tl::unexpected(uploaded.error());
    if (Result<void> looks = made.make_looks(); !looks) return tl::unexpected(looks.error());
    if (Result<void> uploaded = made.upload_visibilities(); !uploaded) return tl::unexpected(uploaded.error());
    if (Result<void> programs = made.make_programs(); !programs) return tl::unexpected(programs.error());
    if (glGetError() == GL_OUT_OF_MEMORY) return impossible("the chain does not fit into the renderer's memory");
    return made;
}

Result<void> Drawing::upload_levels() {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    uint64_t vertex_count = 0, index_count = 0;
    for (const Level& level : chain_->levels) vertex_count += level.vertices.size(), index_count += level.indices.size();
    if (std::max(vertex_count, index_count) > uint64_t(std::numeric_limits<int32_t>::max()))
        return impossible("a chain of {} vertices and {} indices is too large to draw at once", vertex_count, index_count);
    vertices.reserve(vertex_count), indices.reserve(index_count);
    for (const Level& level : chain_->levels) {
        ChainLayout::LevelRuns& runs = layout_.levels.emplace_back();
        runs.base_vertex = int32_t(vertices.size());
        runs.is_plain = level.is_plain;
        for (const Draw& draw : level.draws)
            runs.runs.push_back({draw.surface, uint32_t(indices.size()) + draw.first_index, draw.index_count});
        vertices.insert(vertices.end(), level.vertices.begin(), level.vertices.end());
        indices.insert(indices.end(), level.indices.begin(), level.indices.end());
    }
    if (vertices.empty()) vertices.emplace_back();
    if (indices.empty()) indices.emplace_back();
    vertices_ = gl::make_buffer(bytes_of(vertices));
    indices_ = gl::make_buffer(bytes_of(indices));
    bytes_ += bytes_of(vertices).size() + bytes_of(indices).size();

    array_ = gl::make_vertex_array();
    GLuint array = array_.id();
    glVertexArrayVertexBuffer(array, kVertices, vertices_.id(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(array, indices_.id());
    for (const Attribute& one : kAttributes) add_attribute(array, one);
    glVertexArrayBindingDivisor(array, kItems, 1);
    return {};
}

Result<void> Drawing::make_looks() {
    for (const caveclod::Surface& surface : chain_->surfaces) {
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
        bytes_ += picture.pixels.size();
        Look look;
        look.picture = std::move(*texture);
        look.colour = {float(linear_from_srgb_code(surface.colour[0])), float(linear_from_srgb_code(surface.colour[1])),
                       float(linear_from_srgb_code(surface.colour[2])), float(surface.colour[3]) / 255};
        if (surface.is_alpha_masked) look.alpha_cutoff = surface.alpha_cutoff;
        look.is_picture = looks_.size() >= chain_->surfaces.size() - chain_->picture_count;
        look.is_two_sided = chain_->surfaces[looks_.size()].is_two_sided;
        looks_.push_back(std::move(look));
    }
    return {};
}

Result<void> Drawing::upload_visibilities() {
    std::vector<PackedVisibility> table;
    std::vector<uint8_t> values;
    for (const Visibility& one : visibilities_of(*chain_)) {
        // One for all changes is stored once.
        bool is_shared = chain_->visibility.size() <= 1 && !table.empty();
        uint32_t first = is_shared ? table.front().first : uint32_t(values.size());
        table.push_back({uint32_t(one.lookup), one.width, one.height, one.depth, one.period_m, first, {0, 0}});
        if (!is_shared) values.insert(values.end(), one.values.begin(), one.values.end());
        layout_.visibilities.push_back(one);
        layout_.visibilities.back().values.clear();
    }
    values.resize((values.size() + 3) / 4 * 4);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (values.size() / 4 > size_t(most))
        return impossible("visibilities of {} values are too large for this renderer ({} at most)", values.size(),
                          4 * uint64_t(most));
    visibilities_ = gl::make_buffer(bytes_of(table));
    values_ = gl::make_buffer(bytes_of(values));
    visibility_view_ = gl::make_view(visibilities_.id(), GL_RGBA32UI);
    value_view_ = gl::make_view(values_.id(), GL_R32UI);
    bytes_ += bytes_of(table).size() + values.size();
    return {};
}

std::vector<double> Drawing::grain_m() const {
    std::vector<double> grains;
    for (const Visibility& one : layout_.visibilities)
        grains.push_back(one.lookup == Visibility::Lookup::paper ? double(one.period_m) / std::max(one.width, one.height) : 0);
    return grains;
}

Result<gl::Program> Drawing::program(const std::string& name, const std::string& defines, const std::string& main) const {
    std::string vertex = std::string("#version 450 core\n") + shaders::kItemInputs + shaders::kVertex;
    std::string fragment = std::string(gl::shaders::kEncoding) + fmt::format("#define SHADING_ROUNDS {}\n", shading_rounds_) +
                           defines + shaders::kItem + shaders::kFragment + shaders::kVisibility + main;
    return gl::Program::make(name, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}});
}

Result<void> Drawing::make_programs() {
    Result<gl::Program> shaded = program("levels", "", std::string(shaders::kDoor) + shaders::kOnePictureMain);
    if (!shaded) return tl::unexpected(shaded.error());
    std::string behind = std::string(gl::shaders::kBackgroundDirection) + kBackground;
    auto background =
        gl::Program::make("background", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, behind}});
    if (!background) return tl::unexpected(background.error());
    one_picture_ = std::move(*shaded);
    background_ = std::move(*background);
    return {};
}

void Drawing::draw_calls(const gl::Program& program, const ListBuffers& buffers, const DrawList& list,
                         std::span<const Call> calls, const DrawOptions& options) const {
    if (calls.empty()) return;
    const view::Camera& camera = list.camera;
    view::Part part = options.part.value_or(view::Part{0, 0, camera.width_px, camera.height_px});
    view::PartMap map = view::part_map(camera, part);
    glm::mat4 clip_from_relative = view::projection(camera) * view::rotation(camera);
    program.use();
    glUniform4f(program.at("part"), float(map.scale.x), float(map.scale.y), float(map.shift.x), float(map.shift.y));
    glUniform1f(program.at("step_m"), float(chain_->position_step_m));
    glUniform2f(program.at("uv_low"), float(chain_->uv_low.x), float(chain_->uv_low.y));
    glUniform1f(program.at("uv_step"), float(chain_->uv_step));
    glUniform1i(program.at("is_animated"), layout_.clip_s > 0 ? 1 : 0);
    glUniform1i(program.at("has_normals"), chain_->attributes.normals ? 1 : 0);
    glUniformMatrix4fv(program.at("clip_from_relative"), 1, GL_FALSE, glm::value_ptr(clip_from_relative));
    if (layout_.clip_s > 0) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers.poses_.id());
    glBindTextureUnit(1, visibility_view_.id());
    glBindTextureUnit(2, value_view_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffers.commands_.id());
    glVertexArrayVertexBuffer(array_.id(), kItems, buffers.items_.id(), 0, sizeof(PackedItem));
    glBindVertexArray(array_.id());
    for (const Call& call : calls) {
        const Look& look = looks_[call.surface];
        glBindTextureUnit(0, look.picture.id());
        glUniform4fv(program.at("base_colour"), 1, glm::value_ptr(look.colour));
        glUniform1f(program.at("alpha_cutoff"), look.alpha_cutoff);
        glUniform1i(program.at("is_card"), look.is_picture ? 1 : 0);
        glUniform1i(program.at("is_two_sided"), look.is_two_sided ? 1 : 0);
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(sizeof(Command) * size_t(call.first_command)),
                                    GLsizei(call.command_count), 0);
    }
}

void Drawing::draw_background(const view::Camera& camera, const DrawOptions& options) const {
    view::Part part = options.part.value_or(view::Part{0, 0, camera.width_px, camera.height_px});
    gl::draw_background(background_, camera, part, nothing_);
}

uint64_t draw(const gl::Target& target, std::span<const Drawn> parts, const DrawOptions& options) {
    target.bind();
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    if (options.is_wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    uint64_t call_count = 1;
    std::vector<const DrawList*> lists;
    for (const Drawn& part : parts) {
        part.drawing->draw_calls(part.drawing->one_picture(), *part.buffers, *part.list, part.list->whole_calls, options);
        call_count += part.list->whole_calls.size();
        lists.push_back(part.list);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    parts.front().drawing->draw_background(lists.front()->camera, options);
    std::vector<ListedCalls> translucent = translucent_calls(lists);
    if (!translucent.empty()) {
        // Over what is there, at the same depth as well; nothing translucent hides anything (Giegl and Wimmer 2007).
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_GEQUAL);
        for (const ListedCalls& one : translucent) {
            const Drawn& part = parts[one.list];
            part.drawing->draw_calls(part.drawing->one_picture(), *part.buffers, *part.list, one.calls, options);
            call_count += one.calls.size();
        }
        glDepthFunc(GL_GREATER);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    target.resolve();
    return call_count;
}

}  // namespace overlook::discrete
