#include "runtime/wang_ldi/draw_composite.h"

#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "runtime/gl/surface_shaders.h"
#include "runtime/terrain/draw_shaders.h"

namespace overlook::wang_ldi {
namespace {

// Colours are mixed with the air in linear light; where the air is clear they stay as they are, to the bit.
constexpr char kComposite[] = R"(
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D depths_m;
uniform mat3 world_from_eye;
uniform float focal_px;
uniform vec2 middle_px;
uniform float near_m;
uniform float finer;
out vec4 colour;

vec3 linear_of(vec3 encoded) {
    vec3 low = encoded / 12.92, high = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThanEqual(encoded, vec3(0.04045)));
}

void main() {
    ivec2 size = textureSize(colours, 0), at = ivec2(gl_FragCoord.xy * finer);
    at.y = size.y - 1 - at.y;
    vec4 own = texelFetch(colours, at, 0);
    if (own.a == 0.0) discard;
    float depth_m = texelFetch(depths_m, at, 0).r;
    gl_FragDepth = near_m / depth_m;
    colour = vec4(own.rgb, 1.0);
    if (haze_per_m == 0.0) return;
    vec3 at_m = world_from_eye * vec3((gl_FragCoord.xy - middle_px) / focal_px, -1.0) * depth_m;
    colour.rgb = encoded(behind_air(linear_of(own.rgb), at_m));
}
)";

gl::Texture make_plane(GLenum format, uint32_t width_px, uint32_t height_px) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, 1, format, GLsizei(width_px), GLsizei(height_px));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return gl::Texture(id);
}

}  // namespace

Result<Composite> Composite::make() {
    Composite made;
    std::string fragment = std::string(gl::shaders::kEncoding) + terrain::shaders::kAir + kComposite;
    Result<gl::Program> program =
        gl::Program::make("composite", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, fragment}});
    if (!program) return tl::unexpected(program.error());
    made.program_ = std::move(*program);
    made.nothing_ = gl::make_vertex_array();
    return made;
}

void Composite::fit(uint32_t width_px, uint32_t height_px) {
    if (width_px == width_px_ && height_px == height_px_) return;
    width_px_ = width_px, height_px_ = height_px;
    colours_ = make_plane(GL_RGBA8, width_px_, height_px_);
    depths_ = make_plane(GL_R32F, width_px_, height_px_);
}

uint64_t Composite::take(const Warped& picture) {
    fit(picture.width_px, picture.height_px);
    auto width = GLsizei(width_px_), height = GLsizei(height_px_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(colours_.id(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture.colours.data());
    glTextureSubImage2D(depths_.id(), 0, 0, 0, width, height, GL_RED, GL_FLOAT, picture.depth_m.data());
    return uint64_t(width_px_) * height_px_ * (sizeof(uint32_t) + sizeof(float));
}

void Composite::draw(const gl::Target& target, const view::Camera& camera, double haze_per_m) const {
    target.bind();
    auto finer = float(width_px_) / float(target.width_px());
    glm::mat3 world_from_eye = glm::transpose(glm::mat3(view::rotation(camera)));
    program_.use();
    glUniformMatrix3fv(program_.at("world_from_eye"), 1, GL_FALSE, glm::value_ptr(world_from_eye));
    glUniform1f(program_.at("focal_px"), float(view::focal_px(camera)));
    glUniform2f(program_.at("middle_px"), float(camera.width_px) / 2, float(camera.height_px) / 2);
    glUniform1f(program_.at("near_m"), float(camera.near_m));
    glUniform1f(program_.at("haze_per_m"), float(haze_per_m));
    glUniform1f(program_.at("finer"), finer);
    glBindTextureUnit(0, colours_.id());
    glBindTextureUnit(1, depths_.id());
    glBindVertexArray(nothing_.id());
    if (finer > 1) {
        glEnable(GL_SAMPLE_SHADING);
        glMinSampleShading(1);
    }
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SAMPLE_SHADING);
    target.resolve();
}

}  // namespace overlook::wang_ldi
