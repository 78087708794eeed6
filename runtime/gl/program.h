// Shader programs.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"

namespace overlook::gl {

struct Stage {
    GLenum kind = GL_VERTEX_SHADER;
    std::string_view source;  // GLSL with its #version line
};

class Program {
  public:
    Program() = default;
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    // Compiles and links. `name` stands in messages. Fails with Exit::our_bug (shaders are ours) and the compiler's first
    // complaint: "shader terrain (vertex): 0:12(3): error: `heigth' undeclared".
    static Result<Program> make(const std::string& name, const std::vector<Stage>& stages);

    void use() const;
    // The uniform's place, or -1 (which OpenGL ignores) if the program has none of that name.
    GLint at(const char* uniform) const;

  private:
    GLuint id_ = 0;
};

}  // namespace overlook::gl
