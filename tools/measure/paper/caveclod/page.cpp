#include "tools/measure/paper/caveclod/page.h"

#include <algorithm>

#include "tools/measure/page.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/caveclod/targets.h"
#include "tools/measure/paper/page_parts.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::cameras {
namespace {

constexpr char kTable[] = "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>";

std::string percent(double share) {
    return fmt::format("{:.1f}", 100 * share);
}

std::string setup_html(const CaveclodPage& page) {
    const Flown& flown = page.flown;
    const Flying& flying = flown.flying;
    double step_s = flown.subjects[flown.canyon].step_s;
    return fmt::format(
        "<p>Cameras A to D over each terrain on a screen of {} x {} pixels: one has the screen, the second its top left quarter, "
        "three and four a quadrant each. {} frames of two minutes' flight at {} frames a second, in clips of {} spread evenly "
        "over it, each begun with what {} frames before it left. What is held against each other draws at {} px of error, "
        "counted "
        "alike: splits and collapses. <em>With</em> CAVECLOD each camera has its own faces; <em>without</em>, one refinement is "
        "brought to each camera in turn.</p>\n<p>The paper's own form is flown at its 7 % of tolerance as well. Our reading: a "
        "node is split while the sphere of all that hangs below it is wider on the screen than 7 % of the picture's width "
        "(Luebke's criterion, which the paper names).</p>\n<p class=\"note\">{}.</p>\n",
        flying.width_px, flying.height_px, flying.frames, short_number(1 / step_s), kClipFrames, kLeadFrames,
        short_number(flying.settings.error_px), machine_html(page.setup));
}

std::string coarser_rows(const FlownSubject& subject) {
    std::string html;
    for (const Flyover& flyover : subject.flyovers) {
        if (flyover.way != Way::own || flyover.step_s == subject.step_s) continue;
        const Flyover* shared = subject.find(Way::shared, flyover.cameras, flyover.step_s);
        if (shared == nullptr) continue;
        html += table_row(
            {fmt::format("{}, {} frames a second", escaped(title_of(subject)), short_number(1 / flyover.step_s)),
             std::to_string(flyover.cameras), short_count(operations_per_s(*shared)), "", short_count(operations_per_s(flyover)),
             short_count(splits_per_s(flyover)), short_number(operations_per_s(*shared) / operations_per_s(flyover)), ""},
            "td");
    }
    return html;
}

std::string operations_html(const Flown& flown) {
    std::string html =
        std::string("<h2>Operations a second and camera</h2>\n") + kTable +
        table_row({"", "cameras", "shared", "caveclod:paper", "caveclod", "splits of it", "times fewer", "caveclod:paper at 7 %"},
                  "th") +
        "</thead>\n<tbody>\n";
    html += table_row({"Grand Canyon, printed", "4", short_count(Printed::kSharedOperations_per_s), "", "",
                       "below " + short_count(Printed::kOwnSplits_per_s) + " mostly", "", ""},
                      "td", " class=\"floor\"");
    for (const FlownSubject& subject : flown.subjects)
        for (uint32_t cameras = 1; cameras <= kMostCameras; ++cameras) {
            const Flyover *own = subject.find(Way::own, cameras), *shared = subject.find(Way::shared, cameras);
            const Flyover *printed = subject.find(Way::printed, cameras), *at_7 = subject.find(Way::printed_7, cameras);
            if (own == nullptr || shared == nullptr || printed == nullptr || at_7 == nullptr) continue;
            std::optional<double> ratio = operations_ratio(subject, Way::own, cameras);
            html += table_row(
                {escaped(title_of(subject)), std::to_string(cameras), short_count(operations_per_s(*shared)),
                 short_count(operations_per_s(*printed)), short_count(operations_per_s(*own)), short_count(splits_per_s(*own)),
                 ratio ? short_number(*ratio) : "none", short_count(operations_per_s(*at_7))},
                "td");
        }
    for (const FlownSubject& subject : flown.subjects) html += coarser_rows(subject);
    return html +
           "</tbody></table></div>\n<p class=\"note\">Beyond what the picture needs, caveclod splits 10 degrees outside the "
           "frame's "
           "border and whatever a triangle was measured with, and collapses only below 0.7 of the error; caveclod:paper has no "
           "such "
           "band, and lets triangles be drawn that nobody has measured. With one camera "
           "nothing is brought from one to another. <a href=\"flyovers.csv\">flyovers.csv</a>, <a "
           "href=\"windows.csv\">windows.csv</a></p>\n";
}

std::string sentence_of(const std::string& chart, const Flown& flown) {
    const FlownSubject &canyon = flown.subjects[flown.canyon], &lakes = flown.subjects[flown.lakes];
    auto operations = [&](Way way) {
        const Flyover* flyover = canyon.find(way, kMostCameras);
        return flyover ? short_count(operations_per_s(*flyover)) : std::string("none");
    };
    if (chart == "figure-10") return "A camera in the mean: " + operations(Way::shared) + " a second; the paper's 14,868.";
    if (chart == "figure-11")
        return fmt::format("A camera in the mean: {} a second; the paper's form at 7 % {}.", operations(Way::own),
                           operations(Way::printed_7));
    if (chart == "figure-12" && !flown.rates.empty())
        return fmt::format(
            "In the mean {} frames a second with, {} without, {} times as many; refined and drawn in turns, frame "
            "by frame.",
            short_number(mean_fps(flown.rates, &Rate::with_fps)), short_number(mean_fps(flown.rates, &Rate::without_fps)),
            short_number(mean_fps(flown.rates, &Rate::with_fps) / mean_fps(flown.rates, &Rate::without_fps)));
    if (chart == "figure-13")
        return fmt::format("The finest mesh has {}. Lines: as printed at 7 %; dashes: caveclod at {} px.",
                           short_count(double(lakes.face_count)), short_number(flown.flying.settings.error_px));
    if (chart == "figure-14") return "Lines: as printed at 7 %, equation 1; dashes: caveclod, all that it keeps.";
    return "";
}

std::string charts_html(const CaveclodPage& page) {
    std::string html = "<h2>Figures 10 to 14</h2>\n";
    if (!page.has_charts) return html + "<p class=\"note\">gnuplot was not installed; the scripts lie in charts/.</p>\n";
    for (const Chart& chart : page.charts) html += chart_html(chart.name, chart.title, sentence_of(chart.name, page.flown));
    return html +
           "<p class=\"note\">Frame rates are of the renderer named above. <a href=\"memory.csv\">memory.csv</a>, <a "
           "href=\"frame_rates.csv\">frame_rates.csv</a></p>\n";
}

std::string coverage_html(const Flown& flown) {
    std::string html = std::string("<h2>Section 4.4: render vertices in use, % of all</h2>\n") + kTable +
                       table_row({"", "1 camera", "2 cameras", "3 cameras", "4 cameras"}, "th") + "</thead>\n<tbody>\n";
    html += table_row({"printed", "", "grows", "grows", "grows"}, "td", " class=\"floor\"");
    for (const FlownSubject& subject : flown.subjects)
        for (Way way : {Way::printed_7, Way::own}) {
            std::vector<std::string> cells = {escaped(title_of(subject) + ", " + name_of(way))};
            for (uint32_t cameras = 1; cameras <= kMostCameras; ++cameras) {
                const Flyover* flyover = subject.find(way, cameras);
                cells.push_back(flyover ? percent(mean_used_share(*flyover)) : "");
            }
            html += table_row(cells, "td");
        }
    return html +
           "</tbody></table></div>\n<p class=\"note\">By all cameras together, the mean over every tenth frame. The paper prints "
           "no number, only that it grows with the cameras. From two cameras to three the pictures become quadrants, and show "
           "less detail each.</p>\n";
}

std::string pictures_html(const Flown& flown) {
    std::vector<std::pair<const Picture*, const FlownSubject*>> all;
    for (const FlownSubject& subject : flown.subjects)
        for (const Picture& picture : subject.pictures) all.emplace_back(&picture, &subject);
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first->figure < b.first->figure; });
    std::string html = "<h2>Figures 1, 2 and 5 to 9</h2>\n<div class=\"pictures\">\n";
    for (const auto& [picture, subject] : all)
        html +=
            picture_html(picture->name, fmt::format("Figure {}, {}: {}", picture->figure, title_of(*subject), picture->caption),
                         picture->image.width, picture->image.height);
    return html + "</div>\n<p class=\"note\">Figures 3 and 4 of the paper are diagrams.</p>\n";
}

}  // namespace

std::string caveclod_page_html(const CaveclodPage& page) {
    std::vector<Table1Row> rows;
    for (const FlownSubject& subject : page.flown.subjects) rows.push_back(subject.memory);
    std::string targets =
        targets_html(targets_of(page.flown), target_columns(), "Red: missed; the reason is caveclod's, from this run's numbers.");
    return paper_page("CAVECLOD: section 4 of the paper, run anew", setup_html(page) + targets + operations_html(page.flown) +
                                                                        charts_html(page) + table1_html(rows) +
                                                                        coverage_html(page.flown) + pictures_html(page.flown));
}

}  // namespace overlook::measure::paper::cameras
