// Figures 10 to 14, by gnuplot from the tables.
#include "tools/measure/page_text.h"
#include "tools/measure/paper/caveclod/flown.h"

namespace overlook::measure::paper::cameras {
namespace {

struct Line {
    Way way = Way::own;
    uint32_t cameras = kMostCameras;
    std::string title, style;
};

// A line of windows.csv, of one camera: 5 time, 6 splits, 8 operations, 9 triangles.
std::string camera_line(const FlownSubject& subject, const Line& line, char camera, int column) {
    return fmt::format(
        "'../windows.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq {} && $3 == {} && strcol(4) eq '{}' ? $5 : NaN):{} with "
        "linespoints {} title {}",
        gnuplot_text(subject.name), gnuplot_text(name_of(line.way)), line.cameras, camera, column, line.style,
        gnuplot_text(line.title));
}

std::string solid(size_t place) {
    return fmt::format("lc rgb \"{}\" lw 2 pt 7 ps 0.5", chart_colour(place));
}
std::string dashed(size_t place) {
    return fmt::format("lc rgb \"{}\" lw 1.5 dt 2 pt 6 ps 0.5", chart_colour(place));
}

std::string joined(const std::vector<std::string>& lines) {
    std::string plot = "plot ";
    for (const std::string& line : lines) plot += (plot.size() > 5 ? ", \\\n" : "") + line;
    return plot + "\n";
}

// A level that the paper prints, named where it is.
std::string printed_level(double value, const std::string& title) {
    return fmt::format(
        "set style textbox opaque noborder fc rgb '#ffffff'\nset arrow from graph 0, first {0} to graph 1, first {0} nohead back "
        "lc rgb \"#666666\" lw 1.5 dt 2\nset label {1} at graph 0.99, first {0} right offset 0,0.6 tc rgb \"#333333\" font ',12' "
        "noenhanced front boxed\n",
        value, gnuplot_text(title));
}

std::string over_flight(const Flown& flown, const std::string& y) {
    return x_label("seconds of flight") + fmt::format("set xrange [0:{}]\nset ylabel {}\n", flown.flight_s, gnuplot_text(y));
}

// Each camera of one way, in a colour each.
std::vector<std::string> camera_lines(const FlownSubject& subject, Way way, int column, bool is_dashed) {
    std::vector<std::string> lines;
    for (uint32_t i = 0; i < kMostCameras; ++i) {
        Line line{way, kMostCameras, fmt::format("{}, {}", char('A' + i), name_of(way)), is_dashed ? dashed(i) : solid(i)};
        lines.push_back(camera_line(subject, line, char('A' + i), column));
    }
    return lines;
}

Chart operations(const Flown& flown, Way way) {
    const FlownSubject& canyon = flown.subjects[flown.canyon];
    bool is_own = way == Way::own;
    Chart chart{is_own ? "figure-11" : "figure-10",
                fmt::format("Figure {}: operations a second {} CAVECLOD, four cameras over {}", is_own ? 11 : 10,
                            is_own ? "with" : "without", title_of(canyon)),
                chart_head(is_own ? 8 : 4)};
    chart.script += over_flight(flown, "splits and collapses a second");
    // As high as what the paper prints.
    chart.script += is_own ? "set yrange [0:2300<*]\nset format y '%.0f'\n" : "set yrange [0:*]\nset format y '%.0s%c'\n";
    std::vector<std::string> lines = camera_lines(canyon, way, 8, false);
    if (is_own) {
        std::vector<std::string> others = camera_lines(canyon, Way::printed_7, 8, true);
        lines.insert(lines.end(), others.begin(), others.end());
        chart.script += printed_level(Printed::kOwnSplits_per_s, "paper: splits below 2,000 for most of the flyover");
    } else {
        chart.script += printed_level(Printed::kSharedOperations_per_s, "paper: 14,868 in the mean");
    }
    chart.script += joined(lines);
    return chart;
}

Chart rates(const Flown& flown) {
    Chart chart{"figure-12", "Figure 12: frames a second, four cameras over " + title_of(flown.subjects[flown.canyon]),
                chart_head(2)};
    chart.script += over_flight(flown, "frames a second") + "set yrange [0:*]\n";
    chart.script += joined(
        {"'../frame_rates.csv' skip 1 using 1:2 with linespoints " + solid(0) + " title 'with CAVECLOD'",
         "'../frame_rates.csv' skip 1 using 1:3 with linespoints " + solid(1) + " title 'without: one refinement for all'"});
    return chart;
}

Chart polygons(const Flown& flown) {
    const FlownSubject& lakes = flown.subjects[flown.lakes];
    Chart chart{"figure-13", "Figure 13: active polygons of each camera, four cameras over " + title_of(lakes), chart_head(8)};
    chart.script += over_flight(flown, "active polygons") + "set yrange [0:*]\nset format y '%.0s%c'\n";
    std::vector<std::string> lines = camera_lines(lakes, Way::printed_7, 9, false);
    std::vector<std::string> own = camera_lines(lakes, Way::own, 9, true);
    lines.insert(lines.end(), own.begin(), own.end());
    chart.script += joined(lines);
    return chart;
}

Chart memory(const Flown& flown) {
    const FlownSubject& lakes = flown.subjects[flown.lakes];
    Chart chart{"figure-14", "Figure 14: memory of the flyovers of " + title_of(lakes), chart_head(8)};
    chart.script += over_flight(flown, "bytes") + "set yrange [0:*]\nset format y '%.0s%cB'\n";
    std::vector<std::string> lines;
    for (Way way : {Way::printed_7, Way::own})
        for (uint32_t cameras = 1; cameras <= kMostCameras; ++cameras)
            lines.push_back(fmt::format(
                "'../memory.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq {} && $3 == {} ? $4 : NaN):5 with linespoints {} "
                "title {}",
                gnuplot_text(lakes.name), gnuplot_text(name_of(way)), cameras,
                way == Way::own ? dashed(cameras - 1) : solid(cameras - 1),
                gnuplot_text(fmt::format("{} camera{}, {}", cameras, cameras > 1 ? "s" : "", name_of(way)))));
    chart.script += joined(lines);
    return chart;
}

}  // namespace

std::vector<Chart> charts_10_to_14(const Flown& flown) {
    return {operations(flown, Way::shared), operations(flown, Way::own), rates(flown), polygons(flown), memory(flown)};
}

}  // namespace overlook::measure::paper::cameras
