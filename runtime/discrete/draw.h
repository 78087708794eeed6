// A chain of levels on the graphics card, and drawing lists of its instances with OpenGL; which levels, director.h decides.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/discrete.h"
#include "runtime/discrete/draw_list.h"
#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/target.h"
#include "runtime/view/camera.h"

namespace overlook::discrete {

struct DrawOptions {
    bool is_wireframe = false;       // the triangles' edges alone
    std::optional<view::Part> part;  // of the camera's picture, that the target shows; the whole of it if not said
};

// What a list is drawn from, filled anew for each.
class ListBuffers {
  public:
    ListBuffers();
    // Returns how many bytes went to the card.
    uint64_t fill(const DrawList& list);

  private:
    friend class Drawing;
    gl::StreamBuffer items_, commands_, poses_;
};

// All levels in one vertex and one index buffer, the surfaces' pictures and the visibilities. A context must be current.
class Drawing {
  public:
    // The chain must outlive it if anything of it moves. Fails with Exit::impossible if it is too large for the renderer.
    // Pictures that cannot be read (only PNG can) are left out: their surfaces keep their colour; why stands in faults().
    // shading_rounds: how many lights more each pixel is shaded by, to see what dear shaders cost.
    static Result<Drawing> make(const Chain& chain, uint32_t shading_rounds = 0);

    const Chain& chain() const { return *chain_; }
    const ChainLayout& layout() const { return layout_; }
    const std::vector<std::string>& faults() const { return faults_; }
    uint64_t bytes() const { return bytes_; }  // on the card, without pictures' smaller levels
    std::vector<double> grain_m() const;       // for Director::set_grain_m

    // The vertex shader with a fragment shader that begins as this one's own: `main` defines main(). defines: lines of #define.
    Result<gl::Program> program(const std::string& name, const std::string& defines, const std::string& main) const;
    // One picture: item.show but for Show::visible, which is drawn whole.
    const gl::Program& one_picture() const { return one_picture_; }

    // Draws calls of a list that `buffers` is filled with, into whatever is bound.
    void draw_calls(const gl::Program& program, const ListBuffers& buffers, const DrawList& list, std::span<const Call> calls,
                    const DrawOptions& options) const;
    // Fills the pixels in which nothing is drawn yet; their depth stays as far as it was.
    void draw_background(const view::Camera& camera, const DrawOptions& options) const;

  private:
    struct Look {
        gl::Texture picture;
        glm::vec4 colour{1};      // linear
        float alpha_cutoff = 0;   // what is more transparent is not drawn
        bool is_picture = false;  // of billboards
        bool is_two_sided = false;
    };
    Result<void> upload_levels();
    Result<void> make_looks();
    Result<void> upload_visibilities();
    Result<void> make_programs();

    const Chain* chain_ = nullptr;
    uint32_t shading_rounds_ = 0;
    ChainLayout layout_;
    gl::Buffer vertices_, indices_, visibilities_, values_;
    gl::Texture visibility_view_, value_view_;  // of the buffers
    gl::VertexArray array_;
    std::vector<Look> looks_;
    gl::Program one_picture_, background_;
    gl::VertexArray nothing_;
    std::vector<std::string> faults_;
    uint64_t bytes_ = 0;
};

// A chain's part of a picture: a list of its own, and the buffers that are filled with it.
struct Drawn {
    const Drawing* drawing = nullptr;
    const ListBuffers* buffers = nullptr;
    const DrawList* list = nullptr;
};
// Lists of several chains, of one camera, in one picture: what is whole, background, what is translucent, resolved. parts: at
// least one. Returns the calls made.
uint64_t draw(const gl::Target& target, std::span<const Drawn> parts, const DrawOptions& options);

}  // namespace overlook::discrete
