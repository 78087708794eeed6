#include <gtest/gtest.h>

#include "runtime/gl/program.h"
#include "runtime/gl/target.h"
#include "runtime/terrain/draw.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

constexpr std::string_view kPlainVertex = R"(#version 450 core
uniform vec2 corners[3];
void main() { gl_Position = vec4(corners[gl_VertexID], 0.5, 1.0); }
)";
constexpr std::string_view kRedFragment = R"(#version 450 core
out vec4 colour;
void main() { colour = vec4(1.0, 0.0, 0.0, 1.0); }
)";

TEST(Renderer, IsMarkedSoftwareWhereLlvmpipeDraws) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    EXPECT_TRUE(context->renderer().is_software);
    EXPECT_FALSE(context->renderer().version.empty());
}

// The way by which graphics cards without Mesa are reached, as far as a processor can go it.
TEST(Context, OfAnEglDeviceDrawsWhatTheSurfacelessOneDraws) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(any);
    any.reset();
    terrain::Terrain terrain = test::hilly_terrain(65);
    view::Camera camera = test::from_south(terrain, 96, 64);
    ImageRgb8 pictures[2];
    gl::Renderer renderers[2];
    for (int i = 0; i < 2; ++i) {
        Result<gl::Context> context = gl::Context::headless(i == 0 ? gl::Platform::surfaceless : gl::Platform::device);
        ASSERT_TRUE(context) << context.error().message;
        renderers[i] = context->renderer();
        Result<terrain::Drawing> drawing = terrain::Drawing::make(terrain);
        ASSERT_TRUE(drawing) << drawing.error().message;
        Result<gl::Target> target = gl::Target::make(96, 64, 4);
        ASSERT_TRUE(target) << target.error().message;
        drawing->draw(*target, test::everything(terrain), camera, {});
        pictures[i] = target->read();
    }
    EXPECT_TRUE(renderers[1].is_software);
    EXPECT_EQ(renderers[0].name, renderers[1].name);
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
    EXPECT_NE(test::pixel(pictures[1], 48, 4), test::pixel(pictures[1], 48, 60));
}

TEST(ErrorCounter, CountsWhatOpenGLReports) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    EXPECT_EQ(errors.count(), 0u);
    glEnable(GLenum(0xffff));
    EXPECT_EQ(errors.count(), 1u);
    EXPECT_FALSE(errors.first().empty());
}

TEST(Target, ReadsTopRowFirst) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (uint32_t samples : {1u, 4u}) {
        auto target = gl::Target::make(8, 6, samples);
        ASSERT_TRUE(target) << target.error().message;
        target->bind();
        const GLfloat blue[] = {0, 0, 1, 1}, green[] = {0, 1, 0, 1};
        glClearBufferfv(GL_COLOR, 0, blue);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 5, 8, 1);  // OpenGL counts rows from the bottom
        glClearBufferfv(GL_COLOR, 0, green);
        glDisable(GL_SCISSOR_TEST);
        target->resolve();
        ImageRgb8 image = target->read();
        for (uint32_t y = 0; y < 6; ++y) {
            test::Rgb expected = y == 0 ? test::Rgb{0, 255, 0} : test::Rgb{0, 0, 255};
            EXPECT_EQ(test::pixel(image, 3, y), expected) << "row " << y << ", " << samples << " samples";
        }
    }
}

TEST(Target, RefusesPicturesTooLargeForTheRenderer) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto target = gl::Target::make(1u << 30, 4, 1);
    ASSERT_FALSE(target);
    EXPECT_EQ(target.error().exit, Exit::impossible);
}

TEST(Program, DrawsATriangleWhereItLies) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    auto target = gl::Target::make(100, 100, 1);
    auto program = gl::Program::make("plain", {{GL_VERTEX_SHADER, kPlainVertex}, {GL_FRAGMENT_SHADER, kRedFragment}});
    ASSERT_TRUE(program) << program.error().message;
    gl::VertexArray nothing = gl::make_vertex_array();
    target->bind();
    const GLfloat black[] = {0, 0, 0, 1}, farthest = 0;
    glClearBufferfv(GL_COLOR, 0, black);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    program->use();
    const GLfloat upper_left[] = {-1, 1, 1, 1, -1, -1};
    glUniform2fv(program->at("corners"), 3, upper_left);
    glBindVertexArray(nothing.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ImageRgb8 image = target->read();

    for (uint32_t y = 0; y < 100; ++y) {
        for (uint32_t x = 0; x < 100; ++x) {
            if (x + y == 99) continue;  // the long side itself
            EXPECT_EQ(test::pixel(image, x, y).red, x + y < 99 ? 255 : 0) << x << ", " << y;
        }
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

TEST(Program, NamesStageAndPlaceOfAMistake) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto program = gl::Program::make("broken", {{GL_VERTEX_SHADER, "#version 450 core\nvoid main() { heigth = 1.0; }\n"}});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().message.rfind("shader broken (vertex): ", 0), 0u) << program.error().message;
    EXPECT_NE(program.error().message.find("heigth"), std::string::npos) << program.error().message;
    EXPECT_EQ(program.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace overlook
