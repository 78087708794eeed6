#include "runtime/wang_ldi/draw_splats.h"

#include <limits>
#include <string>

#include "runtime/wang_ldi/brush.h"
#include "runtime/wang_ldi/draw_splats_shaders.h"
#include "runtime/wang_ldi/hole_fill.h"
#include "runtime/wang_ldi/splat_lists.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kInGroup = 128, kMostGroups = 65535;

std::string source_of(bool in_one_round, const std::string& rest) {
    return "#version 450 core\n" + std::string(in_one_round ? shaders::kOneRoundExtensions : "") + rest;
}
Result<gl::Program> program_of(bool in_one_round, const std::string& rest) {
    std::string source = source_of(in_one_round, rest);
    return gl::Program::make("splats", {{GL_COMPUTE_SHADER, source}});
}

template <class Value>
std::span<const std::byte> bytes_of(const std::vector<Value>& values) {
    return std::as_bytes(std::span(values));
}

gl::Buffer make_empty(size_t bytes) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, GLsizeiptr(bytes), nullptr, 0);
    return gl::Buffer(id);
}
void fill_with_ones(GLuint buffer) {
    uint32_t ones = std::numeric_limits<uint32_t>::max();
    glClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &ones);
}

// By one invocation each.
void dispatch(uint32_t count) {
    uint32_t groups = (count + kInGroup - 1) / kInGroup;
    glDispatchCompute(std::min(groups, kMostGroups), (groups + kMostGroups - 1) / kMostGroups, 1);
}

void set_view(const gl::Program& program, const view::Camera& camera, uint32_t finer) {
    program.use();
    glUniform2i(program.at("size_px"), GLint(camera.width_px), GLint(camera.height_px));
    Eye eye(camera, finer);
    glUniform2f(program.at("middle_px"), eye.middle_px.x, eye.middle_px.y);
    glUniform1f(program.at("near_m"), eye.near_m);
    glUniform1i(program.at("most_splat_px"), eye.most_splat_px);
}

}  // namespace

Result<Splats> Splats::make(bool in_one_round) {
    Splats made;
    made.is_in_one_round_ =
        in_one_round && epoxy_has_gl_extension("GL_ARB_gpu_shader_int64") && epoxy_has_gl_extension("GL_NV_shader_atomic_int64");
    bool is_one = made.is_in_one_round_;
    std::vector<std::string> rounds{is_one ? shaders::kOneRound : shaders::kDepthRound};
    if (!is_one) rounds.push_back(shaders::kColourRound);
    for (const std::string& round : rounds) {
        std::string head = shaders::kSplatHead + round + shaders::kSplat;
        Result<gl::Program> images = program_of(is_one, head + shaders::kImage),
                            points = program_of(is_one, head + shaders::kPoints);
        if (!images) return tl::unexpected(images.error());
        if (!points) return tl::unexpected(points.error());
        made.images_.push_back(std::move(*images)), made.points_.push_back(std::move(*points));
    }
    Result<gl::Program> read_out =
        program_of(false, std::string(is_one ? shaders::kReadOne : shaders::kReadTwo) + shaders::kReadOut);
    if (!read_out) return tl::unexpected(read_out.error());
    made.read_out_ = std::move(*read_out);
    made.filled_ = make_empty(sizeof(uint32_t));
    return made;
}

const Splats::Image& Splats::image(uint64_t index, const PreparedLdi& prepared, SplatCounts& counts) {
    Image& image = kept_[index];
    if (image.of == &prepared) return image;
    std::vector<uint32_t> words = splat_words(prepared);
    image.of = &prepared, image.bytes = words.size() * sizeof(uint32_t);
    image.buffer = gl::make_buffer(bytes_of(words));
    counts.uploaded_bytes += image.bytes;
    return image;
}

void Splats::let_go(const PreparedAt& image_at) {
    std::erase_if(kept_, [&](const auto& one) { return image_at(one.first) != one.second.of; });
}

void Splats::begin(uint32_t width_px, uint32_t height_px) {
    size_t pixels = size_t(width_px) * height_px;
    if (width_px != width_px_ || height_px != height_px_) {
        width_px_ = width_px, height_px_ = height_px;
        pixels_ = make_empty(pixels * (is_in_one_round_ ? sizeof(uint64_t) : sizeof(uint32_t)));
        if (!is_in_one_round_) colours_ = make_empty(pixels * sizeof(uint32_t));
    }
    fill_with_ones(pixels_.id());
    if (!is_in_one_round_) fill_with_ones(colours_.id());
    uint32_t none = 0;
    glClearNamedBufferData(filled_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
}

void Splats::round(const gl::Program& images, const gl::Program& points, const std::vector<One>& draws, uint32_t point_count,
                   const view::Camera& camera, uint32_t finer) const {
    set_view(images, camera, finer);
    GLint draw_index = images.at("draw_index");
    for (size_t d = 0; d < draws.size(); ++d) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, draws[d].buffer);
        glUniform1ui(draw_index, GLuint(d));
        dispatch(draws[d].sample_count);
    }
    if (point_count == 0) return;
    set_view(points, camera, finer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, loose_.id());
    glUniform1ui(points.at("point_count"), point_count);
    dispatch(point_count);
}

SplatCounts Splats::draw(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                         bool fills_holes, const FarImages* far, Composite& into, uint32_t finer) {
    SplatCounts counts;
    let_go(image_at);
    SplatLists lists = splat_lists_of(camera, field, list, image_at, far, finer);
    counts.images_missing = lists.images_missing, counts.samples = lists.points.size();
    std::vector<One> draws;
    for (size_t d = 0; d < lists.draws.size(); ++d) {
        const Image& kept = image(lists.images[d], *image_at(lists.images[d]), counts);
        draws.push_back({kept.buffer.id(), lists.draws[d].sample_count});
        counts.samples += lists.draws[d].sample_count;
    }
    begin(camera.width_px, camera.height_px);
    if (!lists.draws.empty()) draws_.fill(bytes_of(lists.draws)), planes_.fill(bytes_of(lists.planes));
    if (!lists.points.empty()) loose_.fill(bytes_of(lists.points));
    counts.uploaded_bytes += bytes_of(lists.draws).size() + bytes_of(lists.planes).size() + bytes_of(lists.points).size();

    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, pixels_.id());
    if (!is_in_one_round_) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, colours_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, draws_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, planes_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, filled_.id());
    for (size_t r = 0; r < images_.size(); ++r) {
        round(images_[r], points_[r], draws, uint32_t(lists.points.size()), camera, finer);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    into.fit(camera.width_px, camera.height_px);
    set_view(read_out_, camera, finer);
    glUniform1i(read_out_.at("widest_px"), fills_holes ? GLint(kWidestHole_px * finer) : 0);
    glBindImageTexture(0, into.colours(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
    glBindImageTexture(1, into.depths(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    glDispatchCompute((camera.width_px + 7) / 8, (camera.height_px + 7) / 8, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    return counts;
}

uint64_t Splats::holes_filled() const {
    uint32_t filled = 0;
    glGetNamedBufferSubData(filled_.id(), 0, sizeof filled, &filled);
    return filled;
}

uint64_t Splats::bytes() const {
    uint64_t bytes = 0;
    for (const auto& [index, image] : kept_) bytes += image.bytes;
    return bytes;
}

}  // namespace overlook::wang_ldi
