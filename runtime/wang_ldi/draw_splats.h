// A field's list drawn by the graphics card's compute shaders: the pictures of the exact warper (by depth), but for what rounding
// there decides.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 5.2; M. Schuetz, B. Kerbl, M.
// Wimmer, Rendering Point Clouds with Compute Shaders and Vertex Order Optimization, 2021. Ours: in two rounds of 32 bits where
// the card cannot change 64 at once.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/wang_ldi/draw_composite.h"
#include "runtime/wang_ldi/far_images.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/prepared_ldi.h"

namespace overlook::wang_ldi {

struct SplatCounts {
    uint64_t samples = 0;         // of all images and far points drawn, whether they are shown or not
    uint64_t images_missing = 0;  // that are shown and were not at hand
    uint64_t uploaded_bytes = 0;
};

// A context must be current.
class Splats {
  public:
    // in_one_round: by 64 bits at once where the card can; false: never. Fails with Exit::our_bug.
    static Result<Splats> make(bool in_one_round = true);
    bool is_in_one_round() const { return is_in_one_round_; }

    // Draws into the composite, as by Composite::take; nothing is read back. Images are kept on the card as long as image_at has
    // them. finer: as Eye's.
    SplatCounts draw(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                     bool fills_holes, const FarImages* far, Composite& into, uint32_t finer = 1);
    uint64_t holes_filled() const;  // of the last picture; waits for it
    uint64_t bytes() const;         // of images on the card

  private:
    struct Image {
        const PreparedLdi* of = nullptr;
        gl::Buffer buffer;
        uint64_t bytes = 0;
    };
    struct One {  // a draw of an image
        GLuint buffer = 0;
        uint32_t sample_count = 0;
    };
    Splats() = default;
    const Image& image(uint64_t index, const PreparedLdi& prepared, SplatCounts& counts);
    void let_go(const PreparedAt& image_at);
    void begin(uint32_t width_px, uint32_t height_px);
    void round(const gl::Program& images, const gl::Program& points, const std::vector<One>& draws, uint32_t point_count,
               const view::Camera& camera, uint32_t finer) const;

    bool is_in_one_round_ = false;
    std::vector<gl::Program> images_, points_;  // of each round
    gl::Program read_out_;
    gl::Buffer pixels_, colours_, filled_;
    uint32_t width_px_ = 0, height_px_ = 0;
    gl::StreamBuffer draws_, planes_, loose_;
    std::map<uint64_t, Image> kept_;
};

}  // namespace overlook::wang_ldi
