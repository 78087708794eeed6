#include "tools/measure/paper/wang_ldi/flown.h"

namespace overlook::measure::paper::wang {
namespace {

std::string line_of(const std::string& plants, const char* bake, const char* zone, size_t place, bool is_dashed) {
    return fmt::format(
        "'../planting.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq '{}' && strcol(3) eq '{}' ? $4 : NaN):5 with "
        "linespoints "
        "lc rgb \"{}\" lw 2 dt {} pt 7 ps 0.6 title 'by distance from the nearest {}, {}'",
        gnuplot_text(plants), bake, zone, chart_colour(place), is_dashed ? 2 : 1, zone,
        std::string_view(bake) == "own" ? "Overlook" : "as published");
}

Chart density(const std::string& plants) {
    Chart chart{"density-" + plants, "Planting of " + plants + ": density over the mean, as published and Overlook's",
                chart_head(4)};
    chart.script += x_label("metres") +
                    "set datafile missing NaN\nset xrange [0:*]\nset yrange [0:*]\nset ylabel 'density over the mean'\nplot " +
                    line_of(plants, "paper", "corner", 1, true) + ", \\\n" + line_of(plants, "paper", "edge", 1, false) +
                    ", \\\n" + line_of(plants, "own", "corner", 0, true) + ", \\\n" + line_of(plants, "own", "edge", 0, false) +
                    "\n";
    return chart;
}

// One line a way of drawing the ground.
Chart away(const Plants& plants, const char* name, const std::string& title, const std::string& y_label, int column, int times) {
    Chart chart{name + ("-" + plants.name), title, chart_head(plants.figure_2.ways.size())};
    chart.script += x_label("metres from the place of the one LDI") +
                    "set datafile missing NaN\nset xrange [0:*]\nset yrange [0:*]\nset ylabel '" + y_label + "'\n";
    for (size_t w = 0; w < plants.figure_2.ways.size(); ++w)
        chart.script += fmt::format(
            "{}'../figure-2.csv' skip 1 using (strcol(1) eq {} && strcol(2) eq {} ? $3 : NaN):({}*${}) with linespoints lc rgb "
            "\"{}\" lw 2 pt 7 ps 0.6 title {}{}",
            w == 0 ? "plot " : "", gnuplot_text(plants.name), gnuplot_text(plants.figure_2.ways[w].name), times, column,
            chart_colour(w), gnuplot_text(plants.figure_2.ways[w].name), w + 1 < plants.figure_2.ways.size() ? ", \\\n" : "\n");
    return chart;
}

}  // namespace

std::vector<Chart> charts_of(const Flown& flown) {
    std::vector<Chart> charts;
    for (const Plants& plants : flown.plants) {
        charts.push_back(density(plants.name));
        if (plants.figure_2.ways.empty()) continue;
        charts.push_back(away(plants, "away-e", plants.name + " seen from away: E beside rays", "E (LDR-FLIP), mean", 5, 1));
        charts.push_back(
            away(plants, "away-holes", plants.name + " seen from away: holes", "% of the pixels that show a plant", 8, 100));
    }
    for (const Plants& plants : flown.plants)
        for (Chart& chart : charts_of_fields(plants)) charts.push_back(std::move(chart));
    return charts;
}

}  // namespace overlook::measure::paper::wang
