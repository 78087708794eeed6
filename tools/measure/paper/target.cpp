#include "tools/measure/paper/target.h"

#include <fmt/format.h>

#include "tools/measure/page.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"

namespace overlook::measure::paper {
namespace {

// What is to be said of a target, or nothing.
std::string said_of(const Target& target) {
    std::string text = escaped(target.note);
    if (!target.why.empty()) text += (text.empty() ? "" : ". ") + ("<strong>Missed:</strong> " + escaped(target.why));
    return text;
}

std::string measured_cell(const Target& target, size_t column) {
    if (!target.measured[column]) return "not measured";
    std::string number = short_number(*target.measured[column]);
    return target.is_reached(column) ? number : "<strong class=\"broken\">" + number + "</strong>";
}

}  // namespace

std::string targets_html(const std::vector<Target>& targets, const std::vector<std::string>& columns, const std::string& note) {
    std::vector<std::string> head = {"", "paper", "to reach"};
    for (const std::string& column : columns) head.push_back(escaped(column));
    std::string html = "<h2>Figures to reach</h2>\n<div class=\"wide\"><table class=\"runs numbers\">\n<thead>" +
                       table_row(head, "th") + "</thead>\n<tbody>\n";
    for (const Target& target : targets) {
        std::vector<std::string> cells = {escaped(target.name), escaped(target.printed),
                                          (target.is_at_least ? "&ge; " : "&le; ") + short_number(target.goal)};
        for (size_t i = 0; i < target.measured.size(); ++i) cells.push_back(measured_cell(target, i));
        html += table_row(cells, "td") + said_row(said_of(target), cells.size());
    }
    return html + "</tbody></table></div>\n<p class=\"note\">" + note + "</p>\n";
}

std::string target_line(const Target& target, const std::vector<std::string>& columns) {
    std::string line = fmt::format("{}: paper {}, to reach {} {}", target.name, target.printed,
                                   target.is_at_least ? ">=" : "<=", short_number(target.goal));
    for (size_t i = 0; i < columns.size(); ++i)
        line += fmt::format("; {} {}", columns[i], target.measured[i] ? short_number(*target.measured[i]) : "not measured");
    return line;
}

}  // namespace overlook::measure::paper
