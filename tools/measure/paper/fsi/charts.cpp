// Figures 2 and 8, by gnuplot from the tables.
#include "runtime/discrete/transition.h"
#include "tools/measure/paper/fsi/flown.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr int kRampSteps = 40;

Chart ramps() {
    Chart chart{"figure-2", "Figure 2: how much of each level is visible on the way from one to the other", chart_head(2)};
    chart.script += x_label("phase of the transition") + "set xrange [0:1]\nset yrange [0:1.1]\nset ylabel 'visible share'\n";
    chart.script += fmt::format(
        "plot '../ramps.csv' skip 1 using 1:2 with lines lw 3 lc rgb \"{}\" title 'the level that comes', \\\n"
        "'../ramps.csv' skip 1 using 1:3 with lines lw 3 dt 2 lc rgb \"{}\" title 'the level that goes'\n",
        chart_colour(0), chart_colour(1));
    return chart;
}

std::string line_of(const std::string& scene, const std::string& chain, std::string_view method, size_t place, bool is_dashed) {
    std::string title = std::string(method) + (chain.empty() || chain == kHeavy ? "" : ", levels " + chain);
    return fmt::format(
        "'../sizes.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq {} && strcol(3) eq {} ? $4 : NaN):6 with linespoints lc "
        "rgb "
        "\"{}\" lw 2 dt {} pt 7 ps 0.6 title {}",
        gnuplot_text(scene), gnuplot_text(chain), gnuplot_text(std::string(method)), chart_colour(place), is_dashed ? 2 : 1,
        gnuplot_text(title));
}

// chains: by their names; the first one's lines are whole, others dashed.
Chart times(const Flown& flown, const std::string& scene, const std::string& end, const std::vector<std::string>& chains) {
    Chart chart{
        "figure-8-" + scene + (end.empty() ? "" : "-" + end),
        "Figure 8, " + title_of(scene) + (end.empty() ? "" : ", " + chains[0]) + ": frame time against the viewport's side",
        chart_head(8)};
    chart.script += x_label("pixels a side") +
                    "set datafile missing NaN\nset xrange [0:*]\nset yrange [0:*]\nset ylabel 'ms a frame, median'\nplot ";
    std::string lines;
    for (const std::string& chain : chains)
        for (size_t i = 0; i < kWays.size(); ++i) {
            if (find(flown.points, scene, chain, kWays[i].name, kSides_px[0]) == nullptr) continue;
            lines += (lines.empty() ? "" : ", \\\n") + line_of(scene, chain, kWays[i].name, i, chain != chains[0]);
        }
    chart.script += lines + "\n";
    return chart;
}

}  // namespace

std::vector<Chart> charts_of(const Flown& flown) {
    std::vector<Chart> charts = {ramps()};
    for (const std::string& scene : flown.scenes) {
        charts.push_back(times(flown, scene, "", {"", "by hand"}));
        if (find(flown.points, scene, kHeavy, kWays[kSwitch].name, kSides_px[0]))
            charts.push_back(times(flown, scene, "heavy", {kHeavy}));
    }
    return charts;
}

std::string ramps_csv() {
    std::string csv = "phase,new_share,old_share\n";
    for (int i = 0; i <= kRampSteps; ++i) {
        double phase = double(i) / kRampSteps;
        csv += fmt::format("{},{},{}\n", phase, discrete::visible_share_of_new(phase), discrete::visible_share_of_old(phase));
    }
    return csv;
}

}  // namespace overlook::measure::paper::fsi
