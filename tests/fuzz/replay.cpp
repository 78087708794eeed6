// Gives a fuzz target every file of some folders, in the order of their names: NAME_replay FOLDER...
// What a fuzzer found once is so tried again by every build, with any compiler.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int main(int argument_count, char** arguments) {
    size_t count = 0;
    for (int i = 1; i < argument_count; i++) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i])) {
            if (entry.is_regular_file()) files.push_back(entry.path());
        }
        if (files.empty()) {
            std::fprintf(stderr, "replay: %s: there are no files\n", arguments[i]);
            return 1;
        }
        std::sort(files.begin(), files.end());
        for (const std::filesystem::path& path : files) {
            std::ifstream file(path, std::ios::binary);
            std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
            std::printf("%s\n", path.c_str());
            std::fflush(stdout);  // so that the last line names the file that crashed
            LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
            count++;
        }
    }
    std::printf("%zu files\n", count);
    return count > 0 ? 0 : 1;
}
