#include "runtime/gl/program.h"

#include <algorithm>
#include <utility>

namespace overlook::gl {
namespace {

const char* stage_name(GLenum kind) {
    switch (kind) {
        case GL_VERTEX_SHADER:
            return "vertex";
        case GL_GEOMETRY_SHADER:
            return "geometry";
        case GL_FRAGMENT_SHADER:
            return "fragment";
        default:
            return "shader";
    }
}

std::string first_line(std::string log) {
    log.resize(std::min(log.find('\n'), log.size()));
    while (!log.empty() && (log.back() == '\0' || log.back() == ' ')) log.pop_back();
    return log.empty() ? "no reason given" : log;
}

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
    return first_line(log);
}

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, GLsizei(log.size()), nullptr, log.data());
    return first_line(log);
}

// Compiles a stage and hangs it into the program, which then owns it.
Result<void> attach(GLuint program, const std::string& name, const Stage& stage) {
    GLuint shader = glCreateShader(stage.kind);
    const char* text = stage.source.data();
    GLint length = GLint(stage.source.size());
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    std::string log = is_compiled == GL_TRUE ? "" : shader_log(shader);
    if (is_compiled == GL_TRUE) glAttachShader(program, shader);
    glDeleteShader(shader);
    if (is_compiled == GL_TRUE) return {};
    return tl::unexpected(Error{Exit::our_bug, fmt::format("shader {} ({}): {}", name, stage_name(stage.kind), log)});
}

}  // namespace

Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

Result<Program> Program::make(const std::string& name, const std::vector<Stage>& stages) {
    Program made;
    made.id_ = glCreateProgram();
    for (const Stage& stage : stages) {
        if (Result<void> attached = attach(made.id_, name, stage); !attached) return tl::unexpected(attached.error());
    }
    glLinkProgram(made.id_);
    GLint is_linked = GL_FALSE;
    glGetProgramiv(made.id_, GL_LINK_STATUS, &is_linked);
    if (is_linked == GL_TRUE) return made;
    return tl::unexpected(Error{Exit::our_bug, fmt::format("shader {}: {}", name, program_log(made.id_))});
}

void Program::use() const {
    glUseProgram(id_);
}

GLint Program::at(const char* uniform) const {
    return glGetUniformLocation(id_, uniform);
}

}  // namespace overlook::gl
