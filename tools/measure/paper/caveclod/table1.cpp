#include "tools/measure/paper/caveclod/table1.h"

#include <cmath>

#include "runtime/caveclod/refine.h"
#include "tools/measure/page.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"

namespace overlook::measure::paper::cameras {
namespace {

std::string count(uint64_t number) {
    return short_count(double(number));
}
std::string percent(double share) {
    return fmt::format("{:.3g} %", 100 * share);
}

// "44n + 12p + 32d + 2se", each with its number.
std::string terms_text(const Counted& of) {
    return fmt::format("44 x {} + 12 x {} + 32 x {} + 2 x {} x {} = {} + {} + {} + {}", count(of.nodes), count(of.polygons),
                       count(of.vertices), count(of.ids), count(of.positions), count(of.terms.nodes), count(of.terms.polygons),
                       count(of.terms.vertices), count(of.terms.index_array));
}

std::string solved_text(const PrintedTerrain& terrain) {
    Solved is = solved(terrain);
    std::string text = fmt::format("The printed memory per camera makes n = {}", count(uint64_t(is.nodes)));
    if (is.is_whole()) return text + fmt::format(", and the static one then d = {}.", count(uint64_t(is.vertices)));
    return text +
           fmt::format(
               "; with one id and as many entries as vertices the static one then makes d = {:.2f}, no whole number: the printed "
               "value fits no grid of {} polygons.",
               is.vertices, count(terrain.polygons));
}

std::string row_html(const Table1Row& row) {
    const Counted& here = row.counted;
    double own_share = double(here.own_camera_bytes) / double(here.own_static_bytes);
    double share = double(here.terms.cameras) / double(here.terms.static_bytes());
    std::string html;
    std::string title = escaped(row.printed ? row.printed->title : row.name);
    if (row.printed) {
        const PrintedTerrain& printed = *row.printed;
        html += table_row({title + ", printed", count(printed.polygons), count(printed.static_bytes), count(printed.camera_bytes),
                           percent(double(printed.camera_bytes) / double(printed.static_bytes)), count(printed.ids),
                           percent(printed.population)},
                          "td");
    }
    html += table_row({title + ", equation 1 here", count(here.polygons), count(here.terms.static_bytes()),
                       count(here.terms.cameras), percent(share), count(here.ids), percent(here.population)},
                      "td");
    html += table_row({title + ", Overlook's form", count(here.polygons), count(here.own_static_bytes),
                       count(here.own_camera_bytes), percent(own_share), "rows", "100 %"},
                      "td");
    std::string said = "Static terms here: " + terms_text(here) + " bytes; a camera: 4 x " + count(here.nodes) + " + 4 x " +
                       count(here.polygons) + " + 16.";
    if (row.printed) said += " " + solved_text(*row.printed);
    return html + said_row(said, 7);
}

}  // namespace

const PrintedTerrain* printed_of(std::string_view name) {
    for (const PrintedTerrain* terrain : {&kThreeLakes, &kCliff, &kCanyon})
        if (terrain->name == name) return terrain;
    return nullptr;
}

bool Solved::is_whole() const {
    return vertices == std::floor(vertices);
}

Solved solved(const PrintedTerrain& terrain) {
    Solved is;
    is.nodes = double(terrain.camera_bytes) / 4 - 4 - double(terrain.polygons);
    double rest = double(terrain.static_bytes) - 44 * is.nodes - 12 * double(terrain.polygons);
    double ids = double(terrain.ids);
    is.vertices = terrain.positions > 0 ? (rest - 2 * ids * double(terrain.positions)) / 32 : rest / (32 + 2 * ids);
    return is;
}

Counted counted_of(const Subject& subject) {
    const caveclod::Hierarchy& hierarchy = *subject.world.mesh->hierarchy;
    Counted is{subject.printed->nodes().size(),
               hierarchy.face_positions.size(),
               hierarchy.vertices.size(),
               subject.printed->packed_count(),
               hierarchy.positions_m.size(),
               {},
               0,
               subject.mesh().bytes().all(),
               caveclod::Refinement(subject.mesh()).bytes().fixed};
    is.terms = caveclod::paper::equation1(is.nodes, is.polygons, is.vertices, is.ids, is.positions, 0, 0, 1);
    is.population = double(subject.printed->populated_count()) / double(std::max<uint64_t>(1, is.ids * is.positions));
    return is;
}

std::string table1_csv(const std::vector<Table1Row>& rows) {
    std::string csv =
        "terrain,n,p,d,s,e,44n,12p,32d,2se,static_bytes,camera_bytes,population,printed_static_bytes,printed_camera_bytes,"
        "printed_population,own_static_bytes,own_camera_bytes\n";
    for (const Table1Row& row : rows) {
        const Counted& is = row.counted;
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", row.name, is.nodes, is.polygons, is.vertices, is.ids,
                           is.positions, is.terms.nodes, is.terms.polygons, is.terms.vertices, is.terms.index_array,
                           is.terms.static_bytes(), is.terms.cameras, is.population);
        csv += row.printed
                   ? fmt::format(",{},{},{}", row.printed->static_bytes, row.printed->camera_bytes, row.printed->population)
                   : ",,,";
        csv += fmt::format(",{},{}\n", is.own_static_bytes, is.own_camera_bytes);
    }
    return csv;
}

std::string table1_html(const std::vector<Table1Row>& rows) {
    std::string html = "<h2>Table 1: memory, in bytes</h2>\n<div class=\"wide\"><table class=\"runs numbers\">\n<thead>" +
                       table_row({"", "polygons", "static", "a camera", "share", "ids", "index array in use"}, "th") +
                       "</thead>\n<tbody>\n";
    for (const Table1Row& row : rows) html += row_html(row);
    return html +
           "</tbody></table></div>\n<p class=\"note\">Equation 1: static 44n + 12p + 32d + 2se, a camera 4n + 4p + 16; n nodes, "
           "p "
           "polygons, d vertices, s ids, e positions. On average the paper's camera takes 10.5 % of the static part. Overlook's "
           "form keeps compressed rows of 32-bit instead of the array; what is active comes to it: figure 14. <a "
           "href=\"table1.csv\">table1.csv</a></p>\n";
}

}  // namespace overlook::measure::paper::cameras
