#include "runtime/gl/objects.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "runtime/gl/masked_levels.h"

namespace overlook::gl {
namespace {

Result<Texture> make_filtered(uint32_t width_px, uint32_t height_px, GLenum format, const uint8_t* pixels) {
    GLint most_px = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_px);
    if (std::max(width_px, height_px) > uint32_t(most_px)) {
        return impossible("the picture of {} x {} pixels is too large for this renderer ({} at most)", width_px, height_px,
                          most_px);
    }
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    Texture texture(id);
    GLsizei levels = 1 + GLsizei(std::log2(std::max(width_px, height_px)));
    glTextureStorage2D(id, levels, GL_SRGB8_ALPHA8, GLsizei(width_px), GLsizei(height_px));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(id, 0, 0, 0, GLsizei(width_px), GLsizei(height_px), format, GL_UNSIGNED_BYTE, pixels);
    glGenerateTextureMipmap(id);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace

void free_object(Kind kind, GLuint id) {
    switch (kind) {
        case Kind::buffer:
            glDeleteBuffers(1, &id);
            break;
        case Kind::vertex_array:
            glDeleteVertexArrays(1, &id);
            break;
        case Kind::texture:
            glDeleteTextures(1, &id);
            break;
        case Kind::framebuffer:
            glDeleteFramebuffers(1, &id);
            break;
        case Kind::renderbuffer:
            glDeleteRenderbuffers(1, &id);
            break;
    }
}

Buffer make_buffer(std::span<const std::byte> bytes) {
    assert(!bytes.empty());
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, GLsizeiptr(bytes.size()), bytes.data(), 0);
    return Buffer(id);
}

VertexArray make_vertex_array() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArray(id);
}

Texture make_view(GLuint buffer, GLenum format) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    glTextureBuffer(id, format, buffer);
    return Texture(id);
}

Result<Texture> make_texture(const ImageRgb8& image) {
    return make_filtered(image.width, image.height, GL_RGB, image.pixels.data());
}

Result<Texture> make_texture(const ImageRgba8& image) {
    return make_filtered(image.width, image.height, GL_RGBA, image.pixels.data());
}

Result<Texture> make_masked_texture(const ImageRgba8& image, float cutoff) {
    Result<Texture> texture = make_texture(image);
    if (!texture) return texture;
    GLint level = 0;
    for (const ImageRgba8& smaller : masked_levels(image, cutoff))
        glTextureSubImage2D(texture->id(), ++level, 0, 0, GLsizei(smaller.width), GLsizei(smaller.height), GL_RGBA,
                            GL_UNSIGNED_BYTE, smaller.pixels.data());
    return texture;
}

StreamBuffer::StreamBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer_ = Buffer(id);
}

void StreamBuffer::reserve(size_t bytes) {
    if (bytes > capacity_bytes_) capacity_bytes_ = std::max(bytes, capacity_bytes_ + capacity_bytes_ / 2);
    if (capacity_bytes_ == 0) return;
    glNamedBufferData(buffer_.id(), GLsizeiptr(capacity_bytes_), nullptr, GL_STREAM_DRAW);
}

void StreamBuffer::fill(std::span<const std::byte> bytes) {
    reserve(bytes.size());
    if (capacity_bytes_ == 0) return;
    glNamedBufferSubData(buffer_.id(), 0, GLsizeiptr(bytes.size()), bytes.data());
}

}  // namespace overlook::gl
