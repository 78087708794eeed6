#include "tools/measure/paper/wang_ldi/page.h"

#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"
#include "tools/measure/paper/wang_ldi/page_fields.h"
#include "tools/measure/paper/wang_ldi/page_figure_2.h"
#include "tools/measure/paper/wang_ldi/targets.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr char kTable[] = "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>";
constexpr char kTableEnd[] = "</tbody></table></div>\n";

struct Row {
    const char* title;
    const BakeReport& report;
};
std::vector<Row> rows_of(const Plants& plants) {
    return {{"as published", plants.paper},
            {"Overlook", plants.own},
            {"a single tile", plants.single},
            {"Robinson's sixteen", plants.robinson}};
}

std::string setup_html(const WangPage& page) {
    return std::string(
               "<p>Plants baked into tiles <em>as published</em> (eight tiles, planted round-robin, seven levels, eight "
               "directions, "
               "2.5 "
               "million rays an image) and as <em>Overlook</em> bakes them by itself, drawn by the exact warper: tiles back to "
               "front, "
               "samples in an order in which none hides one after it, each a square of pixels, nothing filled. What a plant "
               "leaves "
               "free is earth and sky. Section 6 is flown by the methods themselves, in OpenGL.</p>\n<p class=\"note\">") +
           (page.is_coarse
                ? "Baked coarsely, for a quick page: fewer pixels and rays, and <em>as published</em> with the paper's tiles "
                  "and planting but not its constants. "
                : "") +
           machine_html(page.setup) + ". " + command_html(page.setup.command) + "</p>\n";
}

std::string charts_html(const WangPage& page, const std::string& name, const std::string& sentence) {
    for (const Chart& chart : page.charts)
        if (page.has_charts && chart.name == name) return chart_html(chart.name, chart.title, sentence);
    return "";
}

std::string periodicity_html(const Plants& plants) {
    std::string html = kTable +
                       table_row({"", "tiles", "greatest correlation, lags 2 to 10", "power in the top hundredth, %",
                                  "equal neighbours of 2 million", "neighbours that disagree"},
                                 "th") +
                       "</thead>\n<tbody>\n";
    for (const auto& [title, r] : rows_of(plants))
        html += table_row({title, std::to_string(r.tiles), short_number(r.correlation), short_number(100 * r.spectrum_share),
                           short_count(double(r.equal_neighbours)), short_count(double(r.disagreeing_neighbours))},
                          "td");
    return html + kTableEnd +
           "<p class=\"note\">Over 1,024 x 1,024 tiles: how much oftener than by chance the same tile stands (x, y) apart. Of "
           "independent tiles about 0.003, of what repeats 1. Power: of 256 x 256 tiles' spectrum; the same at all frequencies: "
           "1 "
           "%.</p>\n";
}

std::string planting_html(const Plants& plants) {
    std::string html = kTable +
                       table_row({"", "objects a tile", "density at corners", "at edges", "inside", "relative radius",
                                  "more would fit, a tile", "tiles with a place left", "overlaps", "of neighbourhoods"},
                                 "th") +
                       "</thead>\n<tbody>\n";
    for (const auto& [title, r] : {rows_of(plants)[0], rows_of(plants)[1]})
        html += table_row({title, short_number(double(r.objects) / std::max(1u, r.tiles)), short_number(r.density_corner),
                           short_number(r.density_edge), short_number(r.density_inside), short_number(r.relative_radius),
                           short_number(r.more_per_tile), short_count(double(r.tiles_with_a_place)),
                           short_count(double(r.tight_overlaps)), short_count(double(r.neighbourhoods))},
                          "td");
    return html + kTableEnd +
           "<p class=\"note\"><a href=\"sets.csv\">sets.csv</a>, <a href=\"planting.csv\">planting.csv</a></p>\n";
}

std::string share(const std::optional<Judged>& judged, double Judged::*of) {
    return judged ? short_number(100 * (*judged).*of) : "";
}

std::string number(const std::optional<Judged>& judged, double Judged::*of) {
    return judged ? short_number((*judged).*of) : "";
}

std::string times(const std::optional<Judged>& judged, std::optional<double> Judged::*of) {
    return judged && (*judged).*of ? short_number(*((*judged).*of)) : "";
}

std::string levels_html(const Plants& plants) {
    std::string html =
        kTable +
        table_row({"", "pixels a side", "from, m", "samples", "bytes", "bytes a sample", "rays", "unseen, %", "holes, %",
                   "filled, %", "among others, %", "filled, %", "covered, times", "too deep, %", "E", "E p99", "E among others"},
                  "th") +
        "</thead>\n<tbody>\n";
    for (const auto& [title, report] : {rows_of(plants)[0], rows_of(plants)[1]}) {
        if (!report.images) continue;
        auto row = [&](const std::string& name, const LevelReport& level, const char* attributes) {
            html += table_row(
                {name, std::to_string(level.side_px), short_number(level.nearest_m), short_count(double(level.samples)),
                 short_bytes(double(level.bytes)),
                 short_number(double(level.bytes) / double(std::max<uint64_t>(1, level.samples))),
                 short_count(double(level.rays)), short_number(100 * level.unseen_share_mean),
                 share(level.own, &Judged::hole_share), share(level.own, &Judged::filled_hole_share),
                 share(level.foreign, &Judged::hole_share), share(level.foreign, &Judged::filled_hole_share),
                 times(level.own, &Judged::filled_covered_times), share(level.own, &Judged::deeper_share),
                 number(level.own, &Judged::e_mean), number(level.own, &Judged::e_p99), number(level.foreign, &Judged::e_mean)},
                "td", attributes);
        };
        row(fmt::format("{}, all", title), report.images->all, " class=\"floor\"");
        for (const LevelReport& level : report.images->levels) row(title, level, "");
    }
    return html + kTableEnd +
           "<p class=\"note\">Unseen: estimated when sampling stopped. Covered: pixels that show something, of those where "
           "rays do. Holes, too deep, E (LDR-FLIP): pictures of images by "
           "the warper beside what rays see from there, over random views of the cell, among the neighbours they were sampled "
           "among "
           "and among others, before and after small holes are filled (E: after); empty where the bake was not judged. <a "
           "href=\"levels.csv\">levels.csv</a></p>\n";
}

// What covers as much as it does beside all that eyes meet of it.
std::string covering_html(const Plants& plants) {
    if (!plants.every || !plants.every->images || !plants.own.images) return "";
    std::string html =
        "<h3>Things thinner than a sample</h3>\n" + std::string(kTable) +
        table_row({"", "samples a tile", "covered, times", "unfilled", "filled holes, %", "E", "E p99", "E, unfilled"}, "th") +
        "</thead>\n<tbody>\n";
    auto row = [&](const char* title, const ImagesReport& images, double tiles) {
        const std::optional<Judged>& all = images.all.own;
        html += table_row({title, short_count(double(images.all.samples) / tiles), times(all, &Judged::filled_covered_times),
                           times(all, &Judged::covered_times), share(all, &Judged::filled_hole_share),
                           number(all, &Judged::e_mean), number(all, &Judged::e_p99), number(all, &Judged::unfilled_e_mean)},
                          "td");
    };
    row("as many samples as cover what they do", *plants.own.images, double(std::max(1u, plants.own.tiles)));
    row("all that eyes meet, one tile", *plants.every->images, 1);
    return html + kTableEnd +
           "<p class=\"note\">Beside rays, over random views of the cell. 1: as much is covered as rays say. The first is of all "
           "tiles, the other of one of them.</p>\n";
}

// Glossy plants beside rays that see the gloss from each eye.
std::string gloss_html(const Plants& plants) {
    if (!plants.gloss || !plants.gloss_none) return "";
    std::string html = "<h3>Glossy plants</h3>\n" + std::string(kTable) +
                       table_row({"", "E", "E p99", "E, nearest level", "E p99, nearest level"}, "th") + "</thead>\n<tbody>\n";
    for (const auto& [title, report] :
         {Row{"gloss as the middle of each direction's eyes sees it", *plants.gloss}, Row{"without gloss", *plants.gloss_none}}) {
        if (!report.images || report.images->levels.empty()) continue;
        const std::optional<Judged>&all = report.images->all.own, &nearest = report.images->levels[0].own;
        html += table_row({title, number(all, &Judged::e_mean), number(all, &Judged::e_p99), number(nearest, &Judged::e_mean),
                           number(nearest, &Judged::e_p99)},
                          "td");
    }
    return html + kTableEnd +
           "<p class=\"note\">All surfaces of roughness 0.3, one tile; beside rays that see every pixel's gloss from the eye "
           "itself, "
           "over the same views.</p>\n";
}

std::string plants_html(const WangPage& page, const Plants& plants) {
    std::string name = escaped(plants.name);
    auto chart = [&](const char* which, const std::string& sentence) {
        return charts_html(page, which + ("-" + plants.name), sentence);
    };
    return "<h2>Figure 2: " + name + "</h2>\n" + figure_2_html(plants.figure_2) +
           chart("away-e", "Beside rays of the same ground from the same eye; small holes filled.") +
           chart("away-holes", "Before any are filled.") + "<h2>Figures 3 and 4: which tiles, and what repeats, " + name +
           "</h2>\n" + periodicity_html(plants) + figures_html(plants.pictures, 3, 4) + "<h2>Figures 5 and 6: planting, " + name +
           "</h2>\n" + planting_html(plants) +
           charts_html(page, "density-" + plants.name, "1: as densely as anywhere. Steps are few objects wide.") +
           figures_html(plants.pictures, 5, 6) + "<h2>Figures 7 to 9, 11 and 12: images, " + name + "</h2>\n" +
           levels_html(plants) + covering_html(plants) + directions_html(plants) + gloss_html(plants) +
           figures_html(plants.pictures, 7, 12);
}

}  // namespace

std::string wang_page_html(const WangPage& page) {
    std::string body = setup_html(page) +
                       targets_html(targets_of(page.flown), target_columns(),
                                    "Red: missed; the reason is from this run's numbers. Minutes are of the machine that baked.");
    for (const Plants& plants : page.flown.plants) body += plants_html(page, plants) + fields_html(page, plants);
    if (!page.has_charts) body += "<p class=\"note\">gnuplot was not installed; the charts' scripts lie in charts/.</p>\n";
    return paper_page("Tiling layered depth images: the paper, run anew", body);
}

}  // namespace overlook::measure::paper::wang
