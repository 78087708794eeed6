// What a built program loads: asked of the dynamic loader and of readelf, as anybody would on a shell.
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "tests/layering/layering.h"

namespace overlook::layering {
namespace {

std::string output_of(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) throw std::runtime_error("cannot run: " + command);
    std::string output;
    char part[4096];
    while (size_t count = std::fread(part, 1, sizeof part, pipe)) output.append(part, count);
    if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
    return output;
}

}  // namespace

Libraries libraries_of(const std::string& program) {
    Libraries libraries;
    // "        libfmt.so.9 => /usr/lib/x86_64-linux-gnu/libfmt.so.9 (0x00007f...)"
    std::istringstream loaded(output_of("LD_TRACE_LOADED_OBJECTS=1 '" + program + "'"));
    for (std::string line; std::getline(loaded, line);) {
        std::istringstream words(line);
        if (std::string name; words >> name) libraries.loaded.push_back(name.substr(name.rfind('/') + 1));
    }
    libraries.needed = libraries_needed_by(program);
    return libraries;
}

std::vector<std::string> libraries_needed_by(const std::string& file) {
    std::vector<std::string> names;
    // " 0x0000000000000001 (NEEDED)             Shared library: [libfmt.so.9]"
    std::istringstream needed(output_of("LC_ALL=C readelf --dynamic '" + file + "'"));
    for (std::string line; std::getline(needed, line);) {
        size_t open = line.find('['), close = line.find(']');
        if (line.find("(NEEDED)") != std::string::npos && open < close) names.push_back(line.substr(open + 1, close - open - 1));
    }
    return names;
}

}  // namespace overlook::layering
