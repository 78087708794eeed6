// Drawing with sprites: keys kept in textures, novel frames that look their pixels up in them. What and when, the deciding half
// says (runtime/lod_sprite/director.h); the thing drawn is any gl::Surface.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/surface.h"
#include "runtime/gl/target.h"
#include "runtime/lod_sprite/key.h"

namespace overlook::lod_sprite {

constexpr uint32_t kMostKeysAtOnce = 3;

// A mask's pixel has bit k set where the k-th key shows it, or one of these; 0 is the background.
constexpr uint8_t kMaskOwn = 64;    // no key shows it: the surface's own colours
constexpr uint8_t kMaskNear = 128;  // near geometry, which keys are not asked for

// A key that a frame looks into.
struct KeyUse {
    uint32_t slot = 0;
    double weight = 1;  // among those that show a pixel
};

// What a novel frame is drawn with.
struct NovelOptions {
    std::vector<KeyUse> keys;  // at most kMostKeysAtOnce
    double low_error_px = 16;  // the promise of the coarse cut
    double near_error_px = 1;  // of what is nearer than near_depth_m, which is drawn without sprites
    double near_depth_m = 0;
    // Of the thing's own colours, 0..1, where the first key shows a pixel and no other does: a key fades in over them,
    // but in a mask and where sources are shown.
    double own_weight = 0;
    double most_slack_m = 1e9;   // no surface is farther than that from its coarse form
    double tolerance_px = 0.5;   // how far from its place a key's texel may be shown
    double most_texel_px = 1.5;  // how wide a texel may have become
    uint32_t look_ups = 3;       // a pixel and key at most; 0 = it is where the coarse surface is
    bool raises =
        true;  // where errors are vertical: the coarse surface up to where it covers the true one, so that outlines are kept
    bool tests_slab = true;      // what a key shows must lie where the coarse surface allows it
    bool tests_places = true;    // a texel counts only where it is in its own place in this frame
    bool shows_sources = false;  // grey: the first key; yellow: another; blue: near; red: no key shows it
    bool is_mask = false;  // the red channel is a mask, the others are 0, and there is no background; for one sample a pixel
};

// Where a key is drawn: textures of one context or of several that share them.
struct KeyPicture {
    view::Camera camera, drawn_camera;  // the second with the texels' size
    GLuint colour = 0, depth = 0;
};

// What is drawn into from now on in this context: the picture's textures, through a framebuffer made for them. Fails with
// Exit::impossible if the renderer cannot.
Result<gl::Framebuffer> framebuffer_of(const KeyPicture& picture);
// Makes the picture ready to be drawn into. framebuffer: of framebuffer_of().
void begin_picture(const gl::Framebuffer& framebuffer, const KeyPicture& picture);
// Adds the surface's background where nothing has been drawn.
void finish_picture(const gl::Framebuffer& framebuffer, const KeyPicture& picture, gl::Surface& surface);
// The picture's depths (metres along its axis, infinity = nothing) in the middle of each cell of a grid over it, from the top; a
// cell is at most `step` texels wide and high. Waits until they are drawn.
DepthGrid read_depth(const KeyPicture& picture, uint32_t step);
// The program that key pictures are drawn with. Fails with Exit::our_bug where it does not compile.
Result<gl::Program> key_program(const gl::Surface& surface);

// Draws into keys and novel frames. A context must be current whenever it is used, and when it goes.
class Painter {
  public:
    // slots: how many keys are kept. is_error_vertical: as Geometry says of what is drawn; otherwise it may be in any direction,
    // and nothing is raised. Fails with Exit::our_bug where a shader does not compile.
    static Result<Painter> make(const gl::Surface& surface, uint32_t slots, bool is_error_vertical = true);

    // Makes room in a slot for a key of this camera, whose picture has camera.width_px * scale columns. Fails with
    // Exit::impossible where the renderer cannot have such a picture.
    Result<KeyPicture> reserve_key(uint32_t slot, const view::Camera& camera, uint32_t scale);
    // The same, and makes it ready to be drawn into.
    Result<void> begin_key(uint32_t slot, const view::Camera& camera, uint32_t scale);
    // Adds what the surface draws now, as the key's camera sees it.
    void draw_into_key(uint32_t slot, gl::Surface& surface);
    // Makes it whole: adds the surface's background where nothing has been drawn.
    void finish_key(uint32_t slot, gl::Surface& surface);
    DepthGrid read_depth(uint32_t slot, uint32_t step) const { return lod_sprite::read_depth(sprites_[slot].picture, step); }

    // Draws a novel frame, background and all, and resolves it. near: what lies nearer than near_depth_m all through, drawn
    // without keys (null = nothing); far: everything else. Keys must be whole.
    Result<void> draw(const gl::Target& target, gl::Surface* near, gl::Surface& far, const view::Camera& camera,
                      const NovelOptions& options);

    // How often the frame drawn last drew each of them.
    struct Passes {
        uint32_t near = 0, far = 0, background = 0;
        uint32_t all() const { return near + far + background; }
    };
    const Passes& passes() const { return passes_; }

    // Of the key in a slot, its size that of the texels.
    const view::Camera& texel_camera(uint32_t slot) const { return sprites_[slot].picture.drawn_camera; }
    uint64_t resident_bytes() const;

  private:
    struct Sprite {
        KeyPicture picture;
        uint32_t width_px = 0, height_px = 0;
        gl::Texture colour, depth;
        gl::Framebuffer framebuffer;
    };
    enum class Pass { near, whole_keys, keys, rest };
    Result<void> draw_pass(Pass pass, gl::Surface* surface, const view::Camera& camera, const NovelOptions& options);
    Result<void> draw_whole(gl::Surface& far, const view::Camera& camera, const NovelOptions& options, bool fades);
    Result<void> blend_keys(gl::Surface& far, const view::Camera& camera, const NovelOptions& options);
    Result<const gl::Program*> program_of(const gl::Surface& surface, const NovelOptions& options, Pass pass);
    void set_uniforms(const gl::Program& program, const view::Camera& camera, const NovelOptions& options, bool raises) const;

    std::vector<Sprite> sprites_;
    bool is_error_vertical_ = true;
    Passes passes_;
    gl::Program key_program_;
    std::map<uint32_t, gl::Program> programs_;  // by pass, keys, look-ups and what is shown
};

}  // namespace overlook::lod_sprite
