#include "tools/measure/paper/fsi/page.h"

#include <algorithm>

#include "tools/measure/page_text.h"
#include "tools/measure/paper/fsi/targets.h"
#include "tools/measure/paper/page_parts.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr char kTable[] = "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>";
constexpr char kTableEnd[] = "</tbody></table></div>\n";

std::string setup_html(const FsiPage& page) {
    return fmt::format(
        "<p>Every method over the same scenes in the same run: <em>switch</em> (at once), <em>blend</em> (both levels, the "
        "fading "
        "one translucent and sorted: Giegl and Wimmer 2007), <em>dither</em> (both levels, each on the pixels that the other "
        "leaves), <em>late</em> (at once, but only within a quarter of a pixel), <em>fsi:paper</em> (as printed in 2008), "
        "<em>fsi</em> (as it should be).</p>\n<p class=\"note\">{}.</p>\n",
        machine_html(page.setup));
}

std::string point_row(const Point& point, const Point* at_once) {
    std::string ratio = at_once ? short_number(point.triangles / std::max(1.0, at_once->triangles)) : "";
    return table_row({escaped(title_of(point.scene) + (point.chain.empty() ? "" : ", " + point.chain)), escaped(point.method),
                      std::to_string(point.side_px), short_number(point.p50_ms), short_number(point.max_ms),
                      short_count(point.triangles), ratio, short_number(point.draw_calls), short_number(point.fading),
                      short_number(100 * point.odd_even), short_bytes(double(point.resident_bytes))},
                     "td", point.method == kWays[kSwitch].name ? " class=\"floor\"" : "");
}

std::string figure_8_html(const FsiPage& page) {
    std::string html = "<h2>Figure 8: frame time against viewport size</h2>\n";
    for (const Chart& chart : page.charts) {
        if (!page.has_charts || chart.name.rfind("figure-8", 0) != 0) continue;
        html += chart_html(chart.name, chart.title, "The same levels at every size. Dashes: levels made by hand.");
    }
    html += std::string(kTable) +
            table_row({"", "method", "pixels a side", "ms p50", "ms max", "triangles", "times switch", "draw calls", "changing",
                       "frame to frame, %", "on the card"},
                      "th") +
            "</thead>\n<tbody>\n";
    for (const Point& point : page.flown.points)
        html += point_row(point, find(page.flown.points, point.scene, point.chain, kWays[kSwitch].name, point.side_px));
    return html + kTableEnd +
           fmt::format(
               "<p class=\"note\">{} frames one after the other from the middle of each flight (TREES a quarter as many), one "
               "sample a pixel, methods in turns; times are of the renderer named above, counters are exact. Asked at 512 "
               "pixels: "
               "SIMPLE and TREES within 8 px, WINDMILLS within 1 px; late within a quarter of that. changing: instances between "
               "two levels. <a href=\"sizes.csv\">sizes.csv</a></p>\n",
               page.flown.frames);
}

std::string film_html(const Film& film) {
    std::string html =
        fmt::format("<h3>{}</h3>\n", escaped(title_of(film.name) + (film.chain.empty() ? "" : ", levels " + film.chain))) +
        kTable +
        table_row({"", "W entering", "W leaving", "W greatest", "W of the change", "median W", "pop entering", "pop leaving",
                   "pop index", "triangles", "frame to frame, %", "buffers"},
                  "th") +
        "</thead>\n<tbody>\n";
    for (const Take& take : film.takes) {
        Seen seen = seen_of(film, take);
        html += table_row({escaped(take.name), short_number(seen.entering_w), short_number(seen.leaving_w),
                           short_number(seen.greatest_w), short_number(seen.integrated_w), short_number(seen.median_w),
                           short_number(seen.entering_pop), short_number(seen.leaving_pop), short_number(seen.pop),
                           short_count(seen.triangles), short_number(100 * seen.odd_even), short_bytes(seen.buffer_bytes)},
                          "td");
    }
    return html + kTableEnd +
           fmt::format("<p class=\"note\">{} things {} m away, from level {} to level {}.</p>\n", film.stand.count,
                       short_number(film.stand.distance_m), film.stand.change + 1, film.stand.change);
}

std::string films_html(const Flown& flown) {
    std::string html =
        "<h2>Entering and leaving a transition</h2>\n<p>Things on an arc round the eye change level in the same frame, while the "
        "eye moves past and turns; others behind them do not change. W: change of luma from frame to frame that full geometry, 4 "
        "x 4 "
        "supersampled, does not have, over what full geometry at the method's samples has, in thousandths; of the change: summed "
        "over "
        "its frames. Pop index: of the two frames in which the change begins and ends, and of the whole film.</p>\n";
    for (const Film& film : flown.films) html += film_html(film);
    return html + "<p class=\"note\"><a href=\"films.csv\">films.csv</a></p>\n";
}

std::string pictures_html(const FsiPage& page) {
    std::string html = "<h2>Figures 1 to 7</h2>\n";
    for (const Chart& chart : page.charts)
        if (page.has_charts && chart.name == "figure-2")
            html += chart_html(chart.name, chart.title, "From the code that runs: one of the two is whole at any time.");
    if (!page.has_charts) html += "<p class=\"note\">gnuplot was not installed; the charts' scripts lie in charts/.</p>\n";
    for (const Picture& picture : page.flown.pictures)
        html +=
            picture_html(picture.name, (picture.figure > 0 ? fmt::format("Figure {}: ", picture.figure) : "") + picture.caption,
                         picture.image.width, picture.image.height);
    return html;
}

}  // namespace

std::string fsi_page_html(const FsiPage& page) {
    std::string targets =
        targets_html(targets_of(page.flown), target_columns(),
                     "Red: missed; the reason is fsi's, from this run's numbers. The worst over films and scenes stands here.");
    return paper_page("Frame-sequential interpolation: section 4 of the paper, run anew",
                      setup_html(page) + targets + figure_8_html(page) + films_html(page.flown) + pictures_html(page));
}

}  // namespace overlook::measure::paper::fsi
