// Baking and refining terrain on this machine, as CSV, with the machine's own limit measured in the same run.

#include <cstdlib>
#include <filesystem>
#include <functional>

#include "formats/atomic_file.h"
#include "formats/container.h"
#include "formats/parallel.h"
#include "runtime/command/command.h"
#include "runtime/terrain/refine.h"
#include "tests/bench/measure.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"
#include "tools/bake/terrain_errors.h"

using namespace overlook;

namespace {

struct Args {
    std::string out;
    int repeats = 5;
};

struct Table {
    std::string machine;
    double machine_gb_s = 0;
    std::string csv =
        "benchmark,input,threads,repeats,min_ms,median_ms,max_ms,work_count,work_unit,work_per_ms,least_bytes_moved,moved_gb_per_"
        "s,machine_gb_per_s,"
        "share_of_machine_limit,bytes_per_sample,peak_memory_mb,machine\n";

    // least_bytes: what any way of doing this work must read and write.
    void add(const std::string& benchmark, const std::string& input, int repeats, const bench::Times& times, double work,
             const char* unit, double least_bytes, double bytes_per_sample) {
        double gb_s = least_bytes / (times.min_ms * 1e6);
        csv += fmt::format("{},{},{},{},{:.3f},{:.3f},{:.3f},{:.0f},{},{:.1f},{:.0f},{:.2f},{:.2f},{:.4f},{:.3f},{:.0f},\"{}\"\n",
                           benchmark, input, thread_count(), repeats, times.min_ms, times.median_ms, times.max_ms, work, unit,
                           work / times.min_ms, least_bytes, gb_s, machine_gb_s, gb_s / machine_gb_s, bytes_per_sample,
                           times.peak_memory_mb, machine);
    }
};

struct Input {
    std::string name;
    dem::Raster dem;
};

// Hills like a generated sample of their size, and the real elevation models where they are at hand.
std::vector<Input> inputs() {
    std::vector<Input> found;
    found.push_back({"hills_1025", test::make_hills(1025, 1025, 1)});
    found.push_back({"hills_4097", test::make_hills(4097, 4097, 1)});
    const char* folder = std::getenv("OVERLOOK_DATA");
    if (folder == nullptr) return found;
    for (const char* name : {"N44W072.hgt", "everest_srtm3_voids.tif", "greenriver_lidar_1m.tif"})
        if (auto dem = dem::open(std::string(folder) + "/dem/" + name, {})) found.push_back({name, std::move(*dem)});
    return found;
}

view::Camera overview(const terrain::Terrain& terrain, const terrain::Refiner& refiner, double turn_deg) {
    view::Camera camera;
    double width_m = terrain.shape.width * terrain.frame.metres_per_column,
           height_m = terrain.shape.height * terrain.frame.metres_per_row;
    camera.position_m = {width_m / 2, -height_m / 2, refiner.highest_m() + 0.01 * width_m};
    camera.heading_deg = turn_deg, camera.pitch_deg = -15;
    return camera;
}

Result<uint64_t> write_to(const std::string& path, const terrain::Terrain& terrain) {
    auto writer = container::Writer::create(path, terrain::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = terrain::write(*writer, terrain); !written) return tl::unexpected(written.error());
    return writer->commit();
}

void measure_bake(const Input& input, const terrain::Terrain& terrain, const Args& args, Table& table) {
    double samples = double(input.dem.samples.size());
    bench::Times times =
        bench::time_of(args.repeats, [&] { (void)terrain::measure_split_errors(terrain.shape, terrain.heights); });
    // Every sample is looked at by two triangles' worth of planes in each of two diamond kinds a level: 4 bytes read once for
    // each.
    table.add("measure_errors", input.name, args.repeats, times, samples, "samples",
              samples * (2.0 * terrain.shape.root_log2 * 4 + 5.4), 0);
    times = bench::time_of(args.repeats, [&] { (void)terrain::bake(input.dem, {}, [](double) {}); });
    table.add("bake_terrain", input.name, args.repeats, times, samples, "samples",
              samples * (4 + 2.0 * terrain.shape.root_log2 * 4 + 5.4 + 1.4), 0);
}

Result<void> measure_file(const Input& input, const terrain::Terrain& terrain, const Args& args, Table& table) {
    double samples = double(input.dem.samples.size());
    std::string path = args.out + "/bench.ovl";
    auto bytes = write_to(path, terrain);
    if (!bytes) return tl::unexpected(bytes.error());
    double bytes_per_sample = double(*bytes) / samples;
    bench::Times times = bench::time_of(args.repeats, [&] { (void)write_to(path, terrain); });
    table.add("write_terrain", input.name, args.repeats, times, samples, "samples", samples * 5.4 + double(*bytes),
              bytes_per_sample);
    times = bench::time_of(args.repeats, [&] { (void)terrain::read(path); });
    table.add("read_terrain", input.name, args.repeats, times, samples, "samples", samples * 5.4 + double(*bytes),
              bytes_per_sample);
    std::filesystem::remove(path);
    return {};
}

void measure_refinement(const Input& input, const terrain::Terrain& terrain, const Args& args, Table& table) {
    terrain::Refiner refiner(terrain);
    terrain::Cut cut;
    for (double error_px : {1.0, 4.0}) {
        double triangles = 0, tested = 0;
        bench::Times times = bench::time_of(args.repeats, [&] {
            triangles = tested = 0;
            for (double turn_deg : {0.0, 90.0, 180.0, 270.0}) {
                refiner.cut_by_pixels(overview(terrain, refiner, turn_deg), error_px, cut);
                triangles += double(cut.triangle_count()), tested += double(cut.tested_count);
            }
        });
        // A code and a height range for each vertex tested, three indices for each triangle.
        table.add(fmt::format("refine_view_at_{:g}px", error_px), input.name, args.repeats, times, triangles, "triangles",
                  tested * 9 + triangles * 12, 0);
    }
    bench::Times times = bench::time_of(args.repeats, [&] { refiner.cut_by_metres(5, cut); });
    table.add("refine_whole_at_5m", input.name, args.repeats, times, double(cut.triangle_count()), "triangles",
              double(cut.tested_count) + 12 * double(cut.triangle_count()), 0);
}

int measure_all(const Args& args, const command::Common& common) {
    std::error_code problem;
    std::filesystem::create_directories(args.out, problem);
    Table table;
    table.machine = bench::machine_name();
    table.machine_gb_s = bench::memory_bandwidth_gb_s();
    for (const Input& input : inputs()) {
        auto terrain = terrain::bake(input.dem, {}, [](double) {});
        if (!terrain) return command::fail("bench", terrain.error());
        measure_bake(input, *terrain, args, table);
        if (auto done = measure_file(input, *terrain, args, table); !done) return command::fail("bench", done.error());
        measure_refinement(input, *terrain, args, table);
        command::note(common, input.name + " measured");
    }
    if (auto written = write_file(args.out + "/terrain.csv", std::string_view(table.csv)); !written)
        return command::fail("bench", written.error());
    return int(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Measures baking and refining terrain on this machine.", "bench");
    Args args;
    command::Common common;
    app.add_option("--out", args.out, "Folder of the CSV files")->required();
    app.add_option("--repeats", args.repeats, "How often each is measured")->check(CLI::Range(1, 1000))->capture_default_str();
    command::add_common(app, common);
    return command::run(app, common, argc, argv, [&] { return measure_all(args, common); });
}
