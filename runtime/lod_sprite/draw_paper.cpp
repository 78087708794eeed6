#include "runtime/lod_sprite/draw_paper.h"

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/lod_sprite/draw.h"

namespace overlook::lod_sprite::paper {
namespace {

constexpr GLuint kSpriteUnit = gl::kFirstFreeUnit, kFlagsUnit = gl::kFirstFreeUnit + 1;

// x and y of the place in the sprite times the third; what lies behind the keyframe's eye is never looked up.
constexpr char kVertex[] = R"(
uniform mat4 key_clip_from_relative;
uniform vec3 eye_from_key_m;
uniform bool is_homogeneous;
out vec3 sprite_place;
vec3 placed(vec3 relative_m) {
    vec4 clip = key_clip_from_relative * vec4(relative_m + eye_from_key_m, 1.0);
    float depth_m = max(clip.w, 1e-6);
    sprite_place = vec3(0.5 * (clip.xy + depth_m), depth_m);
    if (!is_homogeneous) sprite_place /= depth_m;
    return relative_m;
}
)";

constexpr char kFragment[] = R"(
uniform sampler2D sprite;           // as it was drawn: air, sRGB encoding and all
uniform usamplerBuffer is_visible;  // of each triangle
uniform bool is_mask;
uniform float mask_own;
in vec3 sprite_place;
void main() {
    bool wears_sprite = texelFetch(is_visible, gl_PrimitiveID).r != 0u;
    if (is_mask)
        colour = vec4((wears_sprite ? 1.0 : mask_own) / 255.0, 0.0, 0.0, 1.0);
    else if (wears_sprite)
        colour = vec4(texture(sprite, sprite_place.xy / sprite_place.z).rgb, 1.0);
    else
        colour = vec4(encoded(behind_air(own_colour(surface.relative_m), surface.relative_m)), 1.0);
}
)";

gl::Texture make_sprite(uint32_t width_px, uint32_t height_px) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, 1, GL_RGBA8, GLsizei(width_px), GLsizei(height_px));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return gl::Texture(id);
}

}  // namespace

Result<Drawing> Drawing::make(terrain::Drawing& ground, uint32_t width_px, uint32_t height_px) {
    GLint most_px = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_px);
    if (std::max(width_px, height_px) > uint32_t(most_px)) {
        return impossible("keyframes of {} x {} pixels are too large for this renderer ({} at most)", width_px, height_px,
                          most_px);
    }
    Drawing made;
    made.ground_ = &ground;
    made.width_px_ = width_px;
    made.height_px_ = height_px;
    made.sprite_ = make_sprite(width_px, height_px);

    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    made.sprite_framebuffer_ = gl::Framebuffer(framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, made.sprite_.id(), 0);
    if (glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return impossible("this renderer cannot keep keyframes of {} x {} pixels", width_px, height_px);

    const std::byte none{0};
    made.flags_.fill(std::span(&none, 1));
    GLuint view = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &view);
    glTextureBuffer(view, GL_R8UI, made.flags_.id());
    made.flags_view_ = gl::Texture(view);

    Result<gl::Program> program = ground.program({"lod-sprite:paper", kVertex, kFragment});
    if (!program) return tl::unexpected(program.error());
    made.program_ = std::move(*program);
    return made;
}

// Averages the samples of a pixel as Target::resolve does.
void Drawing::copy_colours(const gl::Target& target) const {
    target.bind();
    GLint from = 0, w = GLint(width_px_), h = GLint(height_px_);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &from);
    glBlitNamedFramebuffer(GLuint(from), sprite_framebuffer_.id(), 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Result<void> Drawing::draw_key(const gl::Target& target, const terrain::Cut& high, const view::Camera& camera,
                               const terrain::DrawOptions& options, std::vector<float>& near_over_depth) {
    assert(target.width_px() == width_px_ && target.height_px() == height_px_);
    bool has_depth = target.samples() == 1;
    if (!has_depth && !depth_target_) {
        Result<gl::Target> made = gl::Target::make(width_px_, height_px_, 1);
        if (!made) return tl::unexpected(made.error());
        depth_target_ = std::move(*made);
    }
    ground_->draw(target, high, camera, options);
    uploaded_bytes_ = ground_->uploaded_bytes();
    copy_colours(target);
    if (!has_depth) {
        ground_->draw(*depth_target_, high, camera, options);
        uploaded_bytes_ += ground_->uploaded_bytes();
    }
    near_over_depth = (has_depth ? target : *depth_target_).read_depth();
    return {};
}

void Drawing::draw_novel(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible,
                         const view::Camera& key, const view::Camera& camera, const terrain::DrawOptions& options,
                         Coordinates coordinates) {
    draw_low(target, low, is_visible, key, camera, options, coordinates, false);
}

void Drawing::draw_mask(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible,
                        const view::Camera& key, const view::Camera& camera, const terrain::DrawOptions& options) {
    draw_low(target, low, is_visible, key, camera, options, Coordinates::homogeneous, true);
}

void Drawing::draw_low(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible,
                       const view::Camera& key, const view::Camera& camera, const terrain::DrawOptions& options,
                       Coordinates coordinates, bool is_mask) {
    assert(is_visible.size() == low.triangle_count());
    if (!is_visible.empty()) flags_.fill(std::as_bytes(is_visible));
    ground_->take(low);
    uploaded_bytes_ = ground_->uploaded_bytes() + is_visible.size_bytes();

    target.bind();
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glDisable(GL_CULL_FACE);
    const GLfloat nothing[4] = {0, 0, 0, 1};
    if (is_mask)
        glClearBufferfv(GL_COLOR, 0, nothing);
    else
        ground_->draw_sky(camera, options);

    glm::mat4 key_clip_from_relative = view::projection(key) * view::rotation(key);
    glm::vec3 eye_from_key_m(camera.position_m - key.position_m);
    program_.use();
    glUniformMatrix4fv(program_.at("key_clip_from_relative"), 1, GL_FALSE, glm::value_ptr(key_clip_from_relative));
    glUniform3fv(program_.at("eye_from_key_m"), 1, glm::value_ptr(eye_from_key_m));
    glUniform1i(program_.at("is_homogeneous"), coordinates == Coordinates::homogeneous);
    glUniform1i(program_.at("is_mask"), is_mask);
    glUniform1f(program_.at("mask_own"), float(kMaskOwn));
    glUniform1i(program_.at("sprite"), GLint(kSpriteUnit));
    glUniform1i(program_.at("is_visible"), GLint(kFlagsUnit));
    glBindTextureUnit(kSpriteUnit, sprite_.id());
    glBindTextureUnit(kFlagsUnit, flags_view_.id());
    ground_->draw_with(program_, camera, options);
    target.resolve();
}

}  // namespace overlook::lod_sprite::paper
