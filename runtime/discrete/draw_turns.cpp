#include "runtime/discrete/draw_turns.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/discrete/draw_shaders.h"
#include "runtime/discrete/draw_turn_shaders.h"
#include "runtime/gl/surface_shaders.h"

namespace overlook::discrete {
namespace {

constexpr int kTileMargin_px = 1;

std::string define(const char* name, int value) {
    return fmt::format("#define {} {}\n", name, value);
}

gl::Texture make_texture(GLenum format, const gl::Target& target) {
    GLuint id = 0;
    GLsizei width = GLsizei(target.width_px()), height = GLsizei(target.height_px());
    if (target.samples() > 1) {
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &id);
        glTextureStorage2DMultisample(id, GLsizei(target.samples()), format, width, height, GL_TRUE);
    } else {
        glCreateTextures(GL_TEXTURE_2D, 1, &id);
        glTextureStorage2D(id, 1, format, width, height);
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    return gl::Texture(id);
}

// Something under way: of which chain, and how near its middle is.
struct Near {
    const UnderWay* chain = nullptr;
    Fading fading;
    glm::dvec3 from_eye_m{0};
};

std::vector<Near> nearest_first(std::span<const UnderWay> chains, const view::Camera& camera) {
    std::vector<Near> all;
    for (const UnderWay& chain : chains) {
        for (const Fading& fading : chain.frame->fading) {
            all.push_back({&chain, fading, chain.now[fading.instance].at(chain.facts->middle_m) - camera.position_m});
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Near& a, const Near& b) {
        return glm::dot(a.from_eye_m, a.from_eye_m) < glm::dot(b.from_eye_m, b.from_eye_m);
    });
    return all;
}

PackedMoved packed(uint32_t id, const Fading& fading, const Reprojection& moved, const Extent& extent) {
    PackedMoved made;
    made.old_from_new = moved.old_from_new, made.new_from_old = moved.new_from_old;
    made.id = id, made.from = fading.transition.from, made.to = fading.transition.to;
    made.phase = float(fading.transition.phase);
    made.near_z = extent.near_z, made.far_z = extent.far_z;
    return made;
}

}  // namespace

Combination combination_of(const FrameOptions& options, std::span<const UnderWay> chains, const view::Camera& old_camera,
                           const view::Camera& new_camera) {
    Combination made;
    const Placement still;
    if (options.reprojects) made.camera = reprojection(old_camera, still, new_camera, still);
    if (options.variant == Variant::fsi_paper) return made;
    std::vector<Extent> extents;
    for (const auto& [chain, fading, from_eye_m] : nearest_first(chains, new_camera)) {
        const Placement &before = chain->before[fading.instance], &now = chain->now[fading.instance];
        extents.push_back(extent_of(new_camera, from_eye_m, chain->facts->radius_m * now.scale, kTileMargin_px));
        bool has_own = options.reprojects && options.remedies.moves_instances && before != now;
        Reprojection moved = has_own ? reprojection(old_camera, before, new_camera, now) : made.camera;
        made.moved.push_back(packed(chain->first_instance + fading.instance + 1, fading, moved, extents.back()));
    }
    made.tiles = tiles_of(new_camera, extents);
    return made;
}

Result<Turns> Turns::make(const Drawing& drawing, const FrameOptions& options) {
    Turns made;
    made.options_ = options;
    made.nothing_ = gl::make_vertex_array();
    bool is_paper = options.variant == Variant::fsi_paper;
    std::string defines = define("KEEPS_HIDDEN", options.remedies.keeps_hidden);
    auto turn = drawing.program("turn", defines, is_paper ? shaders::kPaperTurnMain : shaders::kTurnMain);
    if (!turn) return tl::unexpected(turn.error());
    made.turn_ = std::move(*turn);
    return made;
}

Result<gl::Program> Turns::combine_program(uint32_t samples) const {
    const Remedies& remedies = options_.remedies;
    std::string text = "#version 450 core\n" + define("SAMPLES", int(samples)) + define("KMOST", int(Tiles::kMost)) +
                       define("TILE_PX", int(Tiles::kSide_px)) + define("KEEPS_HIDDEN", remedies.keeps_hidden) +
                       define("SEARCHES", remedies.searches) + define("WEIGHS_BY_PHASE", remedies.weighs_by_phase) +
                       define("HAS_LONG_RAMPS", remedies.has_long_ramps && remedies.weighs_by_phase) +
                       define("HAS_WIDE_IDS", remedies.has_wide_ids) + define("HAS_WIDE_DEPTH", remedies.has_wide_depth) +
                       shaders::kBuffers;
    if (options_.variant == Variant::fsi_paper)
        text += shaders::kPaperCombination;
    else
        text += std::string(shaders::kCombinationInputs) + shaders::kCombinationParts + shaders::kCombinationMain;
    return gl::Program::make("combination", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, text}});
}

Result<Turns::Buffer> Turns::make_buffer(const gl::Target& target) const {
    bool is_paper = options_.variant == Variant::fsi_paper;
    GLenum numbers = !is_paper ? GL_RG32UI : options_.is_half_precise ? GL_RG16F : GL_RG32F;
    Buffer made;
    made.colour = make_texture(GL_RGBA8, target);
    made.ids = make_texture(numbers, target);
    made.depth = make_texture(GL_DEPTH_COMPONENT32F, target);
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    made.framebuffer = gl::Framebuffer(id);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, made.colour.id(), 0);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT1, made.ids.id(), 0);
    glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, made.depth.id(), 0);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(id, 2, both);
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return impossible("this renderer cannot draw colours and ids of {} x {} pixels with {} samples", target.width_px(),
                          target.height_px(), target.samples());
    }
    return made;
}

Result<Turns::Pair*> Turns::pair_for(const gl::Target& target) {
    auto found = pairs_.find(target.samples());
    if (found != pairs_.end()) {
        Pair& pair = found->second;
        if (pair.width_px == target.width_px() && pair.height_px == target.height_px()) return &pair;
        pairs_.erase(found);
    }
    Pair pair;
    pair.width_px = target.width_px(), pair.height_px = target.height_px(), pair.samples = target.samples();
    for (Buffer& buffer : pair.buffers) {
        Result<Buffer> made = make_buffer(target);
        if (!made) return tl::unexpected(made.error());
        buffer = std::move(*made);
    }
    Result<gl::Program> combine = combine_program(pair.samples);
    if (!combine) return tl::unexpected(combine.error());
    pair.combine = std::move(*combine);
    return &pairs_.emplace(target.samples(), std::move(pair)).first->second;
}

uint64_t Turns::bytes(uint32_t samples) const {
    bool is_small = options_.variant == Variant::fsi_paper && options_.is_half_precise;
    uint64_t sample_bytes = 4 + (is_small ? 4 : 8) + 4;
    auto found = pairs_.find(samples);
    if (found == pairs_.end()) return 0;
    return 2 * sample_bytes * samples * found->second.width_px * found->second.height_px;
}

uint64_t Turns::fill(const Pair& pair, Buffer& buffer, const DrawOptions& look, uint64_t frame, std::span<const TurnPart> parts,
                     const DrawList* TurnPart::*list, uint64_t& uploaded_bytes) {
    gl::bind_for_drawing(buffer.framebuffer.id(), pair.width_px, pair.height_px);
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    if (options_.variant == Variant::fsi_paper) {
        const GLfloat nothing[4] = {1, 0, 0, 0};
        glClearBufferfv(GL_COLOR, 1, nothing);
    } else {
        const GLuint nothing[4] = {0, 0, 0, 0};
        glClearBufferuiv(GL_COLOR, 1, nothing);
    }
    while (lists_.size() < parts.size()) lists_.emplace_back();
    uint64_t call_count = 1;
    if (look.is_wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    for (size_t i = 0; i < parts.size(); ++i) {
        const DrawList& from = *(parts[i].*list);
        uploaded_bytes += lists_[i].fill(from);
        parts[i].drawing->draw_calls(turn_, lists_[i], from, from.whole_calls, {});
        call_count += from.whole_calls.size();
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    parts.front().drawing->draw_background((parts.front().*list)->camera, {});
    glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    buffer.frame = frame;
    return call_count;
}

Result<uint64_t> Turns::draw(const gl::Target& target, const DrawOptions& look, uint64_t frame, std::span<const TurnPart> parts,
                             bool has_before, const Combination& combination, uint64_t& uploaded_bytes) {
    Result<Pair*> found = pair_for(target);
    if (!found) return tl::unexpected(found.error());
    Pair& pair = **found;
    Buffer& newer = pair.buffers[frame % 2];
    Buffer& older = pair.buffers[(frame + 1) % 2];
    uint64_t calls = 0;
    // A target that was not drawn into the last time.
    const view::Camera& old_camera = parts.front().before->camera;
    bool has_older = has_before && old_camera.width_px == pair.width_px && old_camera.height_px == pair.height_px;
    if (has_older && older.frame + 1 != frame)
        calls += fill(pair, older, look, frame - 1, parts, &TurnPart::before, uploaded_bytes);
    if (newer.frame != frame) calls += fill(pair, newer, look, frame, parts, &TurnPart::now, uploaded_bytes);
    combine(target, pair, newer, has_older ? older : newer, combination);
    target.resolve();
    return calls + 1;
}

void Turns::combine(const gl::Target& target, const Pair& pair, const Buffer& newer, const Buffer& older,
                    const Combination& combination) {
    target.bind();
    const gl::Program& program = pair.combine;
    program.use();
    glUniform2i(program.at("size_px"), GLint(pair.width_px), GLint(pair.height_px));
    glUniformMatrix4fv(program.at("camera_old_from_new"), 1, GL_FALSE, glm::value_ptr(combination.camera.old_from_new));
    if (options_.variant == Variant::fsi_paper) {
        GLuint unit = 0;
        for (const Buffer* buffer : {&newer, &older}) {
            glBindTextureUnit(unit++, buffer->colour.id());
            glBindTextureUnit(unit++, buffer->ids.id());
        }
    } else {
        GLuint unit = 0;
        for (const Buffer* buffer : {&newer, &older}) {
            glBindTextureUnit(unit++, buffer->colour.id());
            glBindTextureUnit(unit++, buffer->ids.id());
            glBindTextureUnit(unit++, buffer->depth.id());
        }
        glUniformMatrix4fv(program.at("camera_new_from_old"), 1, GL_FALSE, glm::value_ptr(combination.camera.new_from_old));
        glUniform1i(program.at("tile_columns"), GLint(combination.tiles.columns));
        glUniform1f(program.at("softness"), float(options_.remedies.softness));
        const PackedMoved none;
        bool is_empty = combination.moved.empty();
        moved_.fill(is_empty ? std::as_bytes(std::span(&none, 1)) : std::as_bytes(std::span(combination.moved)));
        tiles_.fill(std::as_bytes(std::span(combination.tiles.entries)));
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, moved_.id());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, tiles_.id());
    }
    glDepthFunc(GL_ALWAYS);
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthFunc(GL_GREATER);
}

}  // namespace overlook::discrete
