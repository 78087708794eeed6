// An OpenGL 4.5 core context without a window, and what is known of the renderer behind the current context.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "formats/result.h"

namespace overlook::gl {

struct Renderer {
    std::string name;          // GL_RENDERER, "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string version;       // GL_VERSION
    bool is_software = false;  // drawn by the processor: its times say nothing about a graphics card
};

// Counts the errors that OpenGL reports about the current context (by its debug output and by glGetError), from its
// making until its end. The context must stay current, and the counter alive, for as long as anything is drawn.
class ErrorCounter {
  public:
    ErrorCounter();
    // Errors so far; also empties OpenGL's own error flags.
    uint64_t count();
    // The first error's text, empty if there was none.
    const std::string& first() const { return log_->first; }

  private:
    struct Log {
        uint64_t count = 0;
        std::string first;
    };
    static void receive(unsigned source, unsigned type, unsigned id, unsigned severity, int length, const char* text,
                        const void* log);
    std::unique_ptr<Log> log_;
};

// Describes the current context. Fails with Exit::impossible if it is older than OpenGL 4.5:
// "OpenGL 4.5 is needed, this renderer has 3.1: softpipe".
Result<Renderer> describe_current_context();

// How EGL is asked for a context without a window.
enum class Platform {
    best,         // hardware, by whichever of the others gives it; else software
    surfaceless,  // Mesa's own
    device,       // EGL_EXT_platform_device: each device in turn
};

// A context that draws into framebuffer objects only. Made by EGL without a surface; where that gives no hardware or is
// refused, on the first EGL device that gives a context. LIBGL_ALWAYS_SOFTWARE=1 (Mesa's own switch) keeps it from
// looking for hardware. It is made current in the calling thread, and only there may it be used.
class Context {
  public:
    // Fails with Exit::impossible: "no OpenGL 4.5 without a window here: EGL is not installed (libEGL.so.1)".
    // Of one platform alone: "no OpenGL 4.5 without a window here: no EGL device gives a context".
    static Result<Context> headless(Platform platform = Platform::best);
    Context(Context&& other) noexcept;
    Context& operator=(Context&& other) noexcept;
    ~Context();

    const Renderer& renderer() const { return renderer_; }

  private:
    Context() = default;
    static Result<Context> on_display(void* display);
    void* display_ = nullptr;
    void* context_ = nullptr;
    Renderer renderer_;
};

// A context that shares textures, buffers and programs (framebuffers and vertex arrays not) with the one beside which it was
// made, for one other thread. It must not be current anywhere when it goes, and goes before the other.
class SecondContext {
  public:
    virtual ~SecondContext() = default;
    virtual bool make_current() = 0;  // in the calling thread
    virtual void release() = 0;       // from it
};
using SecondContextMaker = std::function<Result<std::unique_ptr<SecondContext>>()>;

// Beside the current context, which must be of a Context. Fails with Exit::impossible:
// "this renderer has no second context: EGL's is not the current one".
Result<std::unique_ptr<SecondContext>> second_context();

}  // namespace overlook::gl
