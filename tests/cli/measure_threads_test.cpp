// The renderer's threads: every picture, reference and number of measure is the same with any count of them.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"
#include "tools/measure/methods.h"

namespace overlook::cli {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

// A table without the columns that are times.
std::string without_times(const std::string& csv) {
    std::istringstream in(csv);
    std::string line, kept;
    std::getline(in, line);
    const std::vector<std::string> header = cells_of(line);
    for (bool is_row = true; is_row; is_row = bool(std::getline(in, line))) {
        std::vector<std::string> cells = cells_of(line);
        for (size_t i = 0; i < cells.size(); ++i) {
            if (i >= header.size() || !header[i].ends_with("_ms")) kept += cells[i] + ",";
        }
        kept += "\n";
    }
    return kept;
}

// What a run leaves that must repeat, by its place in the folder: pictures, kept references and the table of frames.
std::map<std::string, std::string> left_in(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        std::string path = entry.path(), place = path.substr(folder.size());
        bool is_chart = place.starts_with("/charts/");  // they show times
        if (is_chart || !(path.ends_with(".png") || path.ends_with(".frame") || path.ends_with("frames.csv"))) continue;
        files[place] = path.ends_with(".csv") ? without_times(text_of_file(path)) : text_of_file(path);
    }
    return files;
}

size_t count_ending(const std::map<std::string, std::string>& files, const std::string& end) {
    size_t count = 0;
    for (const auto& [place, content] : files) count += place.ends_with(end);
    return count;
}

// Full geometry, and the terrain in every form that it has: morphing and not.
std::vector<std::string> known_methods() {
    std::vector<std::string> known;
    for (const char* method : {"full@samples=4", "terrain", "terrain:morph", "terrain:hard"}) {
        if (measure::parse_method(method)) known.push_back(method);
    }
    return known;
}

TEST(MeasureWithAnyNumberOfRendererThreads, LeavesTheSamePicturesReferencesAndNumbers) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 129);
    const std::vector<std::string> methods = known_methods();
    ASSERT_GE(methods.size(), 3u);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    std::map<std::string, std::string> first;
    for (const char* threads : {"0", "1", "2", "4"}) {
        setenv("LP_NUM_THREADS", threads, 1);
        std::string out = folder / (std::string("out") + threads);
        std::vector<std::string> words = {"measure",  baked,
                                          "--camera", "300,-3600,1400,0,-25",
                                          "--camera", "340,-3500,1400,3,-25",
                                          "--frames", "2",
                                          "--size",   "160x120",
                                          "--out",    out,
                                          "--quiet"};
        for (const std::string& method : methods) words.insert(words.end(), {"--method", method});
        Ran ran = run(words);
        if (ran.exit == 5) GTEST_SKIP() << "no renderer: " << ran.err;
        expect_done(ran);
        std::map<std::string, std::string> files = left_in(out);
        if (first.empty()) {
            first = files;
            // Both frames' references; of every method both frames (the worst E is the first's, the worst W the second's) with their
            // errors, and the references as pictures.
            EXPECT_EQ(count_ending(files, ".frame"), 2u);
            EXPECT_EQ(count_ending(files, ".png"), methods.size() * 2 * 2 + 2);
            EXPECT_EQ(count_ending(files, "frames.csv"), 1u);
        }
        ASSERT_EQ(files.size(), first.size());
        for (const auto& [place, content] : first) {
            EXPECT_TRUE(files.contains(place) && files.at(place) == content) << place << " with " << threads << " threads";
        }
    }
}

}  // namespace
}  // namespace overlook::cli
