#include "tools/bake_lod/terrain_verb.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/container.h"
#include "formats/mapped_file.h"
#include "formats/terrain_tiles.h"
#include "tools/bake/dem_provenance.h"
#include "tools/bake/image_module.h"
#include "tools/bake/images.h"
#include "tools/bake/relief.h"

namespace overlook::bake_lod {
namespace {

constexpr const char* kName = "bake-lod terrain";

// The picture that goes over the terrain, and its identity if it came from a file.
Result<ImageRgb8> texture_of(const TerrainArgs& args, const dem::Raster& dem, container::Provenance& provenance) {
    if (args.no_texture) {
        provenance.options.emplace_back("no-texture", "true");
        return ImageRgb8{};
    }
    if (args.texture.empty()) return shade_relief(dem, ReliefOptions{});
    auto bytes = MappedFile::open(args.texture);
    if (!bytes) return tl::unexpected(bytes.error());
    std::string bare_name = args.texture.substr(args.texture.rfind('/') + 1);
    provenance.options.emplace_back("texture", bare_name);
    provenance.inputs.push_back({bare_name, content_hash(bytes->bytes())});
    return read_image_rgb8(args.texture);
}

// Writing over what is read is hardly ever meant, and would lose what verify needs.
Result<void> check_output(const TerrainArgs& args) {
    for (const std::string& input : {args.dem, args.texture}) {
        std::error_code is_no_file;
        if (std::filesystem::equivalent(input, args.output, is_no_file))
            return bad_command("{}: is read and would be overwritten; give another --output", args.output);
    }
    return {};
}

Result<uint64_t> write_file(const TerrainArgs& args, const terrain::Terrain& terrain, const container::Provenance& provenance) {
    auto writer = container::Writer::create(args.output, terrain::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = terrain::write(*writer, terrain); !written) return tl::unexpected(written.error());
    if (args.is_streamed) {
        if (auto written = terrain::write_tiles(*writer, terrain); !written) return tl::unexpected(written.error());
    }
    if (auto written = writer->add_provenance(provenance); !written) return tl::unexpected(written.error());
    return writer->commit();
}

void report(const TerrainArgs& args, const terrain::Terrain& terrain, const dem::Raster& dem, uint64_t bytes, double seconds,
            const command::Common& common) {
    uint64_t samples = terrain.heights.size();
    if (common.json) {
        nlohmann::ordered_json json{{"file", args.output},
                                    {"columns", terrain.shape.width},
                                    {"rows", terrain.shape.height},
                                    {"voids", dem.void_count},
                                    {"metres_per_column", terrain.frame.metres_per_column},
                                    {"metres_per_row", terrain.frame.metres_per_row},
                                    {"height_step_m", terrain.height_step_m},
                                    {"finest_error_m", terrain.finest_error_m},
                                    {"coarsest_error_m", terrain.error_m[terrain::kMustSplit - 1]},
                                    {"bytes", bytes},
                                    {"bake_s", seconds}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    command::note(common, fmt::format("{}: {} x {} samples, {} voids left as holes, {:.1f} MB; keeps any error from {:.3g} m",
                                      args.output, terrain.shape.width, terrain.shape.height, dem.void_count, double(bytes) / 1e6,
                                      terrain.finest_error_m));
    command::detail(common, fmt::format("cells of {:.6g} x {:.6g} m; baked in {:.2f} s, {:.1f} million samples a second",
                                        terrain.frame.metres_per_column, terrain.frame.metres_per_row, seconds,
                                        double(samples) / seconds / 1e6));
}

}  // namespace

CLI::App* add_terrain_verb(CLI::App& app, TerrainArgs& args, command::Common& common) {
    CLI::App* verb = app.add_subcommand(
        "terrain", "An elevation model (GeoTIFF, .hgt, grey PNG) into a quadtree that keeps any error asked of it");
    verb->add_option("DEM", args.dem, "The elevation model")->required();
    verb->add_option("-o,--output", args.output, "The baked file (.ovl)")->required();
    verb->add_option("--window", args.window, "Only this part: X,Y,W,H in samples from the north-west");
    verb->add_option("--texture", args.texture, "A picture over the whole raster (default: relief shaded from the heights)");
    verb->add_flag("--no-texture", args.no_texture, "No picture at all")->excludes("--texture");
    verb->add_flag("--streamed", args.is_streamed,
                   "Add what player --stream-memory needs to fly over it with a part of it in memory");
    verb->add_option("--cell-size-m", args.dem_options.cell_size_m,
                     "Metres between samples, for files that do not say (PNG); overrides those that do")
        ->check(command::number_in(1e-6, 1e6));
    verb->add_option("--height-scale-m", args.dem_options.height_scale_m,
                     "Metres for each unit of stored height (default: the file's own, or 1)")
        ->check(command::number_in(1e-9, 1e6));
    verb->add_option("--nodata", args.dem_options.nodata, "A stored value that means \"no data\" (default: the file's own)");
    verb->add_option("--height-step-m", args.bake.height_step_m,
                     "Store heights in steps of this many metres (default: whole numbers exactly, others to 1/1024 m); the "
                     "rounding counts towards every error")
        ->check(command::number_in(1e-6, 1e4));
    command::add_common(*verb, common, command::Uses::memory);
    // What reads pictures takes memory of its own: opened before the cap counts what the program begins with. Where it is
    // missing, whoever reads the first picture says so.
    verb->final_callback([&common] {
        if (common.memory_bytes != 0) static_cast<void>(image_library());
    });
    return verb;
}

int bake_terrain(TerrainArgs args, const command::Common& common) {
    if (!args.window.empty()) {
        auto window = dem::parse_window(args.window);
        if (!window) return command::fail(kName, window.error());
        args.dem_options.window = *window;
    }
    if (auto checked = check_output(args); !checked) return command::fail(kName, checked.error());
    auto begin = std::chrono::steady_clock::now();
    auto dem = dem::open(args.dem, args.dem_options);
    if (!dem) return command::fail(kName, dem.error());

    container::Provenance provenance{
        kName, command::version(), dem::options_in_words(args.dem_options, args.bake), {{dem->source_name, dem->source_hash}}};
    if (args.is_streamed) provenance.options.emplace_back("streamed", "true");
    auto texture = texture_of(args, *dem, provenance);
    if (!texture) return command::fail(kName, texture.error());

    command::Progress progress(common, "baking");
    auto terrain = terrain::bake(*dem, args.bake, [&](double done) { progress.set(done); });
    if (!terrain) return command::fail(kName, Error{terrain.error().exit, args.dem + ": " + terrain.error().message});
    terrain->texture = std::move(*texture);

    auto bytes = write_file(args, *terrain, provenance);
    if (!bytes) return command::fail(kName, bytes.error());
    report(args, *terrain, *dem, *bytes, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), common);
    return int(Exit::done);
}

}  // namespace overlook::bake_lod
