#include "tools/measure/charts.h"

#include <algorithm>
#include <array>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"

namespace overlook::measure {
namespace {

// Okabe and Ito's colours, which the colour-blind tell apart; the floor is always black.
constexpr std::array<const char*, 7> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7F7F00"};
// Of the curves whose colour another one has already.
constexpr std::array<const char*, 3> kDashes = {"1", "(12,5)", "(4,4)"};
constexpr std::array<int, 6> kPoints = {7, 5, 9, 13, 11, 15};

std::string quoted(const std::string& text) {
    std::string safe = "'";
    for (char c : text) safe += c == '\'' ? "''" : std::string(1, c);
    return safe + "'";
}

constexpr char kHead[] = R"(# Draws one chart. Run it in this folder; what stands below is what measure draws for wide screens.
if (!exists("kind")) kind = "svg"
if (!exists("width")) width = 900
if (!exists("height")) height = 540
# A narrow chart is as high as its key needs.
key_columns = width < 600 ? 1 : 3
key_px = 19.0 * ceil(1.0 * key_rows / key_columns)
if (width < 600) height = 400 + key_px
if (!exists("to")) to = "chart." . kind
if (kind eq "png") set terminal pngcairo size width,height font "DejaVu Sans,12" background "#ffffff"; else set terminal svg size width,height dynamic font "DejaVu Sans,Verdana,sans-serif,14" background "#ffffff"
set output to
set encoding utf8
set datafile separator ","
set border 3 lc rgb "#555555"
set tics nomirror textcolor rgb "#222222"
set grid lc rgb "#dddddd" lt 1
set key outside below left Left reverse samplen 2 noenhanced maxcols key_columns font ",12"
set ylabel offset 1,0
set xtics offset 0,0.3
set xlabel offset 0,0.95
is_narrow = width < 600
)";

// In the order of the runs, each family once; the floor's last.
std::vector<std::string> families_of(const CourseResult& course) {
    std::vector<std::string> families;
    for (const RunResult& run : course.runs) {
        std::string family = family_of(run.spec);
        if (!is_floor(run.spec) && std::find(families.begin(), families.end(), family) == families.end()) {
            families.push_back(family);
        }
    }
    return families;
}

std::string style_of(const CourseResult& course, size_t run, double width) {
    if (is_floor(course.runs[run].spec)) return fmt::format("lc rgb \"#000000\" lw {} dt 2", width);
    size_t place = 0;
    for (size_t i = 0; i < run; ++i) place += is_floor(course.runs[i].spec) ? 0 : 1;
    const char* dashes = kDashes[std::min(place / kColours.size(), kDashes.size() - 1)];
    return fmt::format("lc rgb \"{}\" lw {} dt {}", kColours[place % kColours.size()], width, dashes);
}

// runs.csv's columns: 1 run, 2 method, 3 is_floor, 4 e, 7 frame_ms_p50, 9 triangles_p50, 10 resident bytes.
Chart front(const CourseResult& course, const std::string& name, const std::string& title, const std::string& cost, int column) {
    Chart chart{name, title, chart_head(families_of(course).size() + 1)};
    chart.script +=
        fmt::format("set xlabel {}\nset ylabel 'E: LDR-FLIP, 99th percentile'\nset logscale x\nset yrange [0:*]\n", quoted(cost));
    chart.script += "set format x '%.0s%c'\nset offsets graph 0.08, graph 0.08, graph 0.12, 0\n";
    chart.script += "size_of(bytes) = (is_narrow ? 0.5 : 1) * (0.35 * sqrt(bytes / 1e6) + 0.4)\n";
    std::string lines, dots;
    size_t place = 0;
    for (const std::string& family : families_of(course)) {
        const char* colour = kColours[place % kColours.size()];
        std::string of = fmt::format("(strcol(2) eq {} ? ${} : NaN)", quoted(family), column);
        lines += fmt::format("'../runs.csv' skip 1 using {}:4 with lines lc rgb \"{}\" lw 2 title {}, \\\n", of, colour,
                             quoted(family));
        dots += fmt::format(
            "'../runs.csv' skip 1 using {}:4:(size_of($10)) with points pt {} ps variable lc rgb \"{}\" notitle, \\\n", of,
            kPoints[place % kPoints.size()], colour);
        dots += fmt::format(
            "'../runs.csv' skip 1 using {}:4:(swept(strcol(1))) with labels noenhanced font ',12' {} tc rgb \"{}\" notitle, \\\n",
            of, place % 2 == 0 ? "left offset 0.9,0.4" : "right offset -0.9,-0.3", colour);
        ++place;
    }
    chart.script +=
        "value_of(text) = substr(text, 1, strstrt(text . '@', '@') - 1)\n"  // up to the next setting
        "swept(run) = strstrt(run, '@triangles=') > 0 ? gprintf('%.0s%c', real(value_of(substr(run, strstrt(run, '@triangles=') "
        "+ "
        "11, strlen(run))))) : strstrt(run, 'error-px=') == 0 ? '' : value_of(substr(run, strstrt(run, 'error-px=') + 9, "
        "strlen(run))) . ' px'\n";
    chart.script += "plot " + lines + dots;
    chart.script += fmt::format(
        "'../runs.csv' skip 1 using ($3 == 1 ? ${} : NaN):4:(size_of($10)) with points pt 6 lw 2 ps variable lc rgb \"#000000\" "
        "title 'full: the floor (dot area: bytes held)'\n",
        column);
    return chart;
}

std::string column_of(std::string_view name) {
    size_t column = 4;
    for (const Figure& one : figures()) {
        if (one.name == name) return std::to_string(column);
        ++column;
    }
    return "1";
}

// With the settings alone in which it differs from another run of its curve.
std::string short_label(const CourseResult& course, size_t run) {
    const MethodSpec& spec = course.runs[run].spec;
    std::string label = family_of(spec).substr(0, family_of(spec).find('@'));
    for (size_t i = 0; i < spec.settings.size(); ++i) {
        bool differs = std::any_of(course.runs.begin(), course.runs.end(), [&](const RunResult& other) {
            return family_of(other.spec) == family_of(spec) && other.spec.settings[i].second != spec.settings[i].second;
        });
        if (differs) label += fmt::format("@{}={}", spec.settings[i].first, spec.settings[i].second);
    }
    return label;
}

// One line a run of a column of frames.csv over the frames.
std::string lines_over_flight(const CourseResult& course, std::string_view name, bool has_title) {
    std::string plot = "plot ";
    for (size_t i = 0; i < course.runs.size(); ++i) {
        const std::string& label = course.runs[i].label;
        plot += fmt::format("{}'../frames.csv' skip 1 using (strcol(1) eq {} ? $2 : NaN):{} with lines {} {}",
                            i == 0 ? "" : ", \\\n", quoted(label), column_of(name), style_of(course, i, 1.8),
                            has_title ? "title " + quoted(short_label(course, i)) : "notitle");
    }
    // Events as ticks at the foot.
    plot +=
        fmt::format(", \\\n'../frames.csv' skip 1 using (${} > 0 ? $2 : NaN):(0) with points pt 2 lc rgb \"#000000\" notitle\n",
                    column_of("events"));
    return plot;
}

bool has_pictures(const CourseResult& course) {
    return std::all_of(course.runs.begin(), course.runs.end(), [](const RunResult& run) { return run.worst_e.is_there; });
}

Chart over_flight(const CourseResult& course) {
    Chart chart{"flight", "Steadiness and frame time over the flight", chart_head(course.runs.size())};
    if (!has_pictures(course)) {
        chart.title = "Frame time over the flight";
        chart.script += "set xlabel 'frame'\nset ylabel 'frame time, ms'\nset logscale y\n";
        chart.script += lines_over_flight(course, "frame_ms", true);
        return chart;
    }
    chart.script += fmt::format("set xrange [0:{}]\n", std::max<size_t>(1, course.runs.front().frames.size() - 1));
    chart.script += "set multiplot\nset lmargin is_narrow ? 9 : 11\nset rmargin 2\n";
    chart.script +=
        "low = (key_px + 0.55 * (height - key_px)) / height\nset origin 0,low\nset size 1,1-low\nset bmargin 1.5\nset ylabel 'W, "
        "luma'\nset yrange [0:*]\nset xtics format ''\n";
    chart.script += "unset key\n" + lines_over_flight(course, "w_luma", false);
    chart.script +=
        "set origin 0,0\nset size 1,low\nunset bmargin\nset ylabel 'frame time, ms'\nset autoscale y\nset logscale y\n"
        "set xtics format '%g'\nset xlabel 'frame'\n"
        "set key outside below left Left reverse samplen 2 noenhanced maxcols key_columns font ',12'\n";
    chart.script += lines_over_flight(course, "frame_ms", true) + "unset multiplot\n";
    return chart;
}

Chart distribution(const CourseResult& course) {
    Chart chart{"distribution", "How the errors are spread", chart_head(course.runs.size())};
    chart.script += "set xlabel 'E of a frame: LDR-FLIP, 99th percentile'\nset ylabel 'share of frames at most so'\n";
    chart.script += "set yrange [0:1.02]\nset format y '%.1f'\nif (is_narrow) set xtics 0.1\nplot ";
    for (size_t i = 0; i < course.runs.size(); ++i) {
        const std::string& label = course.runs[i].label;
        chart.script +=
            fmt::format("{}'../frames.csv' skip 1 using (strcol(1) eq {} ? ${} : NaN):(1) smooth cnorm with steps {} title {}",
                        i == 0 ? "" : ", \\\n", quoted(label), column_of("e_p99_flip"), style_of(course, i, 2),
                        quoted(short_label(course, i)));
    }
    chart.script += "\n";
    return chart;
}

// honesty.csv's columns: 1 method, 2 promised, 4 measured in the median, 6 and 7 the worst and what was promised of it. A curve
// of worst things with dots, one of median things in dashes.
Chart promise(const CourseResult& course) {
    Chart chart{"promise", "Promised against measured pixels", chart_head(2 * families_of(course).size() + 1)};
    chart.script +=
        "set xlabel 'promised of a triangle, pixels'\nset ylabel 'measured of it, pixels'\nset logscale xy\n"
        "set format x '%g'\nset format y '%g'\nset xrange [0.01:*]\nset yrange [0.005:*]\n";
    chart.script += "plot x with lines lc rgb \"#000000\" dt 2 lw 1.5 title 'as much as was promised'";
    size_t place = 0;
    for (const std::string& family : families_of(course)) {
        const char* colour = kColours[place % kColours.size()];
        std::string of = fmt::format("(strcol(1) eq {} ? ", quoted(family));
        chart.script += fmt::format(
            ", \\\n'../honesty.csv' skip 1 using {0}$7 : NaN):6 with linespoints pt {1} ps 0.6 lw 1.8 lc rgb \"{2}\" title {3}",
            of, kPoints[place % kPoints.size()], colour, quoted(family + ": the worst triangle"));
        chart.script +=
            fmt::format(", \\\n'../honesty.csv' skip 1 using {0}$2 : NaN):4 with lines dt 3 lw 1.8 lc rgb \"{1}\" title {2}", of,
                        colour, quoted(family + ": the median triangle"));
        ++place;
    }
    chart.script += "\n";
    return chart;
}

bool has_honesty(const CourseResult& course) {
    return std::any_of(course.runs.begin(), course.runs.end(), [](const RunResult& run) { return has_ratios(run.g.all()); });
}

}  // namespace

std::string chart_head(size_t key_rows) {
    return fmt::format("key_rows = {}\n", key_rows) + kHead;
}

std::string gnuplot_text(const std::string& text) {
    return quoted(text);
}

std::string x_label(const std::string& text) {
    return "set xlabel \"" + text + "\\n \"\n";
}

int frames_column(std::string_view figure_name) {
    return std::stoi(column_of(figure_name));
}

std::string chart_colour(size_t place) {
    return kColours[place % kColours.size()];
}

std::vector<Chart> charts_of(const CourseResult& course) {
    std::vector<Chart> charts;
    if (has_pictures(course)) {
        charts.push_back(front(course, "front_ms", "Time of a frame against its error", "frame time, ms (median)", 7));
        charts.push_back(
            front(course, "front_triangles", "Triangles of a frame against its error", "triangles submitted (median)", 9));
    }
    charts.push_back(over_flight(course));
    if (!has_pictures(course)) return charts;
    charts.push_back(distribution(course));
    if (has_honesty(course)) charts.push_back(promise(course));
    return charts;
}

}  // namespace overlook::measure
