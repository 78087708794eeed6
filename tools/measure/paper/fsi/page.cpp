#include "tools/measure/paper/fsi/page.h"

#include <algorithm>

#include "tools/measure/page_text.h"
#include "tools/measure/paper/fsi/targets.h"
#include "tools/measure/paper/fsi/variations.h"
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
        html += chart_html(
            chart.name, chart.title,
            "The same levels at every size. Dashes: levels made by hand. Heavy shader: many lights more for each pixel.");
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
        table_row({"", "W entering", "W leaving", "W greatest", "W of the change", "median W", "at rest, times switch",
                   "in the change, times switch", "ends, times median", "greatest, times median", "pop entering", "pop leaving",
                   "levels at rest", "pop index", "triangles", "frame to frame, %", "buffers"},
                  "th") +
        "</thead>\n<tbody>\n";
    for (const Take& take : film.takes) {
        Seen seen = seen_of(film, take);
        html += table_row({escaped(take.name), short_number(seen.entering_w), short_number(seen.leaving_w),
                           short_number(seen.greatest_w), short_number(seen.integrated_w), short_number(seen.median_w),
                           short_number(seen.rest_ratio), short_number(seen.change_ratio), short_number(seen.end_ratio),
                           short_number(seen.greatest_ratio), short_number(seen.entering_pop), short_number(seen.leaving_pop),
                           short_number(seen.standing_pop), short_number(seen.pop), short_count(seen.triangles),
                           short_number(100 * seen.odd_even), short_bytes(seen.buffer_bytes)},
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
        "its frames. Times switch: W as it is over hard switching's in the same frames, of the frames before the change or of "
        "those "
        "after it, whichever is worse, and summed over the change's, of which hard switching has all in one; the median of a "
        "whole "
        "film is that of whichever level a method shows longer, and compares one method's coarse level with another's fine one. "
        "Times median: W as it is in the frame in which the change begins or the first after it, and in any frame of it, over "
        "its "
        "median from the one to the other. Pop index: of the worst tile of the two frames in which the change begins and ends, "
        "over the greatest W that its two levels have at rest in that frame and tile, or the floor if that has more; beside it "
        "what one level at rest has there over the floor, where nothing changes; and of the whole film, over the floor.</p>\n";
    for (const Film& film : flown.films) html += film_html(film);
    return html + "<p class=\"note\"><a href=\"films.csv\">films.csv</a></p>\n";
}

std::string variations_html(const Flown& flown) {
    std::string html =
        "<h2>What each remedy buys, reprojection, 16-bit buffers</h2>\n<p>The same film with one thing changed, beside the "
        "method as it "
        "is.</p>\n";
    for (const Film& film : flown.varied) {
        html +=
            fmt::format("<h3>{}</h3>\n", escaped(title_of(film.name))) + kTable +
            table_row({"", "W entering", "W leaving", "W of the change", "pop index", "frame to frame, %", "what is left out"},
                      "th") +
            "</thead>\n<tbody>\n";
        for (const Variation& one : variations()) {
            auto take_named = [&](std::string_view name) {
                return std::find_if(film.takes.begin(), film.takes.end(), [&](const Take& take) { return take.name == name; });
            };
            auto take = take_named(one.name), whole = take_named(kWays[one.way].name);
            Seen seen = seen_of(film, *take);
            std::string said(one.purpose);
            if (!one.setting.empty()) said += " " + change_of(seen_of(film, *whole), seen) + ".";
            html += table_row({with_labels_html(one.name), short_number(seen.entering_w), short_number(seen.leaving_w),
                               short_number(seen.integrated_w), short_number(seen.pop), short_number(100 * seen.odd_even), ""},
                              "td", one.setting.empty() ? " class=\"floor\"" : "") +
                    said_row(escaped(said), 7);
        }
        html += kTableEnd;
    }
    return html +
           "<p class=\"note\">Ids of 16 bits begin to collide beyond 2,048 instances, and move-instances is of things that move "
           "from "
           "place to place: neither is in these films. <a href=\"variations.csv\">variations.csv</a></p>\n";
}

std::string optimised_html(const Flown& flown) {
    std::string html;
    for (const Film& film : flown.optimised) html += film_html(film);
    return html.empty() ? html : "<h2>A visibility that was optimised, where outlines do not match</h2>\n" + html;
}

std::string combining_html(const Flown& flown) {
    std::string html = "<h2>Putting two frames together</h2>\n" + std::string(kTable) +
                       table_row({"", "method", "at rest, ms", "while all change, ms", "in squares that may change, %",
                                  "put together, %", "a pass that copies, ms", "a copy in memory, ms", "times the pass"},
                                 "th") +
                       "</thead>\n<tbody>\n";
    for (const Combining& one : flown.combining)
        html += table_row(
            {escaped(title_of(one.scene)), escaped(one.method), short_number(one.rest_ms), short_number(one.changing_ms),
             short_number(100 * one.changing_share), short_number(100 * one.searched_share), short_number(one.pass_ms),
             short_number(one.copy_ms), short_number(one.changing_ms / one.pass_ms)},
            "td");
    return html + kTableEnd +
           "<p class=\"note\">512 x 512, one sample a pixel, medians of 15. The pass that copies reads colour, ids and depth of "
           "both "
           "buffers at its own pixel and writes colour and depth. <a href=\"combining.csv\">combining.csv</a></p>\n";
}

std::string drawbacks_html(const Flown& flown) {
    std::string html = "<h2>The six drawbacks of blending</h2>\n" + std::string(kTable) +
                       table_row({"", "counted", "blend", "fsi:paper", "fsi"}, "th") + "</thead>\n<tbody>\n";
    for (const auto& [scene, drawbacks] : flown.drawbacks)
        for (const Drawback& one : drawbacks)
            html += table_row({fmt::format("{}. {}: {}", one.number, title_of(scene), escaped(one.what)), escaped(one.unit),
                               short_number(one.of_way[0]), short_number(one.of_way[1]), short_number(one.of_way[2])},
                              "td");
    return html + kTableEnd +
           "<p class=\"note\">One thing, a quarter of the way from level 1 to level 0, 256 x 256 pixels, one sample each, the "
           "eye at "
           "rest. 6: the coarsest level twice, in other triangles and another colour.</p>\n";
}

std::string sequences_html(const Flown& flown) {
    std::string html =
        "<h2>Side by side</h2>\n<p>A row a method: switch, blend, dither, late, fsi:paper, fsi. A column a frame: the last "
        "before the "
        "change, its first, third, fifth and seventh, the first after it.</p>\n";
    for (const Picture& picture : flown.sequences)
        html += picture_html(picture.name, picture.caption, picture.image.width, picture.image.height);
    return html;
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
                      setup_html(page) + targets + figure_8_html(page) + films_html(page.flown) + variations_html(page.flown) +
                          optimised_html(page.flown) + combining_html(page.flown) + drawbacks_html(page.flown) +
                          pictures_html(page) + sequences_html(page.flown));
}

}  // namespace overlook::measure::paper::fsi
