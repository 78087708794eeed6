#include "runtime/gl/target.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace overlook::gl {
namespace {

Renderbuffer make_renderbuffer(GLenum format, uint32_t width_px, uint32_t height_px, uint32_t samples) {
    GLuint id = 0;
    glCreateRenderbuffers(1, &id);
    glNamedRenderbufferStorageMultisample(id, samples > 1 ? GLsizei(samples) : 0, format, GLsizei(width_px), GLsizei(height_px));
    return Renderbuffer(id);
}

Framebuffer make_framebuffer(GLuint colour, GLuint depth) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    glNamedFramebufferRenderbuffer(id, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    if (depth != 0) glNamedFramebufferRenderbuffer(id, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    return Framebuffer(id);
}

bool is_complete(const Framebuffer& framebuffer) {
    return glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

}  // namespace

Result<Target> Target::make(uint32_t width_px, uint32_t height_px, uint32_t samples) {
    GLint most_px = 0, most_samples = 0, most_viewport_px[2] = {0, 0};
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_px);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most_viewport_px);
    glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
    most_px = std::min({most_px, most_viewport_px[0], most_viewport_px[1]});
    if (std::max(width_px, height_px) > uint32_t(most_px)) {
        return impossible("pictures of {} x {} pixels are too large for this renderer ({} at most)", width_px, height_px,
                          most_px);
    }
    if (samples > 1 && samples > uint32_t(most_samples)) {
        return impossible("{} samples a pixel are too many for this renderer ({} at most)", samples, most_samples);
    }

    Target made;
    made.width_px_ = width_px;
    made.height_px_ = height_px;
    made.samples_ = samples;
    made.drawn_colour_ = make_renderbuffer(GL_RGBA8, width_px, height_px, samples);
    made.drawn_depth_ = make_renderbuffer(GL_DEPTH_COMPONENT32F, width_px, height_px, samples);
    made.drawn_ = make_framebuffer(made.drawn_colour_.id(), made.drawn_depth_.id());
    if (samples > 1) {
        made.resolved_colour_ = make_renderbuffer(GL_RGBA8, width_px, height_px, 1);
        made.resolved_ = make_framebuffer(made.resolved_colour_.id(), 0);
    }
    if (!is_complete(made.drawn_) || (samples > 1 && !is_complete(made.resolved_))) {
        return impossible("this renderer cannot draw pictures of {} x {} pixels with {} samples", width_px, height_px, samples);
    }
    return made;
}

void bind_for_drawing(GLuint framebuffer, uint32_t width_px, uint32_t height_px) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, GLsizei(width_px), GLsizei(height_px));
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DITHER);
    glDisable(GL_CULL_FACE);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

void Target::bind() const {
    bind_for_drawing(drawn_.id(), width_px_, height_px_);
}

void Target::copy_from(GLuint framebuffer) const {
    GLint w = GLint(width_px_), h = GLint(height_px_);
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(framebuffer, drawn_.id(), 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
                           GL_NEAREST);
}

void Target::resolve() const {
    if (samples_ == 1) return;
    GLint w = GLint(width_px_), h = GLint(height_px_);
    glBlitNamedFramebuffer(drawn_.id(), resolved_.id(), 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

ImageRgb8 Target::read() const {
    size_t row_bytes = size_t(width_px_) * 3;
    std::vector<uint8_t> bottom_first(row_bytes * height_px_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_ > 1 ? resolved_.id() : drawn_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, GLsizei(width_px_), GLsizei(height_px_), GL_RGB, GL_UNSIGNED_BYTE, bottom_first.data());

    ImageRgb8 image{width_px_, height_px_, std::vector<uint8_t>(bottom_first.size())};
    for (size_t row = 0; row < height_px_; ++row) {
        std::memcpy(&image.pixels[row * row_bytes], &bottom_first[(height_px_ - 1 - row) * row_bytes], row_bytes);
    }
    return image;
}

std::vector<float> Target::read_depth() const {
    assert(samples_ == 1);
    std::vector<float> bottom_first(size_t(width_px_) * height_px_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, GLsizei(width_px_), GLsizei(height_px_), GL_DEPTH_COMPONENT, GL_FLOAT, bottom_first.data());

    std::vector<float> depth(bottom_first.size());
    for (size_t row = 0; row < height_px_; ++row) {
        std::copy_n(&bottom_first[(height_px_ - 1 - row) * width_px_], width_px_, &depth[row * width_px_]);
    }
    return depth;
}

void Target::show(uint32_t window_width_px, uint32_t window_height_px) const {
    GLuint from = samples_ > 1 ? resolved_.id() : drawn_.id();
    bool is_same_size = window_width_px == width_px_ && window_height_px == height_px_;
    glBlitNamedFramebuffer(from, 0, 0, 0, GLint(width_px_), GLint(height_px_), 0, 0, GLint(window_width_px),
                           GLint(window_height_px), GL_COLOR_BUFFER_BIT, is_same_size ? GL_NEAREST : GL_LINEAR);
}

}  // namespace overlook::gl
