#include "tools/measure/paper/lod_sprite/page_sections.h"

#include <cmath>

#include "tools/measure/page.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"

namespace overlook::measure::paper::sprite {
namespace {

std::string percent(double share) {
    return fmt::format("{:.2f}", 100 * share);
}

std::vector<std::string> cells_of(const RunResult& run) {
    RemedyFigures f = figures_of(run);
    return {short_number(f.mean_ms),   short_number(f.p99_ms), short_count(f.triangles), short_count(f.key_pixels),
            short_count(f.keys),       short_number(f.e_mean), short_number(f.e_p99),    short_number(f.w_mean),
            short_number(f.pop_index), percent(f.ghost_share), percent(f.loss_share),    short_count(f.hole_px)};
}

std::string remedy_row(const RemedyRow& row, const RemedyFigures& whole) {
    std::vector<std::string> cells = {escaped(row.name)};
    if (!row.off.empty()) cells[0] += "<br><code>" + escaped(row.off) + "</code>";
    std::vector<std::string> numbers = cells_of(row.run);
    cells.insert(cells.end(), numbers.begin(), numbers.end());
    std::string text = escaped(row.purpose);
    if (!row.off.empty()) text += " <strong>Then: " + escaped(change_of(whole, figures_of(row.run))) + ".</strong>";
    return table_row(cells, "td") + fmt::format("<tr class=\"said\"><td colspan=\"{}\">{}</td></tr>\n", cells.size(), text);
}

}  // namespace

std::string remedies_html(const RemedyTable& table) {
    if (table.rows.empty()) return "";
    std::string html = fmt::format(
        "<h2>What each remedy buys</h2>\n<p>Each is switched off alone. {} frames of the flight's {} from frame {} on, over the "
        "range, and the last {} of them back again, begun {} frames earlier; all rows took turns in one run.</p>\n",
        table.forward_frames, RemedyTable::kStepFrames, table.first_frame, table.back_frames, table.lead_frames);
    html += "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>" +
            table_row({"", "mean ms", "p99 ms", "triangles", "key px", "keys", "E", "E p99", "W", "pop index", "ghosts %",
                       "losses %", "holes px"},
                      "th") +
            "</thead>\n<tbody>\n";
    RemedyFigures whole = figures_of(table.whole().run);
    for (const RemedyRow& row : table.rows) html += remedy_row(row, whole);
    std::vector<std::string> floor = {"the floor"};
    std::vector<std::string> numbers = cells_of(table.floor);
    floor.insert(floor.end(), numbers.begin(), numbers.end());
    html += table_row(floor, "td", " class=\"floor\"");
    return html +
           "</tbody></table></div>\n<p class=\"note\">Triangles and key pixels: a frame, in the mean, keys included. E: LDR-FLIP "
           "beside the reference on every tenth frame, mean and 99th percentile over pixels; W: every frame. Ghosts and losses: "
           "of "
           "the surface's pixels, in the mean. Holes: of the worst frame. Changes are told from 15 % of the mean "
           "time on, half of its 99th percentile, a twentieth of anything else. <a href=\"remedies.csv\">remedies.csv</a></p>\n";
}

std::string held_keys_html(const std::vector<HeldRun>& runs, bool has_charts) {
    if (runs.empty()) return "";
    std::string html =
        "<h2>Ghosts and losses against parallax</h2>\n<p>Keys are held far longer than their methods would, so that all "
        "parallaxes "
        "are there. Parallax of a pixel: how far from its place, in pixels, its point would be shown if the key's picture were "
        "only turned to where the camera looks now. Of the pixels asked of keys; near geometry, drawn on purpose, stands beside "
        "them.</p>\n<div class=\"wide\"><table class=\"runs numbers\">\n<thead>";
    html += table_row({"up to 32 px of parallax", "ghosts %", "losses %", "near geometry %", "frames judged"}, "th") +
            "</thead>\n<tbody>\n";
    html += table_row({"to reach", "&le; " + percent(HeldGoals::kGhosts), "&le; " + percent(HeldGoals::kLosses), "", ""}, "td");
    html += table_row({"prototype of the paper, its parallaxes not printed", percent(HeldGoals::kPrototypeGhosts),
                       percent(HeldGoals::kPrototypeLosses), "", ""},
                      "td");
    auto marked = [](double share, double goal) {
        return share <= goal ? percent(share) : "<strong class=\"broken\">" + percent(share) + "</strong>";
    };
    for (const HeldRun& run : runs) {
        ParallaxBin below = run.tally.up_to(HeldGoals::kEdge_px);
        double all_px = double(below.asked_px + below.near_px);
        html += table_row(
            {escaped(run.title), marked(below.ghost_share(), HeldGoals::kGhosts), marked(below.loss_share(), HeldGoals::kLosses),
             percent(all_px > 0 ? double(below.near_px) / all_px : 0), short_count(run.judged_frames)},
            "td");
    }
    html += "</tbody></table></div>\n";
    if (has_charts) {
        html += chart_html("ghosts-parallax", "Ghosts against parallax", "Shown from a key that did not see the surface.");
        html += chart_html("losses-parallax", "Losses against parallax", "Seen by a key, but not shown from it.");
    }
    return html + "<p class=\"note\"><a href=\"held_keys.csv\">held_keys.csv</a></p>\n";
}

}  // namespace overlook::measure::paper::sprite
