// Writes the committed scene and flights of the sample landscape anew: make_sample_flights, from the root of the repository.
#include <cstdio>

#include "formats/atomic_file.h"
#include "tools/make_sample/sample_flight.h"
#include "tools/make_sample/sample_objects.h"
#include "tools/make_sample/sample_slopes.h"

int main() {
    using namespace overlook;
    sample::LandscapeOptions options;
    sample::Landscape landscape = sample::make_landscape(options);
    auto write = [](const std::string& name, const std::string& text) {
        Result<void> written = write_file(OVERLOOK_SOURCE_DIR "/samples/" + name, std::string_view(text));
        if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return written.has_value();
    };
    scene::Scene scene = sample::sample_scene();
    scene.layers[0].asset = "../../out/sample.ovl";
    bool is_done = write("scenes/sample.json", scene::json_from_scene(scene));
    is_done &= write("flights/overview.json", scene::json_from_flight(sample::overview_flight(landscape, options.cell_size_m)));
    for (const auto& [name, flight] : sample::suite_flights(landscape, options.cell_size_m)) {
        is_done &= write("flights/" + name + ".json", scene::json_from_flight(flight));
        std::printf("%s: %u frames, at least %.1f m over the ground\n", name.c_str(), scene::frame_count(flight),
                    sample::least_clearance_m(flight, landscape, options.cell_size_m));
    }
    is_done &= write("flights/s09.json", scene::json_from_flight(sample::vase_flight()));
    is_done &= write("flights/s10.json", scene::json_from_flight(sample::masts_flight()));
    is_done &= write("flights/s11.json", scene::json_from_flight(sample::slopes_flight()));
    return is_done ? 0 : 4;
}
