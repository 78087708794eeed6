// All that was flown for the page, and figures 10 to 14 as tables and charts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/paper/caveclod/draw.h"
#include "tools/measure/paper/caveclod/speed.h"
#include "tools/measure/paper/caveclod/table1.h"

namespace overlook::measure::paper::cameras {

// What section 4 states of its own runs.
struct Printed {
    static constexpr double kSharedOperations_per_s = 14'868, kOwnSplits_per_s = 2'000;
    static constexpr double kCameraShare = 0.105;  // memory of a camera, of the static part, on average
    static constexpr double kActiveNodeBytes = 12, kActivePolygonBytes = 36;
};

struct FlownSubject {
    std::string name;  // of its folder
    uint64_t split_count = 0, face_count = 0;
    Table1Row memory;
    std::vector<Flyover> flyovers;
    std::vector<Picture> pictures;

    // Null where it was not flown.
    const Flyover* find(Way way, uint32_t cameras, double step_s) const;
    const Flyover* find(Way way, uint32_t cameras) const { return find(way, cameras, step_s); }
    double step_s = 0;  // of most
};
std::string title_of(const FlownSubject& subject);

struct Flown {
    Flying flying;
    std::vector<FlownSubject> subjects;  // at least one
    size_t canyon = 0, lakes = 0;        // which stand for the Grand Canyon and Three Lakes in figures 10 to 14
    double flight_s = 0;
    Speed speed;  // over the canyon
    std::vector<Rate> rates;
};

// How many times fewer operations a second and camera: shared over the way. Nothing where one of them was not flown, or of none.
std::optional<double> operations_ratio(const FlownSubject& subject, Way way, uint32_t cameras);
// Bytes that all cameras keep for what is active, over their faces; the mean over frames.
double active_bytes_a_face(const Flyover& flyover);
double glide_bytes_a_face(const Flyover& flyover);  // of them, what is on its way
double mean_faces(const Flyover& flyover);       // of one camera
double mean_used_share(const Flyover& flyover);  // of all render vertices, by all cameras together

// windows.csv: a row a camera and window. flyovers.csv: a row a flyover, its means. memory.csv: a row a flyover and window, all
// bytes. frame_rates.csv: a row a window.
std::string windows_csv(const Flown& flown);
std::string flyovers_csv(const Flown& flown);
std::string memory_csv(const Flown& flown);
std::string frame_rates_csv(const Flown& flown);

// charts/figure-10 .. figure-14, from those tables.
std::vector<Chart> charts_10_to_14(const Flown& flown);

}  // namespace overlook::measure::paper::cameras
