// Any bytes as a scene, a flight and a case: nothing may crash or leak; a mistake is one line; what is read is in range, is
// written as it was read, and can be flown.
#include <cmath>
#include <cstdint>

#include "formats/scene.h"
#include "runtime/view/flight.h"
#include "tools/measure/stability_case.h"

namespace {

using namespace overlook;

void expect(bool is_true) {
    if (!is_true) __builtin_trap();
}

template <class T>
bool is_read(const Result<T>& read) {
    if (read) return true;
    expect(read.error().exit == Exit::bad_input && read.error().message.starts_with("fuzz:"));
    expect(read.error().message.find('\n') == std::string::npos);
    return false;
}

void use(const scene::Scene& read) {
    expect(!read.layers.empty() && read.error_px > 0);
    std::string text = scene::json_from_scene(read);
    Result<scene::Scene> again = scene::parse_scene(text, "fuzz");
    expect(again && scene::json_from_scene(*again) == text);
}

void use(const scene::Flight& read) {
    expect(!read.keys.empty());
    std::string text = scene::json_from_flight(read);
    Result<scene::Flight> again = scene::parse_flight(text, "fuzz");
    expect(again && scene::json_from_flight(*again) == text);

    uint32_t frames = scene::frame_count(read);
    for (uint32_t i = 0; i < 16; ++i) {
        double time_s = scene::frame_time_s(read, uint64_t(frames - 1) * i / 15);
        view::Camera camera = view::camera_at(read, time_s, {});
        expect(std::isfinite(camera.position_m.x) && std::isfinite(camera.heading_deg) && std::abs(camera.pitch_deg) <= 90);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string_view text(reinterpret_cast<const char*>(data), size);
    if (Result<scene::Scene> read = scene::parse_scene(text, "fuzz"); is_read(read)) use(*read);
    if (Result<scene::Flight> read = scene::parse_flight(text, "fuzz"); is_read(read)) use(*read);
    if (Result<measure::Case> read = measure::parse_case(text, "fuzz"); is_read(read)) expect(!read->gates.empty());
    return 0;
}
