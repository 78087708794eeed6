#include "runtime/discrete/draw_turns.h"

#include "runtime/discrete/draw_shaders.h"

namespace overlook::discrete {
namespace {

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

}  // namespace

Result<Turns> Turns::make(const Drawing& drawing, const FrameOptions& options) {
    Turns made;
    made.options_ = options;
    bool is_paper = options.variant == Variant::fsi_paper;
    std::string defines = define("KEEPS_HIDDEN", options.remedies.keeps_hidden);
    auto turn = drawing.program("turn", defines, is_paper ? shaders::kPaperTurnMain : shaders::kTurnMain);
    if (!turn) return tl::unexpected(turn.error());
    made.turn_ = std::move(*turn);
    return made;
}

Result<TurnBuffer> Turns::make_buffer(const gl::Target& target) const {
    bool is_paper = options_.variant == Variant::fsi_paper;
    GLenum numbers = !is_paper ? GL_RG32UI : options_.is_half_precise ? GL_RG16F : GL_RG32F;
    TurnBuffer made;
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
    for (TurnBuffer& buffer : pair.buffers) {
        Result<TurnBuffer> made = make_buffer(target);
        if (!made) return tl::unexpected(made.error());
        buffer = std::move(*made);
    }
    Result<Combiner> combiner = Combiner::make(options_, pair.samples);
    if (!combiner) return tl::unexpected(combiner.error());
    pair.combiner = std::move(*combiner);
    return &pairs_.emplace(target.samples(), std::move(pair)).first->second;
}

Result<void> Turns::prepare(const gl::Target& target) {
    Result<Pair*> pair = pair_for(target);
    if (!pair) return tl::unexpected(pair.error());
    (*pair)->combiner.prepare(target, (*pair)->buffers[0], (*pair)->buffers[1]);
    return {};
}

uint64_t Turns::bytes(uint32_t samples) const {
    bool is_small = options_.variant == Variant::fsi_paper && options_.is_half_precise;
    uint64_t sample_bytes = 4 + (is_small ? 4 : 8) + 4;
    auto found = pairs_.find(samples);
    if (found == pairs_.end()) return 0;
    return 2 * sample_bytes * samples * found->second.width_px * found->second.height_px;
}

uint64_t Turns::searched_px(uint32_t samples) const {
    auto found = pairs_.find(samples);
    return found == pairs_.end() ? 0 : found->second.combiner.searched_px();
}

uint64_t Turns::fill(const Pair& pair, TurnBuffer& buffer, const DrawOptions& look, uint64_t frame,
                     std::span<const TurnPart> parts, const DrawList* TurnPart::*list, uint64_t& uploaded_bytes) {
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
    TurnBuffer& newer = pair.buffers[frame % 2];
    TurnBuffer& older = pair.buffers[(frame + 1) % 2];
    uint64_t calls = 0;
    // A target that was not drawn into the last time.
    const view::Camera& old_camera = parts.front().before->camera;
    bool has_older = has_before && old_camera.width_px == pair.width_px && old_camera.height_px == pair.height_px;
    if (has_older && older.frame + 1 != frame)
        calls += fill(pair, older, look, frame - 1, parts, &TurnPart::before, uploaded_bytes);
    if (newer.frame != frame) calls += fill(pair, newer, look, frame, parts, &TurnPart::now, uploaded_bytes);
    calls += pair.combiner.combine(target, newer, has_older ? older : newer, combination);
    combined_px_ = pair.combiner.combined_px();
    target.resolve();
    return calls;
}

}  // namespace overlook::discrete
