// Section 6 as a table and as charts.
#include "tools/measure/paper/wang_ldi/flown.h"

namespace overlook::measure::paper::wang {
namespace {

std::string cell(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
}

std::string gaps_csv(const std::optional<Gaps>& gaps) {
    if (!gaps) return ",,,";
    return fmt::format("{},{},{},{}", gaps->covered_px, gaps->gap_px, gaps->widest_px, gaps->largest_px);
}

struct Line {
    const char *family, *column, *title;
    bool is_right = false;  // by the axis on the right
};

// Lines of fields.csv of one land; x: log if is_log.
Chart chart_of(const std::string& name, const std::string& title, const std::string& plants, const FlownLand& land,
               const char* set, const char* x_name, const char* left, const char* right, std::initializer_list<Line> lines) {
    Chart chart{name, title, chart_head(lines.size())};
    chart.script +=
        x_label(x_name) + fmt::format("set datafile missing NaN\nset logscale x\nset yrange [0:*]\nset ylabel '{}'\n", left);
    if (*right != 0) chart.script += fmt::format("set ytics nomirror\nset y2tics\nset y2range [0:*]\nset y2label '{}'\n", right);
    size_t place = 0;
    for (const Line& line : lines) {
        chart.script += fmt::format(
            "{}'../fields.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq '{}' && strcol(3) eq '{}' && strcol(4) eq \"{}\" ? "
            "$6 : "
            "NaN):{} axes x1{} with linespoints lc rgb \"{}\" lw 2 dt {} pt 7 ps 0.6 title \"{}\"",
            place == 0 ? "plot " : ", \\\n", gnuplot_text(plants), land.name, set, line.family, line.column,
            line.is_right ? "y2" : "y1", chart_colour(place), line.is_right ? 2 : 1, line.title);
        ++place;
    }
    chart.script += "\n";
    return chart;
}

}  // namespace

std::string fields_csv(const Flown& flown) {
    std::string csv =
        "plants,land,set,family,what,x,frame_ms_p50,frame_ms_p99,samples,triangles,tiles,eye_outside_share,e_p99_flip,e_mean_"
        "flip,"
        "w_luma,pop_index,floor_e_p99_flip,cell_covered_px,cell_hole_px,cell_widest_px,cell_largest_px,covered_px,hole_px,widest_"
        "px,"
        "largest_px,own_times_as_fast\n";
    for (const Plants& plants : flown.plants)
        for (const FlownLand& land : plants.lands)
            for (const FieldRow& row : land.rows)
                csv += fmt::format("{},{},{},{},\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", plants.name, land.name,
                                   row.set, row.family, row.what, row.x, row.ms_p50, row.ms_p99, row.samples, row.triangles,
                                   row.tiles, row.outside_share, cell(row.e_p99), cell(row.e_mean), cell(row.w), cell(row.pop),
                                   cell(row.floor_e_p99), gaps_csv(row.in_cell), gaps_csv(row.anywhere),
                                   cell(row.own_times_as_fast));
    return csv;
}

std::vector<Chart> charts_of_fields(const Plants& plants) {
    std::vector<Chart> charts;
    for (const FlownLand& land : plants.lands) {
        auto named = [&](const char* what) { return fmt::format("{}-{}-{}", what, land.name, plants.name); };
        auto titled = [&](const char* what) { return fmt::format("{}, {} over {}", what, plants.name, land.name); };
        charts.push_back(chart_of(named("time"), titled("Time of a frame and samples against the error asked"), plants.name, land,
                                  "error", "pixels asked", "milliseconds", "samples",
                                  {{"Overlook", "7", "images, near tiles geometry"},
                                   {"geometry", "7", "all of it geometry within that error"},
                                   {"Overlook", "9", "samples warped (right)", true}}));
        charts.push_back(chart_of(
            named("race"), titled("How many times as fast as geometry in place of images"), plants.name, land, "race",
            "pixels asked", "times as fast", "",
            {{kByProcessor, "26", "as geometry by the processor"}, {kByOpenGl, "26", "as geometry by OpenGL, instanced"}}));
        charts.push_back(chart_of(named("error"), titled("E and W against the error asked"), plants.name, land, "error",
                                  "pixels asked", "E, 99th percentile (FLIP)", "W, luma",
                                  {{"Overlook", "13", "E, images"},
                                   {"geometry", "13", "E, geometry"},
                                   {"Overlook", "15", "W, images (right)", true},
                                   {"geometry", "15", "W, geometry (right)", true}}));
        charts.push_back(chart_of(named("radius"), titled("Time of a frame and samples against the radius"), plants.name, land,
                                  "radius", "tiles", "milliseconds", "samples",
                                  {{"Overlook", "7", "Overlook"},
                                   {"the paper's", "7", "the paper's"},
                                   {"Overlook", "9", "samples warped, Overlook (right)", true},
                                   {"the paper's", "9", "samples warped, the paper's (right)", true}}));
    }
    return charts;
}

}  // namespace overlook::measure::paper::wang
