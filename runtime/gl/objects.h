// OpenGL's objects as owners: freed when they go, movable, never copied. The context must be current whenever one is made or
// goes.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

#include "formats/result.h"
#include "runtime/gl/png.h"

namespace overlook::gl {

enum class Kind { buffer, vertex_array, texture, framebuffer, renderbuffer };

void free_object(Kind kind, GLuint id);

template <Kind kind>
class Object {
  public:
    Object() = default;
    explicit Object(GLuint id) : id_(id) {}
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Object() {
        if (id_ != 0) free_object(kind, id_);
    }
    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

using Buffer = Object<Kind::buffer>;
using VertexArray = Object<Kind::vertex_array>;
using Texture = Object<Kind::texture>;
using Framebuffer = Object<Kind::framebuffer>;
using Renderbuffer = Object<Kind::renderbuffer>;

// A buffer that never changes. bytes must not be empty.
Buffer make_buffer(std::span<const std::byte> bytes);
VertexArray make_vertex_array();
// A buffer as a texture of one row, which a shader may read at any place. It follows the buffer when that is filled anew.
Texture make_view(GLuint buffer, GLenum format);

// A picture of sRGB-encoded colours, its rows from the top, as a texture with all its smaller levels, filtered between pixels and
// levels; it repeats beyond its edges. Fails with Exit::impossible: "the picture of 20000 x 3 pixels is too large for this
// renderer (16384 at most)".
Result<Texture> make_texture(const ImageRgb8& image);
Result<Texture> make_texture(const ImageRgba8& image);
// The same of a picture whose opacity is held against a threshold, its smaller levels by masked_levels.
Result<Texture> make_masked_texture(const ImageRgba8& image, float cutoff);

// A buffer that is filled anew every frame. What the last frame still reads is left to it: the driver gives fresh memory
// (orphaning).
class StreamBuffer {
  public:
    StreamBuffer();
    void fill(std::span<const std::byte> bytes);
    // Fresh memory for so many bytes, that the graphics card fills.
    void reserve(size_t bytes);
    GLuint id() const { return buffer_.id(); }

  private:
    Buffer buffer_;
    size_t capacity_bytes_ = 0;
};

}  // namespace overlook::gl
