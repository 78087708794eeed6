// The seam to EGL.

#include "runtime/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace overlook::gl {
namespace {

constexpr int kNeededVersion = 45;
constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_CONTEXT_OPENGL_DEBUG,
                                  EGL_TRUE,
                                  EGL_NONE};

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

bool names_software(const std::string& renderer) {
    for (const char* software : {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer"}) {
        if (renderer.find(software) != std::string::npos) return true;
    }
    return false;
}

bool has_extension(const char* list, std::string_view name) {
    std::string_view rest = list != nullptr ? list : "";
    while (!rest.empty()) {
        size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == name) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

bool hardware_is_refused() {
    const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value != nullptr && *value != '\0' && std::strcmp(value, "0") != 0 && std::strcmp(value, "false") != 0;
}

// Displays that need no window system: Mesa's own surfaceless one first, then every device.
EGLDisplay surfaceless_display(const char* extensions) {
    if (!has_extension(extensions, "EGL_MESA_platform_surfaceless")) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

std::vector<EGLDisplay> device_displays(const char* extensions) {
    bool can_ask = has_extension(extensions, "EGL_EXT_platform_device") &&
                   (has_extension(extensions, "EGL_EXT_device_enumeration") || has_extension(extensions, "EGL_EXT_device_base"));
    std::vector<EGLDisplay> displays;
    EGLint count = 0;
    if (!can_ask || !eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return displays;
    std::vector<EGLDeviceEXT> devices(size_t(count), nullptr);
    if (!eglQueryDevicesEXT(count, devices.data(), &count)) return displays;
    for (EGLint i = 0; i < count; ++i) {
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[size_t(i)], nullptr));
    }
    return displays;
}

tl::unexpected<Error> no_context(std::string_view reason) {
    return impossible("no OpenGL 4.5 without a window here: {}", reason);
}

}  // namespace

ErrorCounter::ErrorCounter() : log_(std::make_unique<Log>()) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&ErrorCounter::receive, log_.get());
}

void ErrorCounter::receive(unsigned, unsigned type, unsigned, unsigned, int, const char* text, const void* log) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    Log& mine = *static_cast<Log*>(const_cast<void*>(log));
    if (mine.count++ == 0) mine.first = text;
}

uint64_t ErrorCounter::count() {
    uint64_t told = log_->count;
    while (GLenum error = glGetError()) {
        if (told == 0 && log_->count++ == 0) log_->first = fmt::format("OpenGL error 0x{:04x}", error);
    }
    return log_->count;
}

Result<Renderer> describe_current_context() {
    Renderer renderer{text_of(GL_RENDERER), text_of(GL_VERSION), false};
    renderer.is_software = names_software(renderer.name);
    int version = epoxy_gl_version();
    if (version < kNeededVersion || !epoxy_is_desktop_gl()) {
        return impossible("OpenGL 4.5 is needed, this renderer has {}.{}: {}", version / 10, version % 10, renderer.name);
    }
    return renderer;
}

Result<Context> Context::on_display(void* display) {
    if (display == EGL_NO_DISPLAY) return impossible("no such display");
    if (!eglInitialize(display, nullptr, nullptr)) return impossible("EGL does not start");

    Context made;
    made.display_ = display;
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context") || !has_extension(extensions, "EGL_KHR_no_config_context")) {
        return impossible("EGL has no contexts without a surface");
    }
    if (!eglBindAPI(EGL_OPENGL_API)) return impossible("EGL has no desktop OpenGL");
    made.context_ = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
    if (made.context_ == EGL_NO_CONTEXT) return impossible("the renderer has no OpenGL 4.5");
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, made.context_)) return impossible("EGL refuses the context");

    Result<Renderer> renderer = describe_current_context();
    if (!renderer) return tl::unexpected(renderer.error());
    made.renderer_ = *renderer;
    return made;
}

Result<Context> Context::headless(Platform platform) {
    // libepoxy ends the process when a library is not there, so it is asked only if it is.
    if (dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL) == nullptr) {
        return no_context("EGL is not installed (libEGL.so.1)");
    }
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_EXT_platform_base")) return no_context("EGL is too old");

    Result<Context> plain = impossible("no EGL device gives a context");
    if (platform != Platform::device) plain = on_display(surfaceless_display(extensions));
    if (platform == Platform::surfaceless && !plain) return no_context(plain.error().message);
    if (platform == Platform::surfaceless) return plain;
    if (plain && (!plain->renderer().is_software || hardware_is_refused())) return plain;
    for (EGLDisplay display : device_displays(extensions)) {
        Result<Context> on_device = on_display(display);
        if (!on_device) continue;
        bool is_better = !on_device->renderer().is_software || !plain;
        if (is_better && !(hardware_is_refused() && !on_device->renderer().is_software)) return on_device;
    }
    if (!plain) return no_context(plain.error().message);
    if (!eglMakeCurrent(plain->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, plain->context_)) {
        return no_context("EGL refuses the context");
    }
    return plain;
}

Context::Context(Context&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)),
      context_(std::exchange(other.context_, nullptr)),
      renderer_(std::move(other.renderer_)) {}

Context& Context::operator=(Context&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    std::swap(renderer_, other.renderer_);
    return *this;
}

Context::~Context() {
    if (context_ == nullptr) return;
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    // The display stays: it belongs to the whole process, and another context may live on it.
}

namespace {

class SecondEglContext : public SecondContext {
  public:
    SecondEglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~SecondEglContext() override { eglDestroyContext(display_, context_); }
    // Which API a thread means is a matter of the thread.
    bool make_current() override {
        return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }
    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  private:
    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<SecondContext>> second_context() {
    // As above: libepoxy must not be asked for a library that is not there.
    bool has_egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL) != nullptr;
    EGLContext beside = has_egl ? eglGetCurrentContext() : EGL_NO_CONTEXT;
    if (beside == EGL_NO_CONTEXT) return impossible("this renderer has no second context: EGL's is not the current one");
    EGLDisplay display = eglGetCurrentDisplay();
    EGLContext made = eglCreateContext(display, EGL_NO_CONFIG_KHR, beside, kAttributes);
    if (made == EGL_NO_CONTEXT) return impossible("this renderer has no second context: EGL refuses one that shares its objects");
    return std::make_unique<SecondEglContext>(display, made);
}

}  // namespace overlook::gl
