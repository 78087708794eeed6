#include <nlohmann/json.hpp>

#include "formats/terrain.h"
#include "runtime/terrain/refine.h"
#include "tools/baked/mesh_file.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {

int export_terrain(const ExportArgs& args, const container::Reader& file, const command::Common& common) {
    const char* name = "baked export";
    auto terrain = terrain::read(file);
    if (!terrain) return command::fail(name, terrain.error());
    if (args.error_m < terrain->finest_error_m)
        return command::fail(
            name,
            Error{
                Exit::impossible,
                fmt::format(
                    "{}: cannot be exported within {:g} m: its heights are stored to {:g} m; bake with a smaller --height-step-m",
                    args.file, args.error_m, terrain->finest_error_m)});
    terrain::Refiner refiner(*terrain);
    terrain::Cut cut;
    refiner.cut_by_metres(args.error_m, cut);
    MeshSpace space = args.space == "raster" ? MeshSpace::raster : MeshSpace::local;
    auto report = write_mesh(args.output, space, *terrain, cut.indices);
    if (!report) return command::fail(name, report.error());

    if (common.json) {
        nlohmann::ordered_json json{{"file", args.output},
                                    {"error_m", args.error_m},
                                    {"space", args.space},
                                    {"triangles", report->triangle_count},
                                    {"void_rim_triangles", cut.void_rim_triangle_count},
                                    {"vertices", report->vertex_count},
                                    {"bytes", report->file_bytes},
                                    {"position_rounding_m", report->rounding_m}};
        fmt::print("{}\n", json.dump(2));
    } else {
        command::note(
            common,
            fmt::format("{}: {} triangles ({} on void rims), {} vertices, within {:g} m of every sample covered{}", args.output,
                        report->triangle_count, cut.void_rim_triangle_count, report->vertex_count, args.error_m,
                        report->rounding_m > 0 ? fmt::format("; positions rounded by up to {:.2g} m", report->rounding_m) : ""));
    }
    return int(Exit::done);
}

}  // namespace overlook::baked
