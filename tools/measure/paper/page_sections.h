// Sections of the paper's page: what remedies buy; ghosts and losses against parallax.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/held_keys.h"
#include "tools/measure/paper/remedies.h"

namespace overlook::measure::paper {

// A row of a table, the first cell its head. cells: HTML; tag: "td" or "th" of the others; attributes: of the row, " class=...".
std::string table_row(const std::vector<std::string>& cells, const char* tag, const std::string& attributes = "");

// What is to be said of the row above, all across the table; nothing of an empty text. text: HTML.
std::string said_row(const std::string& text, size_t columns);

// A chart of charts/ with what stands below it.
std::string chart_html(const std::string& name, const std::string& title, const std::string& sentence);

// Empty where nothing was flown.
std::string remedies_html(const RemedyTable& table);
std::string held_keys_html(const std::vector<HeldRun>& runs, bool has_charts);

}  // namespace overlook::measure::paper
