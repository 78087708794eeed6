#include "runtime/player/record.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "formats/atomic_file.h"
#include "runtime/view/flight.h"

namespace overlook::player {
namespace {

// How many times the tolerances a flight misses a sample by.
double miss(const scene::Flight& flight, const scene::Key& sample, double tolerance_m, double tolerance_deg) {
    view::Camera camera = view::camera_at(flight, sample.time_s, {});
    const auto& [x, y, z] = sample.position_m;
    double far_m = glm::distance(camera.position_m, glm::dvec3(x, y, z));
    double turned_deg = std::max({std::abs(std::remainder(camera.heading_deg - sample.heading_deg, 360.0)),
                                  std::abs(camera.pitch_deg - sample.pitch_deg),
                                  std::abs(camera.fov_y_deg - sample.fov_y_deg.value_or(camera.fov_y_deg))});
    return std::max(far_m / tolerance_m, turned_deg / tolerance_deg);
}

Result<std::string> free_path() {
    for (int number = 0; number < 1000; ++number) {
        std::string path = fmt::format("flight-{:03}.json", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
    return cannot_write("flight-999.json: cannot write: there are a thousand recorded flights here; name one with --record");
}

}  // namespace

scene::Key key_of(const view::Camera& camera, double time_s) {
    scene::Key key;
    key.time_s = time_s;
    key.position_m = {camera.position_m.x, camera.position_m.y, camera.position_m.z};
    key.heading_deg = std::remainder(camera.heading_deg, 360.0);
    key.pitch_deg = camera.pitch_deg;
    key.fov_y_deg = camera.fov_y_deg;
    return key;
}

bool add_sample(Recording& recording, const view::Camera& camera, double now_s) {
    scene::Key key = key_of(camera, now_s - recording.begin_s);
    if (recording.samples.size() >= scene::kMostKeys) return false;
    if (recording.samples.empty() || key.time_s > recording.samples.back().time_s) recording.samples.push_back(key);
    return true;
}

scene::Flight thinned(std::span<const scene::Key> samples, double tolerance_m, double tolerance_deg) {
    std::vector<size_t> kept = {0};
    if (samples.size() > 1) kept.push_back(samples.size() - 1);
    scene::Flight flight;
    for (bool is_done = false; !is_done;) {
        flight.keys.clear();
        for (size_t index : kept) flight.keys.push_back(samples[index]);

        // Between two keys the sample that is missed most becomes a key.
        std::vector<size_t> more;
        for (size_t k = 0; k + 1 < kept.size(); ++k) {
            double worst = 1;
            size_t worst_index = 0;
            for (size_t i = kept[k] + 1; i < kept[k + 1]; ++i) {
                double missed = miss(flight, samples[i], tolerance_m, tolerance_deg);
                if (missed > worst) {
                    worst = missed;
                    worst_index = i;
                }
            }
            if (worst > 1) more.push_back(worst_index);
        }
        is_done = more.empty();
        kept.insert(kept.end(), more.begin(), more.end());
        std::sort(kept.begin(), kept.end());
    }
    return flight;
}

Result<std::string> write_recording(const Recording& recording, const std::string& path) {
    Result<std::string> target = path.empty() ? free_path() : path;
    if (!target) return target;
    std::string text = scene::json_from_flight(thinned(recording.samples, kRecordTolerance_m, kRecordTolerance_deg));
    Result<scene::Flight> again = scene::parse_flight(text, *target);
    if (!again) return impossible("the recording is no flight: {}", again.error().message);
    if (Result<void> written = write_file(*target, std::string_view(text)); !written) return tl::unexpected(written.error());
    return target;
}

}  // namespace overlook::player
