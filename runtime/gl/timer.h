// How long a frame takes.
#pragma once

#include <epoxy/gl.h>

#include <chrono>

namespace overlook::gl {

// From its making. Waiting for the renderer costs a little overlap between frames and gives times that mean something on every
// driver, software ones included.
class Timer {
  public:
    double elapsed_ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    }
    // Until everything that was submitted is drawn.
    double finished_ms() const {
        glFinish();
        return elapsed_ms();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace overlook::gl
