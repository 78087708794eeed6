#include "tools/measure/paper/caveclod/targets.h"

#include <algorithm>
#include <functional>

#include "tools/measure/page_text.h"

namespace overlook::measure::paper::cameras {
namespace {

using Value = std::optional<double>;
using Of = std::function<Value(const FlownSubject&)>;

// Of all terrains that worst for the goal.
Value worst(const Flown& flown, bool is_at_least, const Of& of) {
    Value value;
    for (const FlownSubject& subject : flown.subjects) {
        Value one = of(subject);
        if (one && (!value || (is_at_least ? *one < *value : *one > *value))) value = one;
    }
    return value;
}

// "Three Lakes 25.3, Cliff 24.1".
std::string each(const Flown& flown, const Of& of) {
    std::string text;
    for (const FlownSubject& subject : flown.subjects)
        if (Value value = of(subject))
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", title_of(subject), short_number(*value));
    return text;
}

Value active_of(const FlownSubject& subject, Way way) {
    Value most;
    for (const Flyover& flyover : subject.flyovers)
        if (flyover.way == way) most = std::max(most.value_or(0), active_bytes_a_face(flyover));
    return most;
}

Value glides_of(const FlownSubject& subject) {
    Value most;
    for (const Flyover& flyover : subject.flyovers)
        if (flyover.way == Way::own) most = std::max(most.value_or(0), glide_bytes_a_face(flyover));
    return most;
}

Target target(const char* name, const char* printed, double goal, bool is_at_least) {
    return {name, printed, goal, is_at_least, {}, "", ""};
}

// Both columns of a target by the worst terrain; each terrain of Overlook's in the note.
Target by_terrain(const Flown& flown, Target is, const Of& printed, const Of& own, const std::string& note) {
    is.measured = {worst(flown, is.is_at_least, printed), worst(flown, is.is_at_least, own)};
    is.note = note + each(flown, own);
    return is;
}

Target operations(const Flown& flown) {
    auto ratio = [](Way way) { return Of([way](const FlownSubject& s) { return operations_ratio(s, way, kMostCameras); }); };
    Target is =
        by_terrain(flown, target("splits and collapses a second and camera: times fewer than shared", "more than 7", 10, true),
                   ratio(Way::printed), ratio(Way::own), "four cameras, equal pixel error; the least of the terrains. ");
    if (!is.is_reached(1)) is.why = "the cameras move so far from frame to frame that most of what one sees is new to it";
    return is;
}

Target camera_memory(const Flown& flown) {
    Target is = by_terrain(
        flown, target("fixed memory of one more camera, % of the static part", "10.5", 1, false),
        [](const FlownSubject& s) {
            return Value(100 * double(s.memory.counted.terms.cameras) / double(s.memory.counted.terms.static_bytes()));
        },
        [](const FlownSubject& s) {
            return Value(100 * double(s.memory.counted.own_camera_bytes) / double(s.memory.counted.own_static_bytes));
        },
        "three bits of each split; each of its own static part. ");
    if (!is.is_reached(1)) is.why = "the three bits of each split are more than a hundredth of so small a mesh";
    return is;
}

Target active_memory(const Flown& flown) {
    auto active = [](Way way) { return Of([way](const FlownSubject& s) { return active_of(s, way); }); };
    Target is =
        by_terrain(flown, target("active state, bytes a triangle", "42", 24, false), active(Way::printed), active(Way::own),
                   "mean over a flyover, the worst of 1 to 4 cameras; 12 a node and 36 a polygon in the paper. ");
    if (!is.is_reached(1))
        is.why = "16 bytes of indices and face and 4.6 to 5.3 of its handle are needed; beside them what glides (bytes a triangle: " +
                 each(flown, [](const FlownSubject& s) { return glides_of(s); }) +
                 "), and the last page of each surface, which few triangles fill";
    return is;
}

Target static_memory(const Flown& flown) {
    Target is = by_terrain(
        flown, target("static hierarchy in memory, bytes a triangle", "73 to 79", 40, false),
        [](const FlownSubject& s) { return Value(double(s.memory.counted.terms.static_bytes()) / double(s.face_count)); },
        [](const FlownSubject& s) { return Value(double(s.memory.counted.own_static_bytes) / double(s.face_count)); },
        "all attributes; pictures of surfaces left out. ");
    if (!is.is_reached(1)) is.why = "records of many needs and moves: vertices of high valence";
    return is;
}

Target parallel(const Flown& flown) {
    const Speed& speed = flown.speed;
    Target is = target("four cameras on all threads: times faster than on one", "sequential", 1.8, true);
    is.measured = {std::nullopt, speed.is_same ? Value(speed.gain()) : std::nullopt};
    is.note = fmt::format(
        "{} threads; {} ms a run on one, {} ms on all, of each frame the least of {} runs, in turns; index buffers {}",
        speed.threads, short_number(speed.single_ms), short_number(speed.parallel_ms), kSpeedRepeats,
        speed.is_same ? "the same to the byte" : "DIFFER");
    if (!is.is_reached(1))
        is.why = fmt::format(
            "a frame of four cameras takes {} us on one thread, so little that waking another costs much of what "
            "it gains, and nothing is gained where other work has the second core",
            short_number(1000 * speed.single_ms / flown.flying.frames));
    return is;
}

Target refinement(const Flown& flown) {
    const Speed& speed = flown.speed;
    Target is = target("refinement, ns an active triangle and frame", "9.5 (Hoppe's code)", 8, false);
    is.measured = {speed.printed_ns(), speed.own_ns()};
    is.note = fmt::format(
        "camera A on the whole screen, one thread; at least {} bytes a triangle are touched, {} GB/s, {} % of the {} GB/s that "
        "all threads move through memory in this run",
        short_number(speed.bytes_a_face()), short_number(speed.own_gb_s()),
        short_number(100 * speed.own_gb_s() / speed.bandwidth_gb_s), short_number(speed.bandwidth_gb_s));
    if (!is.is_reached(1))
        is.why = fmt::format("{} triangles in the mean: what a frame costs beside them, and the machine's own noise, weigh more",
                             short_count(speed.own_faces / flown.flying.frames));
    return is;
}

}  // namespace

std::vector<std::string> target_columns() {
    return {name_of(Way::printed), name_of(Way::own)};
}

std::vector<Target> targets_of(const Flown& flown) {
    return {operations(flown),    camera_memory(flown), active_memory(flown),
            static_memory(flown), parallel(flown),      refinement(flown)};
}

}  // namespace overlook::measure::paper::cameras
