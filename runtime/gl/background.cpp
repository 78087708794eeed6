#include "runtime/gl/background.h"

#include <glm/gtc/type_ptr.hpp>

namespace overlook::gl {

void draw_background(const Program& program, const view::Camera& camera, const view::Part& part, const VertexArray& nothing) {
    glm::mat3 world_from_eye = glm::transpose(glm::mat3(view::rotation(camera)));
    program.use();
    glUniformMatrix3fv(program.at("world_from_eye"), 1, GL_FALSE, glm::value_ptr(world_from_eye));
    glUniform1f(program.at("focal_px"), float(view::focal_px(camera)));
    glUniform2f(program.at("middle_px"), float(camera.width_px) / 2, float(camera.height_px) / 2);
    glUniform2f(program.at("first_px"), float(part.left_px), float(double(camera.height_px) - part.top_px - part.height_px));
    glBindVertexArray(nothing.id());
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GEQUAL);  // it is drawn at depth 0
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
}

}  // namespace overlook::gl
