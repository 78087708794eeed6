#include "tools/measure/paper/page_parts.h"

#include <fmt/format.h>

#include "tools/measure/page_style.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper {
namespace {

constexpr char kPaperStyle[] = R"(.numbers td:last-child { text-align: right; min-width: 0; white-space: nowrap; }
.numbers .said td { text-align: left; white-space: normal; padding: 0 9px 10px; color: #4a545c; }
.numbers tr:has(+ .said) > * { border-bottom: none; }
.runs thead th:first-child:empty { min-width: 9em; }
.four { display: grid; grid-template-columns: repeat(4, 1fr); gap: 10px; }
.four figure { margin: 0 0 0.6em; }
.pictures { display: grid; grid-template-columns: repeat(2, 1fr); gap: 10px; }
@media (max-width: 640px) { .four { grid-template-columns: 1fr 1fr; } .pictures { grid-template-columns: 1fr; } }
)";

}  // namespace

std::string table_row(const std::vector<std::string>& cells, const char* tag, const std::string& attributes) {
    std::string html = "<tr" + attributes + ">";
    for (size_t i = 0; i < cells.size(); ++i)
        html += i == 0 ? "<th scope=\"row\">" + cells[i] + "</th>" : fmt::format("<{0}>{1}</{0}>", tag, cells[i]);
    return html + "</tr>\n";
}

std::string said_row(const std::string& text, size_t columns) {
    return text.empty() ? "" : fmt::format("<tr class=\"said\"><td colspan=\"{}\">{}</td></tr>\n", columns, text);
}

std::string chart_html(const std::string& name, const std::string& title, const std::string& sentence) {
    return fmt::format(
        "<figure>\n<h3>{1}</h3>\n<picture><source media=\"(max-width: 640px)\" srcset=\"charts/{0}-narrow.svg\"><img "
        "src=\"charts/{0}.svg\" alt=\"{1}\" width=\"900\" height=\"540\"></picture>\n<figcaption>{2} <a "
        "href=\"charts/{0}.png\">PNG</a></figcaption>\n</figure>\n",
        name, escaped(title), escaped(sentence));
}

std::string picture_html(const std::string& name, const std::string& caption, uint32_t width_px, uint32_t height_px) {
    return fmt::format(
        "<figure><img loading=\"lazy\" src=\"images/{0}.png\" alt=\"{1}\" width=\"{2}\" height=\"{3}\"><figcaption>{1}"
        "</figcaption></figure>\n",
        name, escaped(caption), width_px, height_px);
}

std::string paper_page(const std::string& title, const std::string& body) {
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n<title>" +
           title + "</title>\n<style>\n" + kPageStyle + kPaperStyle + "</style>\n</head>\n<body>\n<main>\n<h1>" + title +
           "</h1>\n" + body + "</main>\n</body>\n</html>\n";
}

}  // namespace overlook::measure::paper
