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

Chart breaking(const std::string& plants) {
    Chart chart{"one-ldi-" + plants, "One LDI of " + plants + ", seen from aside", chart_head(2)};
    chart.script +=
        x_label("metres aside of its middle") +
        "set datafile missing NaN\nset xrange [0:*]\nset yrange [0:*]\nset ylabel '% of the pixels that show a plant'\n";
    for (int column : {3, 4})
        chart.script += fmt::format(
            "{}'../one-ldi.csv' skip 1 using (strcol(1) eq {} ? $2 : NaN):(100*${}) with linespoints lc rgb \"{}\" lw 2 pt 7 ps "
            "0.6 "
            "title '{}'{}",
            column == 3 ? "plot " : "", gnuplot_text(plants), column, chart_colour(size_t(column - 3)),
            column == 3 ? "nothing is there" : "something too near or too far", column == 3 ? ", \\\n" : "\n");
    return chart;
}

}  // namespace

std::vector<Chart> charts_of(const Flown& flown) {
    std::vector<Chart> charts;
    for (const Plants& plants : flown.plants) charts.push_back(density(plants.name)), charts.push_back(breaking(plants.name));
    for (const Plants& plants : flown.plants)
        for (Chart& chart : charts_of_fields(plants)) charts.push_back(std::move(chart));
    return charts;
}

}  // namespace overlook::measure::paper::wang
