#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/discrete.h"
#include "formats/numbers.h"
#include "tools/baked/mesh_file.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

// At rest; a vertex takes the colour of the last draw that uses it.
MeshData mesh_of(const discrete::Chain& chain, const discrete::Level& level) {
    MeshData mesh;
    mesh.indices = level.indices;
    mesh.colours.assign(3 * level.vertices.size(), 255);
    for (const discrete::Vertex& v : level.vertices) {
        glm::dvec3 at_m = discrete::position_m(chain, v);
        mesh.positions.insert(mesh.positions.end(), {at_m.x, at_m.y, at_m.z});
    }
    for (const discrete::Draw& draw : level.draws)
        for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; ++i)
            for (size_t c = 0; c < 3; ++c) {
                uint32_t v = level.indices[i];
                unsigned product = unsigned(chain.surfaces[draw.surface].colour[c]) * level.vertices[v].colour[c];
                mesh.colours[3 * size_t(v) + c] = uint8_t((product + 127) / 255);
            }
    return mesh;
}

// The level asked for, or the coarsest within the error asked for.
Result<size_t> level_of(const ExportArgs& args, const discrete::Chain& chain) {
    if (args.level < 0 && args.error_m < 0) return bad_command("{}: is a chain of levels; give --level or --error-m", args.file);
    if (args.level >= int64_t(chain.levels.size()))
        return bad_command("{}: has levels 0 to {}, --level {} is none", args.file, chain.levels.size() - 1, args.level);
    if (args.level >= 0) return size_t(args.level);
    size_t level = chain.levels.size() - 1;
    while (level > 0 && double(chain.levels[level].error_m) > args.error_m) --level;
    return level;
}

}  // namespace

int export_discrete(const ExportArgs& args, const container::Reader& file, const command::Common& common) {
    const char* name = "baked export";
    auto chain = discrete::read(file);
    if (!chain) return command::fail(name, chain.error());
    auto level = level_of(args, *chain);
    if (!level) return command::fail(name, level.error());
    const discrete::Level& made = chain->levels[*level];
    auto report = write_triangles(args.output, mesh_of(*chain, made));
    if (!report) return command::fail(name, report.error());
    if (common.json) {
        nlohmann::ordered_json json{{"file", args.output},
                                    {"level", *level},
                                    {"stated_error_m", double(made.error_m)},
                                    {"lost_area_share", double(made.lost_area_share)},
                                    {"triangles", report->triangle_count},
                                    {"vertices", report->vertex_count},
                                    {"bytes", report->file_bytes},
                                    {"position_rounding_m", report->rounding_m}};
        fmt::print("{}\n", json.dump(2));
        return int(Exit::done);
    }
    command::note(common, fmt::format("{}: level {} of {}, {} triangles, {} vertices, within {:.4g} m of level 0 both ways",
                                      args.output, *level, chain->levels.size(), with_commas(report->triangle_count),
                                      with_commas(report->vertex_count), double(made.error_m)));
    return int(Exit::done);
}

}  // namespace overlook::baked
