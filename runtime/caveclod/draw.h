// Drawing what cameras have refined of one mesh with OpenGL; which faces, runtime/caveclod/refine.h decides.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/caveclod/refine.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/surface.h"
#include "runtime/gl/target.h"
#include "runtime/view/camera.h"

namespace overlook::caveclod {

struct DrawOptions {
    bool is_wireframe = false;       // the triangles' edges alone
    bool culls_back_faces = false;   // of surfaces that are not two-sided; the same as Settings of the refinement
    glm::dvec3 origin_m{0};          // where the mesh's own world has its origin in that of the camera
    std::optional<view::Part> part;  // of the camera's picture, that the target shows; the whole of it if not said
};

// What one camera draws, on the graphics card: an index buffer for each surface, kept up to date by what has changed.
class CameraBuffers {
  public:
    explicit CameraBuffers(const Mesh& mesh);

    // Uploads what has changed since the last call, and clears that mark.
    void take(Refinement& refinement);
    // Uploads these instead of all that was there: three vertices a face, [surfaces of the mesh].
    void take(std::span<const std::vector<uint32_t>> by_surface);
    uint64_t uploaded_bytes() const { return uploaded_bytes_; }  // by the last take()
    uint64_t triangle_count() const;
    uint64_t draw_call_count(gl::TriangleRange range = {}) const;  // surfaces that have faces, of these

  private:
    friend class Drawing;
    struct Indices {
        gl::Buffer buffer;
        size_t capacity_pages = 0;
        uint32_t face_count = 0;
    };
    void take_surface(const FaceSlots& faces, uint32_t surface);

    std::vector<Indices> surfaces_;
    gl::StreamBuffer glides_;
    gl::Texture glides_view_;
    uint64_t uploaded_bytes_ = 0;
};

// The mesh on the graphics card, once for all cameras: 16 bytes a vertex and the surfaces' pictures. It must outlive neither the
// mesh nor the hierarchy. Positions are drawn relative to the camera, whole steps subtracted as integers and the rest in double.
class Drawing {
  public:
    // Fails with Exit::impossible if the mesh is too large for the renderer. Pictures that cannot be read (only PNG can) are left
    // out: their surfaces keep their colour; why stands in faults().
    static Result<Drawing> make(const Mesh& mesh);
    // The same mesh for another context that shares the first's objects, current now: what the first put on the card is the
    // first's, which must outlive it and stay where it is. So both may draw at once, each in its own thread. Fails with
    // Exit::our_bug.
    static Result<Drawing> sharing(const Drawing& first);
    // The mesh has grown or shrunk (MeshStream): uploads the vertices that are new. Fails as make(). Returns how many bytes.
    Result<uint64_t> take_vertices(const Mesh& mesh);
    const std::vector<std::string>& faults() const { return faults_; }

    // Draws a plain background and the faces into `target` and resolves it.
    void draw(const gl::Target& target, const CameraBuffers& buffers, const view::Camera& camera,
              const DrawOptions& options) const;

    // What a method colours by itself, into whatever is bound.
    Result<gl::Program> program(const gl::SurfaceShader& shader) const;
    void draw_with(const gl::Program& program, const CameraBuffers& buffers, const view::Camera& camera,
                   const DrawOptions& options, gl::TriangleRange range = {}) const;
    void draw_background(const view::Camera& camera, const DrawOptions& options) const;

  private:
    struct Look {
        gl::Texture picture;  // of one white pixel where the surface has none
        glm::vec4 colour{1};  // linear
        float alpha_cutoff = -1;
        bool is_two_sided = false;
    };
    Drawing() = default;
    void resize_buffers(uint32_t capacity, bool has_colours);
    Result<void> make_programs();
    Result<void> make_looks(const Mesh& mesh);
    void set_camera(const gl::Program& program, const view::Camera& camera, const DrawOptions& options) const;

    glm::dvec3 origin_m_{0};
    Grid grid_;
    uint32_t glide_begin_ = 0, vertex_count_ = 0, capacity_ = 0;  // vertex_count_: uploaded
    bool has_colours_ = false;
    const Drawing* first_ = nullptr;  // whose buffers and pictures it draws with, where it has none
    gl::Buffer vertices_, colours_;
    gl::Texture vertices_view_, colours_view_;
    gl::VertexArray nothing_;
    std::vector<Look> looks_;
    std::vector<std::string> faults_;
    gl::Program shaded_, background_;
};

// One camera's faces as a thing that any method may colour. Drawing and buffers must outlive it.
class MeshSurface : public gl::Surface {
  public:
    MeshSurface(const Drawing& drawing, const CameraBuffers& buffers, const DrawOptions& options)
        : drawing_(drawing), buffers_(buffers), options_(options) {}

    Result<gl::Program> program(const gl::SurfaceShader& shader) const override { return drawing_.program(shader); }
    // Only these of what the buffers hold, surface by surface.
    void take_range(gl::TriangleRange range) { range_ = range; }
    void draw(const gl::Program& program, const view::Camera& camera) override {
        drawing_.draw_with(program, buffers_, camera, options_, range_);
    }
    uint64_t draw_call_count() const override { return buffers_.draw_call_count(range_); }
    void draw_background(const view::Camera& camera) override { drawing_.draw_background(camera, options_); }

  private:
    const Drawing& drawing_;
    const CameraBuffers& buffers_;
    DrawOptions options_;
    gl::TriangleRange range_;
};

}  // namespace overlook::caveclod
