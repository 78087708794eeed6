// "Figures to reach": what a paper reached, what is asked of Overlook, and what a run measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace overlook::measure::paper {

// One line of the table, with a column for each that was measured.
struct Target {
    std::string name;     // "speed-up of the mean frame"
    std::string printed;  // the paper's, or "-"
    double goal = 0;
    bool is_at_least = true;                      // goal: at least, or at most
    std::vector<std::optional<double>> measured;  // a column each; empty: this run cannot tell
    std::string note;
    std::string why;  // the last column misses it: from the numbers of the run; empty where it does not
    bool is_reached(size_t column) const {
        return measured[column] && (is_at_least ? *measured[column] >= goal : *measured[column] <= goal);
    }
};

// columns: what each column is called. note: HTML below the table.
std::string targets_html(const std::vector<Target>& targets, const std::vector<std::string>& columns, const std::string& note);

// "speed-up: paper 9.9, to reach >= 9.9; lod-sprite 12".
std::string target_line(const Target& target, const std::vector<std::string>& columns);

}  // namespace overlook::measure::paper
