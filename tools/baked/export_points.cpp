#include <nlohmann/json.hpp>

#include "formats/numbers.h"
#include "formats/wang_ldi.h"
#include "tools/baked/points.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

// Which images: first of the directions, how many.
struct Chosen {
    wang_ldi::Which which;
    uint32_t directions = 1;
};

Result<Chosen> chosen_of(const ExportArgs& args, const wang_ldi::ImageSet& set) {
    auto check = [&](const char* option, int64_t value, size_t count) -> Result<void> {
        if (value < int64_t(count)) return {};
        return bad_command("{}: has {}s 0 to {}, --{} {} is none", args.file, option, count - 1, option, value);
    };
    if (args.tile < 0 || args.level < 0) return bad_command("{}: is ground of Wang tiles; give --tile and --level", args.file);
    if (args.error_m >= 0) return bad_command("{}: its images have levels; leave --error-m out", args.file);
    if (!args.output.ends_with(".ply"))
        return bad_command("{}: points are written as .ply; another ending was given", args.output);
    if (auto is_there = check("tile", args.tile, set.tile_count); !is_there) return tl::unexpected(is_there.error());
    if (auto is_there = check("level", args.level, set.levels.size()); !is_there) return tl::unexpected(is_there.error());
    if (auto is_there = check("direction", args.direction, set.direction_count); !is_there)
        return tl::unexpected(is_there.error());
    if (args.is_alone && set.context_count < 2)
        return bad_command("{}: no images were sampled without neighbours; leave --alone out", args.file);
    bool is_one = args.direction >= 0;
    return Chosen{{args.is_alone ? 1u : 0u, uint32_t(args.tile), uint32_t(args.level), is_one ? uint32_t(args.direction) : 0},
                  is_one ? 1 : set.direction_count};
}

}  // namespace

int export_points(const ExportArgs& args, const container::Reader& file, const command::Common& common) {
    const char* name = "baked export";
    auto images = wang_ldi::ImageReader::open(file);
    if (!images) return command::fail(name, images.error());
    auto chosen = chosen_of(args, images->set());
    if (!chosen) return command::fail(name, chosen.error());
    std::vector<wang_ldi::Ldi> ldis;
    for (uint64_t index = index_of(images->set(), chosen->which); ldis.size() < chosen->directions; ++index) {
        auto ldi = images->read(index);
        if (!ldi) return command::fail(name, ldi.error());
        ldis.push_back(std::move(*ldi));
    }
    Points points = points_of(images->set(), chosen->which.level, ldis);
    auto bytes = write_points(args.output, points);
    if (!bytes) return command::fail(name, bytes.error());
    if (common.json) {
        nlohmann::ordered_json json{{"file", args.output},
                                    {"tile", args.tile},
                                    {"level", args.level},
                                    {"directions", chosen->directions},
                                    {"points", points.positions_m.size()},
                                    {"has_normals", !points.normals.empty()},
                                    {"bytes", *bytes}};
        fmt::print("{}\n", json.dump(2));
    } else {
        command::note(common, fmt::format("{}: {} points of tile {}, level {}, {}", args.output,
                                          with_commas(points.positions_m.size()), args.tile, args.level,
                                          chosen->directions == 1 ? fmt::format("direction {}", chosen->which.direction)
                                                                  : fmt::format("{} directions", chosen->directions)));
    }
    return int(Exit::done);
}

}  // namespace overlook::baked
