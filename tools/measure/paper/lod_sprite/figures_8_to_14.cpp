#include "tools/measure/paper/lod_sprite/figures_8_to_14.h"

#include <algorithm>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"

namespace overlook::measure::paper::sprite {
namespace {

constexpr uint32_t kMapPoints = 160;  // a side
constexpr char kGrey[] = "lc rgb \"#666666\"";

std::string of_run(const RunResult& run) {
    return fmt::format("(strcol(1) eq {} ? $2 : NaN)", gnuplot_text(run.label));
}

// A run's column of frames.csv over the frames.
std::string line_of(const RunResult& run, std::string_view figure_name, const std::string& colour, const std::string& title) {
    return fmt::format("'../frames.csv' skip 1 using {}:{} with lines lc rgb \"{}\" lw 1.6 title {}", of_run(run),
                       frames_column(figure_name), colour, gnuplot_text(title));
}

struct Line {
    const RunResult* run;
    std::string colour, title;
};
std::vector<Line> lines_of(const Flown& flown, bool only_sprites) {
    std::vector<Line> lines;
    if (!only_sprites) {
        lines.push_back({&high_of(flown), "#000000", fmt::format("high cut, {} px", flown.plan.high_px)});
        lines.push_back({&low_of(flown), "#888888", fmt::format("low cut, {} px", flown.plan.low_px)});
    }
    size_t place = 0;
    for (const RunResult* sprite : sprites_of(flown)) lines.push_back({sprite, chart_colour(place++), family_of(sprite->spec)});
    return lines;
}

std::string plot_of(const std::vector<Line>& lines, std::string_view figure_name) {
    std::string plot = "plot ";
    for (const Line& line : lines)
        plot += (plot.size() > 5 ? ", \\\n" : "") + line_of(*line.run, figure_name, line.colour, line.title);
    return plot;
}

// A level across the chart, named in the key.
std::string level(double value, const std::string& title) {
    return fmt::format(", \\\n{} with lines {} lw 1.5 dt 2 title {}", value, kGrey, gnuplot_text(title));
}
// One that the paper prints, named where it is.
std::string printed_level(double value, const std::string& title) {
    return fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead back {1} lw 1.5 dt 2\nset label {2} at graph 0.99, first "
        "{0} right offset 0,0.5 tc rgb \"#333333\" font ',12' noenhanced front boxed\n",
        value, kGrey, gnuplot_text(title));
}
std::string printed_point(double x, double y, const std::string& title) {
    return fmt::format(", \\\n'-' using 1:2 with points pt 2 ps 1.6 lw 2 lc rgb \"#9c2f00\" title {}\n{},{}\ne\n",
                       gnuplot_text(title), x, y);
}

Chart triangles(const Flown& flown) {
    Chart chart{"figure-9", "Figure 9: triangles drawn, frame by frame", chart_head(6)};
    chart.script += x_label("frame") + "set ylabel 'triangles'\nset logscale y\nset format y '%.0s%c'\n";
    chart.script += "$paper << EOD\n";
    for (const PlanView& view : flown.plan.views) {
        double frame = view.time_s / flown.step_s;
        chart.script += fmt::format("{},{}\n{},{}\n", frame, view.high_triangle_count, frame, view.low_triangle_count);
    }
    chart.script +=
        "EOD\n" + plot_of(lines_of(flown, false), "triangles") +
        ", \\\n$paper using 1:2 with points pt 2 ps 1.6 lw 2 lc rgb \"#9c2f00\" title 'paper: views of figures 6, 7'\n";
    return chart;
}

Chart error(const Flown& flown) {
    Chart chart{"figure-10", "Figure 10: the method's own error, frame by frame", chart_head(6)};
    chart.script += x_label("frame") + "set ylabel 'error, pixels'\nset yrange [0:*]\n";
    chart.script += plot_of(lines_of(flown, true), "predicted_error_px") + level(kThreshold_px, "threshold") + "\n";
    return chart;
}

Chart times(const Flown& flown) {
    Chart chart{"figure-11", "Figure 11: time of each frame", chart_head(4)};
    chart.script += x_label("frame") +
                    "set ylabel 'milliseconds'\nset logscale y\nset yrange [*<10:1000<*]\nset style textbox opaque noborder fc "
                    "rgb '#ffffff'\n" +
                    printed_level(Printed::kHighMean_ms, "paper: high, mean 526") +
                    printed_level(Printed::kKeyframeMean_ms, "paper: keyframes, mean 680") +
                    printed_level(Printed::kMean_ms, "paper: LOD-sprite, mean 53") +
                    printed_level(Printed::kLowMean_ms, "paper: low, mean 22") + plot_of(lines_of(flown, false), "frame_ms") +
                    "\n";
    return chart;
}

// Columns of the sweeps: 1 method, 2 threshold, 3 frames, 5 keyframe share, 8 speed-up.
std::string swept_plot(const Flown& flown, const char* table, const char* x, const char* y) {
    std::string plot = "plot ";
    size_t place = 0;
    for (const MethodSpec& sprite : flown.cast.sprites) {
        plot += fmt::format(
            "{}'../{}' skip 1 using (strcol(1) eq {} ? {} : NaN):{} with linespoints pt 7 ps 0.8 lw 2 lc rgb "
            "\"{}\" title {}",
            place == 0 ? "" : ", \\\n", table, gnuplot_text(family_of(sprite)), x, y, chart_colour(place),
            gnuplot_text(family_of(sprite)));
        ++place;
    }
    return plot;
}

Chart by_frame_count(const Flown& flown) {
    Chart chart{"figure-12", "Figure 12: share of keyframes against the number of frames on the same way", chart_head(6)};
    chart.script += x_label("frames on the way") + "set ylabel 'keyframes / frames'\nset logscale x\nset yrange [0:*]\n";
    std::string tics;
    for (const Swept& one : flown.frame_counts) {
        std::string tic = fmt::format("{}", one.frames);
        if ((", " + tics + ", ").find(", " + tic + ", ") == std::string::npos) tics += (tics.empty() ? "" : ", ") + tic;
    }
    chart.script += "set offsets graph 0.05, graph 0.05, 0, 0\nset xtics (" + tics + ")\nset mxtics 1\n";
    chart.script += swept_plot(flown, "frame_counts.csv", "$3", "5") +
                    printed_point(Printed::kFrames, double(Printed::kKeyframes) / Printed::kFrames, "paper: 16 of 600");
    return chart;
}

Chart by_threshold(const Flown& flown) {
    Chart chart{"figure-13", "Figure 13: share of keyframes against the threshold", chart_head(6)};
    chart.script += x_label("threshold, pixels") + "set ylabel 'keyframes / frames'\nset yrange [0:*]\nset xrange [0:*]\n";
    chart.script +=
        fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead {1} lw 1.5 dt 2\n", Printed::kKneeThreshold_px, kGrey);
    chart.script +=
        fmt::format("set label \"paper's knee\" at {}, graph 0.95 offset 0.6,0 tc rgb \"#666666\"\n", Printed::kKneeThreshold_px);
    chart.script += swept_plot(flown, "thresholds.csv", "$2", "5") +
                    printed_point(kThreshold_px, double(Printed::kKeyframes) / Printed::kFrames, "paper: 16 of 600 at 1 px");
    return chart;
}

Chart speed_up(const Flown& flown) {
    Chart chart{"figure-14", "Figure 14: speed-up of the mean frame against the threshold", chart_head(6)};
    chart.script +=
        x_label("threshold, pixels") + "set ylabel 'high cut / method, mean time'\nset yrange [0:*]\nset xrange [0:*]\n";
    chart.script +=
        swept_plot(flown, "thresholds.csv", "$2", "8") + printed_point(kThreshold_px, Printed::kSpeedUp, "paper: 9.9 at 1 px");
    return chart;
}

// Columns of path.csv: 1 frame, 2 east, 3 north, 4 height, 5 ground, 6 flown, 7 is_key, 8 is_over_terrain.
Chart map_from_above() {
    Chart chart{"figure-8-map", "Figure 8: the flight from above", chart_head(6)};
    chart.script += x_label("east, km") + "set ylabel 'north, km'\nset size ratio -1\nset colorbox\nset cblabel 'ground, m'\n";
    chart.script += "set palette defined (0 '#7c9a5e', 0.25 '#c9c58a', 0.6 '#8d7a68', 1 '#ffffff')\n";
    chart.script +=
        "plot '../map.csv' using 1:2:3 with image notitle, \\\n"
        "'../path.csv' skip 1 using 2:3 with lines lw 2.5 lc rgb \"#D55E00\" title 'flight', \\\n"
        "'' skip 1 using ($7 > 0 ? $2 : NaN):3 with points pt 7 ps 0.9 lc rgb \"#000000\" title 'keyframes', \\\n"
        "'' skip 1 using (int($1) % 100 == 0 ? $2 : NaN):3:1 with labels offset 2.2,0 notitle\n";
    return chart;
}

Chart profile() {
    Chart chart{"figure-8-profile", "Figure 8: the flight from the side", chart_head(6)};
    chart.script += x_label("way flown, km") + "set ylabel 'height, m'\nset yrange [0:*]\n";
    chart.script +=
        "plot '../path.csv' skip 1 using ($8 > 0 ? $6 : NaN):5 with filledcurves x1 lc rgb \"#a9b08a\" title 'ground below', \\\n"
        "'' skip 1 using 6:4 with lines lw 2.5 lc rgb \"#D55E00\" title 'flight', \\\n"
        "'' skip 1 using ($7 > 0 ? $6 : NaN):4 with points pt 7 ps 0.9 lc rgb \"#000000\" title 'keyframes', \\\n"
        "'' skip 1 using (int($1) % 100 == 0 ? $6 : NaN):4:1 with labels offset 0,1 notitle\n";
    return chart;
}

}  // namespace

std::vector<const RunResult*> sprites_of(const Flown& flown) {
    std::vector<const RunResult*> sprites;
    for (size_t i = 0; i < flown.cast.sprites.size(); ++i) sprites.push_back(&flown.beside.runs[2 + i]);
    return sprites;
}

std::vector<std::string> sprite_names(const Flown& flown) {
    std::vector<std::string> names;
    for (const RunResult* sprite : sprites_of(flown)) names.push_back(family_of(sprite->spec));
    return names;
}

std::string swept_csv(const std::vector<Swept>& swept) {
    std::string csv = "method,threshold_px,frames,keyframes,keyframe_share,mean_ms,high_mean_ms,speed_up\n";
    for (const Swept& one : swept) {
        csv += fmt::format("{},{},{},{},{},{}", one.family, one.threshold_px, one.frames, one.keyframes, one.keyframe_share(),
                           one.mean_ms);
        csv += one.high_mean_ms > 0 ? fmt::format(",{},{}\n", one.high_mean_ms, one.speed_up()) : ",,\n";
    }
    return csv;
}

std::string path_csv(const Flown& flown) {
    std::string csv = "frame,east_km,north_km,height_m,ground_m,flown_km,is_key,is_over_terrain\n";
    std::vector<const RunResult*> sprites = sprites_of(flown);
    for (size_t i = 0; i < flown.path.size(); ++i) {
        const PathPoint& point = flown.path[i];
        bool is_key = !sprites.empty() && sprites.front()->frames[i].counters.event_count > 0;
        csv += fmt::format("{},{},{},{},{},{},{},{}\n", i, point.east_m / 1000, point.north_m / 1000, point.height_m,
                           point.ground_m, point.flown_m / 1000, int(is_key), int(point.is_over_terrain));
    }
    return csv;
}

std::string map_csv(const World& world) {
    const terrain::Terrain& terrain = *world.terrain;
    uint32_t step = std::max(1u, (std::max(terrain.shape.width, terrain.shape.height) + kMapPoints - 1) / kMapPoints);
    std::string csv;
    for (uint32_t row = 0; row < terrain.shape.height; row += step) {
        for (uint32_t column = 0; column < terrain.shape.width; column += step) {
            if (terrain.is_void(column, row)) continue;
            csv += fmt::format("{},{},{}\n", column * terrain.frame.metres_per_column / 1000,
                               -(row * terrain.frame.metres_per_row) / 1000, terrain.height_m(column, row));
        }
    }
    return csv;
}

std::vector<Chart> charts_8_to_14(const Flown& flown) {
    std::vector<Chart> charts = {map_from_above(), profile(), triangles(flown), error(flown), times(flown)};
    if (!flown.frame_counts.empty()) charts.push_back(by_frame_count(flown));
    if (!flown.thresholds.empty()) charts.insert(charts.end(), {by_threshold(flown), speed_up(flown)});
    return charts;
}

std::optional<double> knee_of(const std::vector<CurvePoint>& points) {
    if (points.size() < 3) return std::nullopt;
    const CurvePoint &first = points.front(), &last = points.back();
    double width = last.x - first.x, fall = first.y - last.y, farthest = 0;
    if (!(width > 0) || !(fall > 0)) return std::nullopt;
    std::optional<double> knee;
    for (const CurvePoint& point : points) {
        double below = 1 - (point.x - first.x) / width - (point.y - last.y) / fall;
        if (below <= farthest) continue;
        farthest = below;
        knee = point.x;
    }
    return knee;
}

}  // namespace overlook::measure::paper::sprite
