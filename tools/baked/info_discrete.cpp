#include "tools/baked/info_discrete.h"

#include <nlohmann/json.hpp>

#include "formats/numbers.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

constexpr const char* kRungs[] = {"mesh", "billboards", "impostor"};

}  // namespace

std::string chain_json(const discrete::Chain& chain) {
    ordered_json json{{"levels", ordered_json::array()},
                      {"finest_error_m", chain.finest_error_m},
                      {"middle_m", {chain.middle_m.x, chain.middle_m.y, chain.middle_m.z}},
                      {"radius_m", chain.radius_m},
                      {"position_step_m", chain.position_step_m},
                      {"clip_s", chain.clip_s},
                      {"parts", ordered_json::array()},
                      {"surfaces", ordered_json::array()},
                      {"visibility", ordered_json::array()}};
    for (const discrete::Level& level : chain.levels)
        json["levels"].push_back({{"rung", kRungs[size_t(level.rung)]},
                                  {"triangles", level.triangle_count()},
                                  {"vertices", level.vertices.size()},
                                  {"draws", level.draws.size()},
                                  {"error_m", double(level.error_m)},
                                  {"lost_area_share", double(level.lost_area_share)},
                                  {"added_area_share", double(level.added_area_share)},
                                  {"plain", level.is_plain}});
    for (const discrete::Part& part : chain.parts) json["parts"].push_back({{"name", part.name}, {"keys", part.at_s.size()}});
    for (const caveclod::Surface& surface : chain.surfaces)
        json["surfaces"].push_back({{"name", surface.name},
                                    {"texture", surface.texture},
                                    {"texture_bytes", surface.texture_bytes.size()},
                                    {"alpha_masked", surface.is_alpha_masked},
                                    {"two_sided", surface.is_two_sided}});
    for (const discrete::Visibility& v : chain.visibility)
        json["visibility"].push_back({{"lookup", v.lookup == discrete::Visibility::Lookup::paper ? "paper" : "volume"},
                                      {"size", {v.width, v.height, v.depth}},
                                      {"period_m", double(v.period_m)}});
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void print_chain(const discrete::Chain& chain) {
    fmt::print("chain: {} levels, {} surfaces, within {:.4g} m of a middle\n", chain.levels.size(), chain.surfaces.size(),
               chain.radius_m);
    for (size_t k = 0; k < chain.levels.size(); ++k) {
        const discrete::Level& level = chain.levels[k];
        fmt::print("  level {}: {:>9} triangles, {:>9} vertices, {} draws; within {:.4g} m of {}, {:.1f} % of the area lost{}\n",
                   k, with_commas(level.triangle_count()), with_commas(level.vertices.size()), level.draws.size(),
                   k == 0 ? chain.finest_error_m : double(level.error_m), k == 0 ? "the source" : "level 0",
                   100 * double(level.lost_area_share),
                   level.rung == discrete::Rung::mesh
                       ? std::string()
                       : fmt::format(", {:.1f} % added; {}", 100 * double(level.added_area_share), kRungs[size_t(level.rung)]));
    }
    for (const discrete::Part& part : chain.parts)
        if (!part.at_s.empty()) fmt::print("moves: {} ({} keys over {:g} s)\n", part.name, part.at_s.size(), chain.clip_s);
    for (const discrete::Visibility& v : chain.visibility)
        fmt::print("visibility: {}, {} x {} x {} over {:.4g} m\n",
                   v.lookup == discrete::Visibility::Lookup::paper ? "picture" : "volume", v.width, v.height, v.depth,
                   v.period_m);
}

}  // namespace overlook::baked
