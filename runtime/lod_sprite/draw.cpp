#include "runtime/lod_sprite/draw.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>

#include "runtime/gl/surface_shaders.h"
#include "runtime/lod_sprite/draw_shaders.h"

namespace overlook::lod_sprite {
namespace {

constexpr GLuint kColourUnit = gl::kFirstFreeUnit, kDepthUnit = 8;

gl::Texture make_texture(GLenum format, uint32_t width_px, uint32_t height_px) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, 1, format, GLsizei(width_px), GLsizei(height_px));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return gl::Texture(id);
}

glm::vec3 as_floats(const glm::dvec3& v) {
    return glm::vec3(v);
}

void clear_depth() {
    const GLfloat farthest = 0;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

}  // namespace

Result<gl::Framebuffer> framebuffer_of(const KeyPicture& picture) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    gl::Framebuffer framebuffer(id);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, picture.colour, 0);
    glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, picture.depth, 0);
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return impossible("this renderer cannot draw keys of {} x {} pixels", picture.drawn_camera.width_px,
                          picture.drawn_camera.height_px);
    }
    return framebuffer;
}

void begin_picture(const gl::Framebuffer& framebuffer, const KeyPicture& picture) {
    gl::bind_for_drawing(framebuffer.id(), picture.drawn_camera.width_px, picture.drawn_camera.height_px);
    clear_depth();
}

void finish_picture(const gl::Framebuffer& framebuffer, const KeyPicture& picture, gl::Surface& surface) {
    gl::bind_for_drawing(framebuffer.id(), picture.drawn_camera.width_px, picture.drawn_camera.height_px);
    surface.draw_background(picture.drawn_camera);
}

DepthGrid read_depth(const KeyPicture& picture, uint32_t step) {
    uint32_t width_px = picture.drawn_camera.width_px, height_px = picture.drawn_camera.height_px;
    std::vector<float> row(width_px);
    DepthGrid grid{(width_px + step - 1) / step, (height_px + step - 1) / step, {}};
    grid.depth_m.reserve(size_t(grid.width) * grid.height);
    auto middle = [](uint32_t cell, uint32_t cells, uint32_t side_px) {
        return uint32_t((2 * uint64_t(cell) + 1) * side_px / (2 * uint64_t(cells)));
    };
    for (uint32_t y = 0; y < grid.height; ++y) {
        GLint at = GLint(height_px - 1 - middle(y, grid.height, height_px));
        glGetTextureSubImage(picture.depth, 0, 0, at, 0, GLsizei(width_px), 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                             GLsizei(row.size() * sizeof(float)), row.data());
        for (uint32_t x = 0; x < grid.width; ++x) {
            float inverse = row[middle(x, grid.width, width_px)];
            grid.depth_m.push_back(inverse > 0 ? float(picture.camera.near_m) / inverse : std::numeric_limits<float>::infinity());
        }
    }
    return grid;
}

Result<gl::Program> key_program(const gl::Surface& surface) {
    return surface.program({"key", "", gl::shaders::kShadedMain});  // a key keeps the picture as it is shown, air and all
}

Result<Painter> Painter::make(const gl::Surface& surface, uint32_t slots, bool is_error_vertical) {
    Painter made;
    made.is_error_vertical_ = is_error_vertical;
    made.sprites_.resize(slots);
    Result<gl::Program> key = key_program(surface);
    if (!key) return tl::unexpected(key.error());
    made.key_program_ = std::move(*key);
    return made;
}

Result<KeyPicture> Painter::reserve_key(uint32_t slot, const view::Camera& camera, uint32_t scale) {
    Sprite& sprite = sprites_[slot];
    uint32_t width_px = camera.width_px * scale, height_px = camera.height_px * scale;
    KeyPicture picture{camera, camera, sprite.colour.id(), sprite.depth.id()};
    picture.drawn_camera.width_px = width_px;
    picture.drawn_camera.height_px = height_px;
    if (sprite.width_px != width_px || sprite.height_px != height_px) {
        GLint most_px = 0;
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_px);
        if (std::max(width_px, height_px) > uint32_t(most_px)) {
            return impossible("a key of {} x {} pixels is too large for this renderer ({} at most)", width_px, height_px,
                              most_px);
        }
        sprite.colour = make_texture(GL_RGBA8, width_px, height_px);
        sprite.depth = make_texture(GL_DEPTH_COMPONENT32F, width_px, height_px);
        picture.colour = sprite.colour.id();
        picture.depth = sprite.depth.id();
        Result<gl::Framebuffer> framebuffer = framebuffer_of(picture);
        if (!framebuffer) return tl::unexpected(framebuffer.error());
        sprite.framebuffer = std::move(*framebuffer);
        sprite.width_px = width_px;
        sprite.height_px = height_px;
    }
    sprite.picture = picture;
    return picture;
}

Result<void> Painter::begin_key(uint32_t slot, const view::Camera& camera, uint32_t scale) {
    Result<KeyPicture> picture = reserve_key(slot, camera, scale);
    if (!picture) return tl::unexpected(picture.error());
    begin_picture(sprites_[slot].framebuffer, *picture);
    return {};
}

void Painter::finish_key(uint32_t slot, gl::Surface& surface) {
    finish_picture(sprites_[slot].framebuffer, sprites_[slot].picture, surface);
}

void Painter::draw_into_key(uint32_t slot, gl::Surface& surface) {
    const Sprite& sprite = sprites_[slot];
    gl::bind_for_drawing(sprite.framebuffer.id(), sprite.width_px, sprite.height_px);
    key_program_.use();
    surface.draw(key_program_, sprite.picture.drawn_camera);
}

Result<const gl::Program*> Painter::program_of(const gl::Surface& surface, const NovelOptions& options, Pass pass) {
    uint32_t keys = pass == Pass::near ? 0 : uint32_t(options.keys.size());
    uint32_t name = uint32_t(pass) + 4 * keys + (keys > 0 ? 32 * options.look_ups : 0) + (options.shows_sources ? 1u << 31 : 0) +
                    (options.is_mask ? 1u << 30 : 0);
    auto known = programs_.find(name);
    if (known == programs_.end()) {
        bool raises = pass == Pass::keys || pass == Pass::whole_keys;
        std::string fragment = fmt::format("#define KEYS {}\n#define LOOK_UPS {}\n", keys, options.look_ups);
        if (pass == Pass::whole_keys) fragment += "#define WHOLE\n";
        if (options.shows_sources) fragment += "#define SHOWS_SOURCES\n";
        if (options.is_mask) fragment += fmt::format("#define MASK_OWN {}\n#define MASK_NEAR {}\n", kMaskOwn, kMaskNear);
        std::string slack = std::string(is_error_vertical_ ? "#define ERROR_IS_VERTICAL\n" : "") + shaders::kSlack;
        fragment += slack;
        if (keys > 0) fragment += shaders::kFind;
        fragment += raises ? shaders::kNovelMain : shaders::kOwnMain;
        Result<gl::Program> made =
            surface.program({fmt::format("novel view with {} keys", keys), raises ? slack + shaders::kRaised : "", fragment});
        if (!made) return tl::unexpected(made.error());
        known = programs_.emplace(name, std::move(*made)).first;
    }
    return &known->second;
}

void Painter::set_uniforms(const gl::Program& program, const view::Camera& camera, const NovelOptions& options,
                           bool raises) const {
    for (size_t i = 0; i < options.keys.size(); ++i) {
        const Sprite& sprite = sprites_[options.keys[i].slot];
        Link link = link_of(sprite.picture.camera, camera);
        glm::mat3 rotation(link.key_from_world);
        auto at = [&](const char* uniform) { return program.at(fmt::format("{}[{}]", uniform, i).c_str()); };
        glUniformMatrix3fv(at("key_from_world"), 1, GL_FALSE, glm::value_ptr(rotation));
        glm::vec3 forward_in_key = as_floats(link.key_from_world * view::axes_of(camera).forward);
        glUniform3fv(at("forward_in_key"), 1, glm::value_ptr(forward_in_key));
        glUniform3fv(at("eye_in_key_m"), 1, glm::value_ptr(as_floats(link.eye_m)));
        glUniform2f(at("key_tangents"), float(link.tangents.x), float(link.tangents.y));
        glUniform1f(at("key_near_m"), float(sprite.picture.camera.near_m));
        glUniform1f(at("key_weights"), float(options.keys[i].weight));
        glBindTextureUnit(kColourUnit + GLuint(i), sprite.colour.id());
        glBindTextureUnit(kDepthUnit + GLuint(i), sprite.depth.id());
    }
    glm::vec3 forward = as_floats(view::axes_of(camera).forward);
    glUniform3fv(program.at("eye_forward"), 1, glm::value_ptr(forward));
    glUniform1f(program.at("focal_px"), float(view::focal_px(camera)));
    glUniform1f(program.at("near_m"), float(camera.near_m));
    glUniform1f(program.at("low_error_px"), float(options.low_error_px));
    glUniform1f(program.at("near_error_px"), float(options.near_error_px));
    glUniform1f(program.at("near_depth_m"), float(options.near_depth_m));
    glUniform1f(program.at("own_weight"), float(options.own_weight));
    glUniform1f(program.at("most_slack_m"), float(options.most_slack_m));
    glUniform1f(program.at("raise"), raises ? 1.0f : 0.0f);
    glUniform1f(program.at("tolerance_px"), float(options.tolerance_px));
    glUniform1f(program.at("most_texel_px"), float(options.most_texel_px));
    glUniform1i(program.at("is_slab_tested"), options.tests_slab);
    glUniform1i(program.at("is_place_tested"), options.tests_places);
}

Result<void> Painter::draw_pass(Pass pass, gl::Surface* surface, const view::Camera& camera, const NovelOptions& options) {
    bool shows_keys = pass == Pass::keys || pass == Pass::whole_keys, raises = shows_keys && options.raises && is_error_vertical_;
    if (surface == nullptr || (shows_keys && options.keys.empty())) return {};
    Result<const gl::Program*> program = program_of(*surface, options, pass);
    if (!program) return tl::unexpected(program.error());
    (*program)->use();
    set_uniforms(**program, camera, options, raises);
    // A ray that leaves the raised surface has been through it.
    if (raises) glEnable(GL_CULL_FACE);
    surface->draw(**program, camera);
    glDisable(GL_CULL_FACE);
    ++(pass == Pass::near ? passes_.near : passes_.far);
    return {};
}

// Where all texels that a pixel needs count. Keys too light to be seen beside the first, which only fill what it does not show,
// are not asked there.
Result<void> Painter::draw_whole(gl::Surface& far, const view::Camera& camera, const NovelOptions& options, bool fades) {
    constexpr double kSeen = 1.0 / 256;  // a step of an 8-bit picture
    if (options.is_mask || options.keys.empty() || (fades && options.keys.size() < 2)) return {};
    NovelOptions seen = options;
    if (!fades) std::erase_if(seen.keys, [&](const KeyUse& key) { return key.weight < kSeen * options.keys[0].weight; });
    return draw_pass(Pass::whole_keys, &far, camera, seen);
}

// What keys show goes over what is there, each pixel once: its front is settled first.
Result<void> Painter::blend_keys(gl::Surface& far, const view::Camera& camera, const NovelOptions& options) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    Result<void> drawn = draw_pass(Pass::keys, &far, camera, options);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (!drawn) return drawn;
    glDepthFunc(GL_EQUAL);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    drawn = draw_pass(Pass::keys, &far, camera, options);
    glDisable(GL_BLEND);
    glDepthFunc(GL_GREATER);
    return drawn;
}

Result<void> Painter::draw(const gl::Target& target, gl::Surface* near, gl::Surface& far, const view::Camera& camera,
                           const NovelOptions& options) {
    assert(options.keys.size() <= kMostKeysAtOnce);
    passes_ = {0, 0, options.is_mask ? 0u : 1u};
    target.bind();
    clear_depth();
    const GLfloat nothing[4] = {0, 0, 0, 1};
    if (options.is_mask) glClearBufferfv(GL_COLOR, 0, nothing);
    bool fades = options.own_weight > 0 && !options.keys.empty() && !options.is_mask && !options.shows_sources;
    if (Result<void> drawn = draw_pass(Pass::near, near, camera, options); !drawn) return drawn;
    if (Result<void> drawn = draw_whole(far, camera, options, fades); !drawn) return drawn;
    if (!fades) {
        if (Result<void> drawn = draw_pass(Pass::keys, &far, camera, options); !drawn) return drawn;
    }
    if (Result<void> drawn = draw_pass(Pass::rest, &far, camera, options); !drawn) return drawn;
    if (!options.is_mask) far.draw_background(camera);
    if (fades) {
        if (Result<void> drawn = blend_keys(far, camera, options); !drawn) return drawn;
    }
    target.resolve();
    return {};
}

uint64_t Painter::resident_bytes() const {
    uint64_t bytes = 0;
    for (const Sprite& sprite : sprites_) bytes += uint64_t(sprite.width_px) * sprite.height_px * 8;
    return bytes;
}

}  // namespace overlook::lod_sprite
