// Writes the corrupt scenes and the whole ones into two folders: make_wang_scene_fixtures CORRUPT_FOLDER
// WHOLE_FOLDER
#include <cstdio>

#include "tests/corrupt/wang_scene_fixtures.h"

namespace {

int write_all(const std::vector<overlook::container::fixtures::Fixture>& files, const std::string& folder) {
    for (const auto& file : files) {
        auto written = overlook::write_file(folder + "/" + file.name, file.bytes);
        if (written) continue;
        std::fprintf(stderr, "make_wang_scene_fixtures: %s\n", written.error().message.c_str());
        return int(written.error().exit);
    }
    return 0;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 3) {
        std::fprintf(stderr, "make_wang_scene_fixtures: needs two folders: CORRUPT_FOLDER WHOLE_FOLDER\n");
        return int(overlook::Exit::bad_command);
    }
    int code = write_all(overlook::wang_ldi::scene_fixtures::corrupt_files(), arguments[1]);
    return code != 0 ? code : write_all(overlook::wang_ldi::scene_fixtures::whole_files(), arguments[2]);
}
