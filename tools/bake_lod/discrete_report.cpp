#include "tools/bake_lod/discrete_report.h"

#include <nlohmann/json.hpp>

#include "formats/numbers.h"

namespace overlook::bake_lod {
namespace {

using nlohmann::ordered_json;

ordered_json levels_json(const DiscreteArgs& args, const discrete::Chain& chain) {
    ordered_json levels = ordered_json::array();
    for (const discrete::Level& level : chain.levels)
        levels.push_back({{"rung", level.rung == discrete::Rung::billboards ? "billboards" : "mesh"},
                          {"triangles", level.triangle_count()},
                          {"vertices", level.vertices.size()},
                          {"draws", level.draws.size()},
                          {"error_m", double(level.error_m)},
                          {"lost_area_share", double(level.lost_area_share)},
                          {"added_area_share", double(level.added_area_share)},
                          {"plain", level.is_plain},
                          {"from_m", args.ladder.view.distance_m(double(level.error_m))}});
    return levels;
}

ordered_json tried_json(const discrete::MeshChainReport& cut) {
    ordered_json tried = ordered_json::array();
    for (const discrete::TriedLevel& level : cut.tried)
        tried.push_back({{"kind", level.kind},
                         {"triangles", level.candidate.triangle_count},
                         {"error_m", level.candidate.error_m},
                         {"lost_area_share", level.lost_area_share},
                         {"added_area_share", level.added_area_share},
                         {"kept", level.verdict.is_kept},
                         {"why", level.verdict.why}});
    return tried;
}

ordered_json json_of(const DiscreteArgs& args, const DiscreteDone& done) {
    const discrete::Chain& chain = done.chain;
    ordered_json json{{"file", args.output},
                      {"levels_from", done.is_cut ? "cut" : "files"},
                      {"triangles", chain.levels[0].triangle_count()},
                      {"levels", levels_json(args, chain)},
                      {"finest_error_m", chain.finest_error_m},
                      {"radius_m", chain.radius_m},
                      {"parts", chain.parts.size()},
                      {"clip_s", chain.clip_s},
                      {"surfaces", chain.surfaces.size()},
                      {"visibility", args.visibility}};
    if (done.is_cut) {
        json["cards"] = done.cut.card_count, json["card_triangles"] = done.cut.card_triangle_count;
        json["tried"] = tried_json(done.cut);
    } else {
        json["measured"] = ordered_json::array();
        for (const discrete::MeasuredLevel& level : done.measured)
            json["measured"].push_back(
                {{"triangles", level.triangle_count}, {"least_m", level.least_m}, {"most_m", level.most_m}});
    }
    json["notes"] = ordered_json::array();
    for (const mesh::MeshReport& input : done.inputs)
        for (const std::string& line : input.notes) json["notes"].push_back(line);
    json["bytes"] = done.bytes, json["read_s"] = done.read_s, json["bake_s"] = done.bake_s;
    return json;
}

void print_why(const DiscreteArgs& args, const DiscreteDone& done) {
    const discrete::LadderView& view = args.ladder.view;
    fmt::print("for a picture {:g} pixels high over {:g} degrees, {:g} px allowed:\n", view.height_px, view.fov_y_deg,
               view.error_px);
    if (done.is_cut) {
        for (const discrete::TriedLevel& level : done.cut.tried)
            fmt::print("  {} {:>9} triangles ({}), off by {:.4g} m, {:.1f} % of the area lost, {:.1f} % added: {}\n",
                       level.verdict.is_kept ? "+" : "-", with_commas(level.candidate.triangle_count), level.kind,
                       level.candidate.error_m, 100 * level.lost_area_share, 100 * level.added_area_share, level.verdict.why);
        return;
    }
    for (size_t k = 0; k < done.measured.size(); ++k)
        fmt::print("  + {:>9} triangles, off by {:.4g} m (some point is, by {:.4g} m): the choice from {:.4g} m on\n",
                   with_commas(done.measured[k].triangle_count), double(done.chain.levels[k].error_m), done.measured[k].least_m,
                   view.distance_m(double(done.chain.levels[k].error_m)));
}

}  // namespace

void report_discrete(const DiscreteArgs& args, const DiscreteDone& done, const command::Common& common) {
    if (common.json) {
        fmt::print("{}\n", json_of(args, done).dump(2));
        return;
    }
    for (const mesh::MeshReport& input : done.inputs)
        for (const std::string& line : mesh::text_of(input)) command::detail(common, line);
    if (args.why) print_why(args, done);
    std::string counts;
    for (const discrete::Level& level : done.chain.levels)
        counts += (counts.empty() ? "" : ", ") + with_commas(level.triangle_count());
    command::note(common,
                  fmt::format("{}: {} levels of {} triangles, {:.2f} MB; level 0 within {:.3g} m of the source, the last within "
                              "{:.3g} m of level 0",
                              args.output, done.chain.levels.size(), counts, double(done.bytes) / 1e6, done.chain.finest_error_m,
                              double(done.chain.levels.back().error_m)));
    if (done.chain.parts.size() > 1)
        command::note(common,
                      fmt::format("{}: {} parts move, over {:g} s", args.output, done.chain.parts.size() - 1, done.chain.clip_s));
}

}  // namespace overlook::bake_lod
