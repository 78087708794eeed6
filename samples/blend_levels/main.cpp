// blend_levels: two levels of one thing, a wide red square and a narrow blue one, drawn one a frame and put together by the two
// shader routines beside this file, visibility.glsl and combine.glsl, which any renderer can take. Prints which pixels show what.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "runtime/gl/context.h"
#include "runtime/gl/program.h"
#include "runtime/gl/target.h"
using namespace overlook;
constexpr GLsizei kSide = 64;
constexpr char kSquare[] =
    "#version 450 core\nuniform float half_m; out vec3 rest_m; void main() {"
    "rest_m = vec3(half_m * (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0), 0.0); gl_Position = vec4(rest_m.xy, 0.5, 1.0); }";
constexpr char kScreen[] =
    "#version 450 core\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }";
constexpr char kLevel[] =
    "in vec3 rest_m; uniform vec4 own; uniform float share; layout(location = 0) out vec4 colour; layout(location = 1) out uint id;"
    "void main() { if (!is_visible(rest_m, 1.0, share)) discard; colour = own; id = 1u; }";
constexpr char kPass[] = "out vec4 colour; void main() { colour = combined(ivec2(gl_FragCoord.xy), ivec2(64)); }";

gl::Program program_of(const char* vertex, const std::string& file, const char* main) {
    std::ifstream in(SHADERS "/" + file);
    std::string text = "#version 450 core\n" + std::string(std::istreambuf_iterator<char>(in), {}) + main;
    auto made = gl::Program::make(file, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, text}});
    if (!made) std::fprintf(stderr, "blend_levels: %s\n", made.error().message.c_str());
    return made ? std::move(*made) : gl::Program();
}
GLuint texture_of(GLenum format) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, 1, format, kSide, kSide);
    for (GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTextureParameteri(id, filter, GL_NEAREST);
    return id;
}

int main() {
    Result<gl::Context> context = gl::Context::headless();
    Result<gl::Target> target = context ? gl::Target::make(kSide, kSide, 1) : tl::unexpected(context.error());
    if (!target) return std::fprintf(stderr, "blend_levels: %s\n", target.error().message.c_str()), int(target.error().exit);
    gl::Program level = program_of(kSquare, "visibility.glsl", kLevel), pass = program_of(kScreen, "combine.glsl", kPass);
    gl::VertexArray nothing = gl::make_vertex_array();
    glBindVertexArray(nothing.id());
    unsigned char noise[kSide * kSide];
    for (unsigned i = 0; i < sizeof noise; ++i) noise[i] = static_cast<unsigned char>((i * 2654435761u) >> 24);
    GLuint visibility = texture_of(GL_R8), textures[6], framebuffers[2];
    glTextureSubImage2D(visibility, 0, 0, 0, kSide, kSide, GL_RED, GL_UNSIGNED_BYTE, noise);
    glCreateFramebuffers(2, framebuffers);
    const char* names[] = {"old_colour", "old_id", "old_depth", "new_colour", "new_id", "new_depth"};
    const GLenum formats[] = {GL_RGBA8, GL_R32UI, GL_DEPTH_COMPONENT32F};
    const GLenum places[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 6; ++i)
        glNamedFramebufferTexture(framebuffers[i / 3], places[i % 3], textures[i] = texture_of(formats[i % 3]), 0);
    for (int frame = 0; frame < 2; ++frame) {  // the wide level, then half of the narrow one
        glNamedFramebufferDrawBuffers(framebuffers[frame], 2, places);
        gl::bind_for_drawing(framebuffers[frame], kSide, kSide);
        const GLfloat zero[4] = {};
        const GLuint none[4] = {};
        glClearBufferfv(GL_COLOR, 0, zero), glClearBufferuiv(GL_COLOR, 1, none), glClearBufferfv(GL_DEPTH, 0, zero);
        level.use();
        glBindTextureUnit(0, visibility);
        glUniform1f(level.at("half_m"), frame == 0 ? 0.75f : 0.5f);
        glUniform1f(level.at("share"), frame == 0 ? 2.0f : 0.5f);
        glUniform4f(level.at("own"), frame == 0 ? 1.0f : 0.0f, 0, frame == 0 ? 0.0f : 1.0f, 1);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    target->bind();
    pass.use(), glDisable(GL_DEPTH_TEST);
    for (int i = 0; i < 6; ++i) glBindTextureUnit(GLuint(i), textures[i]), glUniform1i(pass.at(names[i]), i);
    const GLfloat still[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    glUniformMatrix4fv(pass.at("old_from_new"), 1, GL_FALSE, still);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target->resolve();
    ImageRgb8 picture = target->read();
    int counts[4] = {};
    for (size_t i = 0; i < picture.pixels.size(); i += 3) ++counts[(picture.pixels[i] > 0) + 2 * (picture.pixels[i + 2] > 0)];
    std::printf("the wide level: %d\nthe narrow level: %d\nboth: %d\n", counts[1], counts[2], counts[3]);
    return int(Exit::done);
}
