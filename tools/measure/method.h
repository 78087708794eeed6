// What a method of Overlook has to offer to be measured beside others.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/gl/target.h"
#include "runtime/view/camera.h"
#include "tools/measure/numbers/honesty.h"

namespace overlook::measure {

// What one frame took: exact, and the same on every run.
struct Counters {
    uint64_t triangle_count = 0;          // submitted
    uint64_t vertex_reference_count = 0;  // indices (or vertices, where there are none) submitted
    uint64_t draw_call_count = 0;
    uint64_t uploaded_bytes = 0;
    uint64_t tested_count = 0;        // places looked at to decide
    uint64_t resident_bytes = 0;      // in the renderer's memory while the frame is drawn
    uint64_t streamed_bytes = 0;      // of what is streamed, there: what its budget counts
    uint64_t event_count = 0;         // sudden changes that the method knows of: a new keyframe, a level exchanged at once
    uint64_t key_triangle_count = 0;  // of the triangles, those drawn into keyframes
    uint64_t key_pixel_count = 0;     // of keyframes, drawn besides the picture's own
    uint64_t operation_count = 0;     // splits and collapses, of all cameras
    uint64_t transition_count = 0;    // instances on their way from level to level
    uint64_t sample_count = 0;        // of layered depth images, warped
    uint64_t tile_count = 0;          // of planted ground, drawn by them
    uint64_t outside_count = 0;       // of those, seen from where they were not sampled for
    bool is_eye_outside = false;      // of planted ground: not as high above it as images were sampled for
    uint64_t missing_count = 0;       // images that another stood in for, or none
    uint64_t camera_bytes = 0;        // what cameras keep in main memory beside what they share
    uint64_t wrong_corner_count = 0;  // of triangles drawn with the attributes of another face
    double predicted_error_px = 0;

    bool operator==(const Counters&) const = default;
};

// Where the pixels of a frame came from, of a method that shows pictures again.
struct Sources {
    static constexpr uint8_t kOwn = 64;    // a coarse surface's own colours, because no picture shows it
    static constexpr uint8_t kNear = 128;  // geometry as fine as asked, on purpose: neither a ghost nor a loss
    std::vector<uint8_t> of_pixel;   // [height, width] top row first: bit k = keys[k] shows it, or the above; 0 = background
    std::vector<view::Camera> keys;  // of the pictures in use, at most 6; their sizes are the pictures'
};

// One method with one setting. Frames come in the order of the flight, each once: first decide, then draw, then perhaps draw
// again into other targets, which must give the same picture, of their samples. A context must be current.
class Method {
  public:
    virtual ~Method() = default;
    // Before the first frame: whatever later frames would do once, for a camera and a target like theirs, which is drawn over.
    // They are the same as without.
    virtual void prepare(const view::Camera& camera, const gl::Target& target) {
        static_cast<void>(camera);
        static_cast<void>(target);
    }
    // Settles what is drawn of this frame. camera: its size is the picture's. frame: from 0, one logical step apart.
    virtual void decide(const view::Camera& camera, uint32_t frame) = 0;
    // Draws what was decided, sky and all, and resolves the target; need not wait until it is drawn.
    virtual Counters draw(const gl::Target& target) = 0;
    // From the next frame on, so many triangles may be drawn a frame. 0: as many as it takes. Returns whether the method keeps
    // budgets.
    virtual bool set_triangles(double triangles) {
        static_cast<void>(triangles);
        return false;
    }
    // Of the frame decided last, measured against the source; nothing of a method that promises nothing. Takes its time, which
    // is nobody's frame's; the pictures after it are the same as without it.
    virtual std::optional<Promises> promises() { return std::nullopt; }
    // Of the frame drawn last, at the pixels' middles; nothing where it used no picture. middle: has one sample a pixel and the
    // frame's size, and is drawn over. The pictures after it are the same as without it.
    virtual std::optional<Sources> sources(const gl::Target& middle) {
        static_cast<void>(middle);
        return std::nullopt;
    }
};

// A method as it was asked for: "terrain@error-px=2@samples=4".
struct MethodSpec {
    std::string name;
    std::string variant;                                   // "" = the default one
    std::vector<std::pair<std::string, double>> settings;  // all that the method has, in its own order

    bool operator==(const MethodSpec&) const = default;
};

// "terrain:hard@error-px=2@samples=4": the name of a run in all outputs. Of settings that are seldom changed (a budget, a remedy
// switched off) only those that are not the defaults.
std::string label_of(const MethodSpec& spec);

// "terrain:hard", or "terrain@triangles" for runs within a budget: all runs of one curve share it.
std::string family_of(const MethodSpec& spec);

// The value of a setting that the method has.
double setting(const MethodSpec& spec, const std::string& name);

}  // namespace overlook::measure
