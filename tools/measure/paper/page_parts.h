// What the pages of all papers are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace overlook::measure::paper {

// A row of a table, the first cell its head. cells: HTML; tag: "td" or "th" of the others; attributes: of the row, " class=...".
std::string table_row(const std::vector<std::string>& cells, const char* tag, const std::string& attributes = "");

// What is to be said of the row above, all across the table; nothing of an empty text. text: HTML.
std::string said_row(const std::string& text, size_t columns);

// A chart of charts/ with what stands below it.
std::string chart_html(const std::string& name, const std::string& title, const std::string& sentence);

// A picture of images/ with what stands below it.
std::string picture_html(const std::string& name, const std::string& caption, uint32_t width_px, uint32_t height_px);

// The whole page. body: HTML. One file without scripts or anything from elsewhere.
std::string paper_page(const std::string& title, const std::string& body);

}  // namespace overlook::measure::paper
