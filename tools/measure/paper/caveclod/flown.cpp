#include "tools/measure/paper/caveclod/flown.h"

#include <algorithm>

namespace overlook::measure::paper::cameras {
namespace {

double per_s(const Window& window, size_t camera, double step_s, uint32_t CameraRecord::*count) {
    double sum = 0;
    for (const FlownFrame& frame : window.frames) sum += frame.cameras[camera].*count;
    return sum / (double(window.frames.size()) * step_s);
}

// All that a frame of a flyover takes: the static part in its own form and what its cameras keep.
double bytes_of(const FlownSubject& subject, const Flyover& flyover, const FlownFrame& frame) {
    bool is_own = flyover.way == Way::own || flyover.way == Way::shared;
    double bytes = double(is_own ? subject.memory.counted.own_static_bytes : subject.memory.counted.terms.static_bytes());
    for (const CameraRecord& camera : frame.cameras) bytes += double(camera.memory.fixed_bytes + camera.memory.active_bytes);
    return bytes;
}

template <class Of>
double mean_over(const std::vector<FlownFrame>& frames, const Of& of) {
    double sum = 0;
    for (const FlownFrame& frame : frames) sum += of(frame);
    return sum / double(std::max<size_t>(1, frames.size()));
}

double faces_of(const FlownFrame& frame) {
    double faces = 0;
    for (const CameraRecord& camera : frame.cameras) faces += double(camera.face_count);
    return faces;
}

double bytes_a_face(const Flyover& flyover, uint64_t CameraMemory::*kind) {
    double bytes = 0, faces = 0;
    for (const FlownFrame& frame : flyover.frames) {
        for (const CameraRecord& camera : frame.cameras) bytes += double(camera.memory.*kind);
        faces += faces_of(frame);
    }
    return bytes / std::max(1.0, faces);
}

template <class Row>
void each_flyover(const Flown& flown, const Row& row) {
    for (const FlownSubject& subject : flown.subjects)
        for (const Flyover& flyover : subject.flyovers) row(subject, flyover);
}

}  // namespace

const Flyover* FlownSubject::find(Way way, uint32_t cameras, double step) const {
    auto found = std::find_if(flyovers.begin(), flyovers.end(),
                              [&](const Flyover& one) { return one.way == way && one.cameras == cameras && one.step_s == step; });
    return found == flyovers.end() ? nullptr : &*found;
}

std::string title_of(const FlownSubject& subject) {
    return subject.memory.printed ? std::string(subject.memory.printed->title) : subject.name;
}

std::optional<double> operations_ratio(const FlownSubject& subject, Way way, uint32_t cameras) {
    const Flyover *one = subject.find(way, cameras), *shared = subject.find(Way::shared, cameras);
    if (one == nullptr || shared == nullptr || operations_per_s(*one) == 0) return std::nullopt;
    return operations_per_s(*shared) / operations_per_s(*one);
}

double active_bytes_a_face(const Flyover& flyover) {
    return bytes_a_face(flyover, &CameraMemory::active_bytes);
}
double glide_bytes_a_face(const Flyover& flyover) {
    return bytes_a_face(flyover, &CameraMemory::glide_bytes);
}

double mean_faces(const Flyover& flyover) {
    return mean_over(flyover.frames, faces_of) / flyover.cameras;
}

double mean_used_share(const Flyover& flyover) {
    double sum = 0, count = 0;
    for (const FlownFrame& frame : flyover.frames)
        if (frame.used_share) sum += *frame.used_share, count += 1;
    return sum / std::max(1.0, count);
}

std::string windows_csv(const Flown& flown) {
    std::string csv = "terrain,method,cameras,camera,time_s,splits_per_s,collapses_per_s,operations_per_s,triangles\n";
    each_flyover(flown, [&](const FlownSubject& subject, const Flyover& flyover) {
        if (flyover.step_s != subject.step_s) return;
        for (size_t camera = 0; camera < flyover.cameras; ++camera)
            for (const Window& window : windows_of(flyover)) {
                double splits = per_s(window, camera, flyover.step_s, &CameraRecord::split_count);
                double collapses = per_s(window, camera, flyover.step_s, &CameraRecord::collapse_count);
                double faces =
                    mean_over(window.frames, [&](const FlownFrame& frame) { return double(frame.cameras[camera].face_count); });
                csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", subject.name, name_of(flyover.way), flyover.cameras,
                                   char('A' + camera), window.time_s, splits, collapses, splits + collapses, faces);
            }
    });
    return csv;
}

std::string flyovers_csv(const Flown& flown) {
    std::string csv =
        "terrain,method,cameras,frames_per_s,frames,splits_per_s_and_camera,operations_per_s_and_camera,triangles_a_camera,"
        "active_bytes_a_triangle,used_vertex_share\n";
    each_flyover(flown, [&](const FlownSubject& subject, const Flyover& flyover) {
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", subject.name, name_of(flyover.way), flyover.cameras,
                           1 / flyover.step_s, flyover.frames.size(), splits_per_s(flyover), operations_per_s(flyover),
                           mean_faces(flyover), active_bytes_a_face(flyover), mean_used_share(flyover));
    });
    return csv;
}

std::string memory_csv(const Flown& flown) {
    std::string csv = "terrain,method,cameras,time_s,bytes\n";
    each_flyover(flown, [&](const FlownSubject& subject, const Flyover& flyover) {
        if (flyover.step_s != subject.step_s) return;
        for (const Window& window : windows_of(flyover))
            csv +=
                fmt::format("{},{},{},{},{}\n", subject.name, name_of(flyover.way), flyover.cameras, window.time_s,
                            mean_over(window.frames, [&](const FlownFrame& frame) { return bytes_of(subject, flyover, frame); }));
    });
    return csv;
}

std::string frame_rates_csv(const Flown& flown) {
    std::string csv = "time_s,with_fps,without_fps\n";
    for (const Rate& rate : flown.rates) csv += fmt::format("{},{},{}\n", rate.time_s, rate.with_fps, rate.without_fps);
    return csv;
}

}  // namespace overlook::measure::paper::cameras
