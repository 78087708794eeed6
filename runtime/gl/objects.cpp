#include "runtime/gl/objects.h"

#include <algorithm>
#include <cassert>

namespace overlook::gl {

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

StreamBuffer::StreamBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer_ = Buffer(id);
}

void StreamBuffer::fill(std::span<const std::byte> bytes) {
    if (bytes.size() > capacity_bytes_) capacity_bytes_ = std::max(bytes.size(), capacity_bytes_ + capacity_bytes_ / 2);
    if (capacity_bytes_ == 0) return;
    glNamedBufferData(buffer_.id(), GLsizeiptr(capacity_bytes_), nullptr, GL_STREAM_DRAW);
    glNamedBufferSubData(buffer_.id(), 0, GLsizeiptr(bytes.size()), bytes.data());
}

}  // namespace overlook::gl
