#include "runtime/player/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include "runtime/gl/context.h"
#include "runtime/gl/png.h"
#include "runtime/player/controls.h"
#include "runtime/player/headless.h"
#include "runtime/player/overlay.h"
#include "runtime/player/record.h"
#include "runtime/player/report.h"
#include "runtime/view/flight.h"

namespace overlook::player {
namespace {

struct EndGlfw {
    ~EndGlfw() { glfwTerminate(); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, void (*)(GLFWwindow*)>;

// What GLFW's callbacks collect between two frames.
struct Events {
    double wheel = 0;
    Presses presses;
    bool toggle_overlay = false, take_picture = false, toggle_recording = false;
};

// The state of a window flight that lasts over frames.
struct Flight {
    view::Camera camera;
    Flyer flyer;
    FrameStyle style;  // its error is the one asked for; a budget may raise the frame's
    KeyWatch keys;
    bool shows_overlay = true;
    uint32_t picture_count = 0;
    double mouse_x_px = 0, mouse_y_px = 0;
    bool has_mouse = false;
    std::optional<Recording> recording;
};

std::string last_glfw_error() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return reason != nullptr ? reason : "no reason given";
}

tl::unexpected<Error> no_window(const std::string& reason) {
    return impossible("no window can be opened here: {}; --headless --image FILE.png draws without one", reason);
}

Result<WindowHandle> open_window(const Plan& plan) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    WindowHandle window(glfwCreateWindow(int(plan.width_px), int(plan.height_px), "Overlook", nullptr, nullptr),
                        glfwDestroyWindow);
    if (window == nullptr) return no_window(last_glfw_error());
    glfwMakeContextCurrent(window.get());
    glfwSwapInterval(1);
    return window;
}

// A window that nobody sees, for its context. Windows are made and ended by the main thread alone.
class SecondGlfwContext : public gl::SecondContext {
  public:
    explicit SecondGlfwContext(WindowHandle window) : window_(std::move(window)) {}
    bool make_current() override {
        glfwMakeContextCurrent(window_.get());
        return glfwGetCurrentContext() == window_.get();
    }
    void release() override { glfwMakeContextCurrent(nullptr); }

  private:
    WindowHandle window_;
};

Result<std::unique_ptr<gl::SecondContext>> second_context() {
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    WindowHandle window(glfwCreateWindow(1, 1, "Overlook", nullptr, glfwGetCurrentContext()), glfwDestroyWindow);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    if (window == nullptr) return impossible("this renderer has no second context: {}", last_glfw_error());
    return std::make_unique<SecondGlfwContext>(std::move(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_RELEASE) return;
    Events& events = *static_cast<Events*>(glfwGetWindowUserPointer(window));
    switch (key) {
        case GLFW_KEY_ESCAPE:
            glfwSetWindowShouldClose(window, GLFW_TRUE);
            break;
        case GLFW_KEY_F:
            events.presses.toggles_wireframe = !events.presses.toggles_wireframe;
            break;
        case GLFW_KEY_K:
            events.presses.toggles_sources = !events.presses.toggles_sources;
            break;
        case GLFW_KEY_M:
            if (action == GLFW_PRESS) ++events.presses.method;
            break;
        case GLFW_KEY_H:
            events.toggle_overlay = !events.toggle_overlay;
            break;
        case GLFW_KEY_P:
            events.take_picture = true;
            break;
        case GLFW_KEY_R:
            events.toggle_recording = !events.toggle_recording;
            break;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            ++events.presses.error;
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            --events.presses.error;
            break;
        default:
            break;
    }
}

void on_wheel(GLFWwindow* window, double, double notches) {
    static_cast<Events*>(glfwGetWindowUserPointer(window))->wheel += notches;
}

bool is_down(GLFWwindow* window, std::initializer_list<int> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; });
}

Input read_input(GLFWwindow* window, const Events& events, Flight& flight) {
    auto axis = [&](std::initializer_list<int> plus, std::initializer_list<int> minus) {
        return double(is_down(window, plus)) - double(is_down(window, minus));
    };
    Input input;
    input.forward = axis({GLFW_KEY_W, GLFW_KEY_UP}, {GLFW_KEY_S, GLFW_KEY_DOWN});
    input.right = axis({GLFW_KEY_D, GLFW_KEY_RIGHT}, {GLFW_KEY_A, GLFW_KEY_LEFT});
    input.up = axis({GLFW_KEY_E, GLFW_KEY_SPACE}, {GLFW_KEY_Q, GLFW_KEY_LEFT_CONTROL});
    input.is_fast = is_down(window, {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT});
    input.wheel = events.wheel;

    double x_px = 0, y_px = 0;
    glfwGetCursorPos(window, &x_px, &y_px);
    if (flight.has_mouse) {
        input.turn_x_px = x_px - flight.mouse_x_px;
        input.turn_y_px = y_px - flight.mouse_y_px;
    }
    flight.mouse_x_px = x_px;
    flight.mouse_y_px = y_px;
    flight.has_mouse = true;
    return input;
}

FrameStyle style_of(const Flight& flight, const view::ErrorController& controller) {
    FrameStyle style = flight.style;
    if (takes_budgets(style.method)) style.error_px = controller.error_px();
    return style;
}

// The hands act in the thing's own frame.
void fly_over(const Scene& scene, view::Camera& camera, Flyer& flyer, const Input& input, double dt_s) {
    view::Camera local = view::camera_into(scene.transform(), camera);
    fly(local, flyer, input, dt_s, scene.subject());
    camera = view::camera_out_of(scene.transform(), local);
}

// The target follows the window's size; none while the window is minimised.
Result<void> fit_target(GLFWwindow* window, uint32_t samples, std::optional<gl::Target>& target) {
    int width_px = 0, height_px = 0;
    glfwGetFramebufferSize(window, &width_px, &height_px);
    if (width_px <= 0 || height_px <= 0) {
        target.reset();
        return {};
    }
    if (target && target->width_px() == uint32_t(width_px) && target->height_px() == uint32_t(height_px)) return {};
    Result<gl::Target> made = gl::Target::make(uint32_t(width_px), uint32_t(height_px), samples);
    if (!made) return tl::unexpected(made.error());
    target.emplace(std::move(*made));
    return {};
}

Result<void> take_picture(const gl::Target& target, const command::Common& common, Flight& flight) {
    std::string path = fmt::format("overlook-{:04}.png", flight.picture_count++);
    Result<void> written = write_png(path, target.read());
    if (written) command::note(common, "player: wrote " + path);
    return written;
}

// Ends a recording that runs: thinned, written, said.
Result<void> end_recording(const Plan& plan, const command::Common& common, Flight& flight) {
    if (!flight.recording) return {};
    Recording recording = std::move(*flight.recording);
    flight.recording.reset();
    Result<std::string> path = write_recording(recording, plan.options.record);
    if (!path) return tl::unexpected(path.error());
    command::note(common, fmt::format("player: recorded {:.1f} s: {}", recording.samples.back().time_s, *path));
    return {};
}

// Begins, goes on with or ends the recording.
Result<void> record(const Plan& plan, const command::Common& common, bool is_toggled, double now_s, Flight& flight) {
    if (is_toggled && flight.recording) return end_recording(plan, common, flight);
    if (is_toggled) flight.recording.emplace(Recording{now_s, {}});
    if (flight.recording && !add_sample(*flight.recording, flight.camera, now_s)) {
        command::note(common, "player: the recording is as long as a flight can be");
        return end_recording(plan, common, flight);
    }
    return {};
}

void show(GLFWwindow* window, const gl::Target& target, const Flight& flight, const FrameRecord& record,
          const gl::Renderer& renderer, Overlay& overlay) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    target.show(target.width_px(), target.height_px());
    if (flight.shows_overlay) {
        overlay.draw({&record, &renderer, flight.style.method, flight.style.shows_sources, flight.keys, record.asked_error_px,
                      flight.flyer.speed_factor, target.width_px(), target.height_px(), flight.recording.has_value()});
    }
    glfwSwapBuffers(window);
}

// Draws until the window closes or the plan's frames are done.
Result<void> fly_until_end(const Plan& plan, const command::Common& common, Scene& scene, GLFWwindow* window,
                           const gl::Renderer& renderer) {
    Events events;
    glfwSetWindowUserPointer(window, &events);
    glfwSetKeyCallback(window, on_key);
    glfwSetScrollCallback(window, on_wheel);
    glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_DISABLED);
    Overlay overlay(window);

    Flight flight;
    flight.camera = view::camera_at(plan.flight, 0, plan.base);
    flight.style = {*plan.method,
                    scene.subject().thing(),
                    plan.options.error_px,
                    plan.options.morph,
                    plan.options.rings,
                    plan.draw,
                    0,
                    plan.options.triangles,
                    plan.options.frame_ms,
                    plan.options.pipelined};
    view::ErrorController controller(budget_of(plan.options, flight.style.method, flight.style.thing, flight.style.error_px));
    std::optional<gl::Target> target;
    std::vector<FrameRecord> records;
    double last_s = glfwGetTime();
    const uint32_t frame_count = plan.options.frames;
    for (uint32_t frame = 0; !glfwWindowShouldClose(window) && (frame_count == 0 || frame < frame_count);) {
        events = {};
        glfwPollEvents();
        double now_s = glfwGetTime();
        Input input = read_input(window, events, flight);
        if (scene.subject().has_one_method()) events.presses.method = 0;
        press(flight.style, events.presses);
        if (events.toggle_overlay) flight.shows_overlay = !flight.shows_overlay;
        if (frame_count > 0 && plan.flight.keys.size() > 1)
            flight.camera = view::camera_at(plan.flight, scene::frame_time_s(plan.flight, frame), plan.base);
        else
            fly_over(scene, flight.camera, flight.flyer, input, now_s - last_s);
        flight.style.dt_s = frame_count > 0 ? plan.flight.step_s : now_s - last_s;
        last_s = now_s;
        if (Result<void> kept = record(plan, common, events.toggle_recording, now_s, flight); !kept) return kept;

        if (Result<void> fitted = fit_target(window, plan.options.samples, target); !fitted) return fitted;
        if (!target) {
            glfwWaitEventsTimeout(0.1);
            continue;
        }
        flight.camera.width_px = target->width_px();
        flight.camera.height_px = target->height_px();
        if (events.presses.error != 0 || events.presses.method != 0)
            controller.set_budget(budget_of(plan.options, flight.style.method, flight.style.thing, flight.style.error_px));
        Result<FrameRecord> record = scene.draw(*target, flight.camera, style_of(flight, controller));
        if (!record) return tl::unexpected(record.error());
        if (takes_budgets(flight.style.method)) controller.frame_done(cost_of(plan.options, *record));
        watch(flight.keys, *record);
        if (record->stream) {
            for (const Error& fault : record->stream->faults) command::note(common, "player: " + fault.message);
        }
        show(window, *target, flight, *record, renderer, overlay);
        if (events.take_picture) {
            if (Result<void> taken = take_picture(*target, common, flight); !taken) return taken;
        }
        ++frame;
        if (frame_count > 0) {
            records.push_back(*record);
            if (Result<void> written = write_picture(plan, *target, frame - 1, frame == frame_count); !written) return written;
        }
    }
    if (Result<void> ended = end_recording(plan, common, flight); !ended) return ended;
    return frame_count > 0 ? deliver_report(plan, common, renderer, records) : Result<void>();
}

}  // namespace

bool has_display() {
    const char* x11 = std::getenv("DISPLAY");
    const char* wayland = std::getenv("WAYLAND_DISPLAY");
    return (x11 != nullptr && *x11 != '\0') || (wayland != nullptr && *wayland != '\0');
}

Result<void> run_in_window(Plan plan, const command::Common& common, Scene read_scene) {
    if (!glfwInit()) return no_window(last_glfw_error());
    EndGlfw end_glfw;
    Result<WindowHandle> window = open_window(plan);
    if (!window) return tl::unexpected(window.error());
    Result<gl::Renderer> renderer = gl::describe_current_context();
    if (!renderer) return tl::unexpected(renderer.error());

    choose_samples(plan, renderer->is_software, true);
    gl::ErrorCounter errors;
    Scene scene = std::move(read_scene);  // goes before the window and its context
    if (Result<void> uploaded = scene.upload(second_context); !uploaded) return uploaded;
    settle(plan, scene);
    Result<void> flown = fly_until_end(plan, common, scene, window->get(), *renderer);
    if (flown && errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    return flown;
}

}  // namespace overlook::player
