// That the benchmarks run, write their table and fill its columns; what they measure is for people to read.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "tests/bench/machine.h"
#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

using Row = std::map<std::string, std::string>;

const std::string kQuick = "bench --small --repeats 2 --benchmark_min_time=0.001 --quiet --out out ";

std::string csv_path(const std::string& folder) {
    return folder + "/out/" + bench::machine_kind(bench::processor_name(), bench::core_count()) + ".csv";
}

// The machine's name, which stands last, may hold commas.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

std::vector<Row> rows_of(const std::string& csv) {
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> header = cells_of(line);
    std::vector<Row> rows;
    while (std::getline(in, line)) {
        std::vector<std::string> cells = cells_of(line);
        EXPECT_GE(cells.size(), header.size()) << line;
        rows.emplace_back();
        for (size_t i = 0; i < std::min(header.size(), cells.size()); ++i) rows.back()[header[i]] = cells[i];
    }
    return rows;
}

double number(const Row& row, const std::string& column) {
    char* end = nullptr;
    const std::string& text = row.at(column);
    double value = std::strtod(text.c_str(), &end);
    EXPECT_TRUE(!text.empty() && *end == '\0') << row.at("benchmark") << " " << column << ": " << text;
    return value;
}

TEST(Bench, WritesEveryHotFunctionIntoATableNamedByTheMachine) {
    shell::Scratch scratch;
    auto ran = shell::run(kQuick, scratch.path());
    ASSERT_EQ(ran.exit, 0) << ran.output;
    EXPECT_EQ(ran.output, "");
    std::set<std::string> names;
    for (const Row& row : rows_of(shell::read_file(csv_path(scratch.path())))) {
        SCOPED_TRACE(row.at("benchmark") + "/" + row.at("input"));
        EXPECT_TRUE(names.insert(row.at("benchmark") + "/" + row.at("input")).second);
        EXPECT_EQ(number(row, "repeats"), 2);
        EXPECT_LE(number(row, "min_ms"), number(row, "median_ms"));
        EXPECT_LE(number(row, "median_ms"), number(row, "max_ms"));
        EXPECT_GT(number(row, "min_ms"), 0);
        EXPECT_GT(number(row, "work_count"), 0);
        EXPECT_NEAR(number(row, "work_per_ms") * number(row, "min_ms") / number(row, "work_count"), 1, 1e-3);
        EXPECT_FALSE(row.at("work_unit").empty());
        EXPECT_GT(number(row, "machine_gb_per_s"), 0);
        if (number(row, "least_bytes_moved") > 0) {
            EXPECT_GT(number(row, "share_of_machine_limit"), 0);
        }
        EXPECT_GT(number(row, "peak_memory_mb"), 0);
    }
    EXPECT_EQ(names, (std::set<std::string>{
                         "measure_errors/hills_129",
                         "bake_terrain/hills_129",
                         "write_terrain/hills_129",
                         "read_terrain/hills_129",
                         "read_container/hills_129",
                         "decode_blocks/hills_129",
                         "height_bounds/hills_129",
                         "refine_whole_at_5m/hills_129",
                         "refine_view_at_1px/hills_129",
                         "refine_view_at_4px/hills_129",
                         "refine_view_at_1px_morph/hills_129",
                         "refine_view_at_4px_morph/hills_129",
                         "refine_steady/hills_129",
                         "screen_test/hills_129",
                         "predict_triangles/hills_129",
                         "pixel_error/vertical",
                         "pixel_error/sphere",
                         "camera_at/1000_keys",
                         "error_controller/10000_frames",
                         "bake_mesh_1_thread/mesh_2048",
                         "bake_mesh_2_threads/mesh_2048",
                         "caveclod_refine_moving/mesh_2048",
                         "caveclod_refine_standing/mesh_2048",
                         "caveclod_refine_4_cameras/mesh_2048",
                         "caveclod_shared_4_cameras/mesh_2048",
                         "caveclod_paper_moving/mesh_2048",
                         "tile_row_by_row/tiles_90000",
                         "tile_at_random/set_12",
                         "plant_tiles/set_12",
                         "warp_exactly/by_order",
                         "warp_fast/by_order",
                         "warp_exactly/by_depth",
                         "warp_fast/by_depth",
                         "flip/64x64",
                         "motion/64x64",
                         "unrest/64x64",
                         "silhouette/64x64",
                         "hole_pixels/64x64",
                     }));
}

// Counted work is the same on every run; only times may differ.
TEST(Bench, CountsTheSameWorkEveryTime) {
    shell::Scratch scratch;
    auto work = [&](const std::string& threads) {
        auto ran = shell::run(kQuick + "--threads " + threads + " --benchmark_filter='refine|read_|decode'", scratch.path());
        EXPECT_EQ(ran.exit, 0) << ran.output;
        std::string counted;
        for (const Row& row : rows_of(shell::read_file(csv_path(scratch.path())))) {
            EXPECT_EQ(row.at("threads"), threads);
            counted += row.at("benchmark") + " " + row.at("work_count") + " " + row.at("least_bytes_moved") + " " +
                       row.at("bytes_per_sample") + "\n";
        }
        return counted;
    };
    std::string once = work("1");
    EXPECT_FALSE(once.empty());
    EXPECT_EQ(once, work("2"));
}

TEST(Bench, RefusesANameThatNoBenchmarkHasAndAFolderThatCannotBe) {
    shell::Scratch scratch;
    auto none = shell::run(kQuick + "--benchmark_filter=no_such", scratch.path());
    EXPECT_EQ(none.exit, 2) << none.output;
    EXPECT_NE(none.output.find("--benchmark_filter"), std::string::npos) << none.output;
    EXPECT_EQ(shell::run("bench --small", scratch.path()).exit, 2);
    shell::write_file(scratch.path() + "/file", "");
    EXPECT_NE(
        shell::run("bench --small --quiet --benchmark_filter=pixel_error --benchmark_min_time=0.001 --out file/x", scratch.path())
            .exit,
        0);
}

}  // namespace
}  // namespace overlook
