#include "tools/measure/deliver.h"

#include <cstdio>

#include "formats/atomic_file.h"

namespace overlook::measure {

Result<void> deliver(const CourseResult& course, const Setup& setup, const std::string& folder, const command::Common& common) {
    std::string json = runs_json(course, setup);
    const std::pair<const char*, std::string> tables[] = {
        {"frames.csv", frames_csv(course, setup.step_s)}, {"runs.csv", runs_csv(course)}, {"runs.json", json}};
    for (const auto& [name, text] : tables) {
        if (Result<void> written = write_file(folder + "/" + name, std::string_view(text)); !written) return written;
    }
    if (common.json) std::fputs(json.c_str(), stdout);
    return {};
}

}  // namespace overlook::measure
