#include "tools/measure/paper/wang_ldi/page_figure_2.h"

#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr uint32_t kWideFrom_px = 700;  // wider pictures stand alone

}  // namespace

std::string figures_html(const std::vector<Picture>& pictures, int least, int most) {
    std::string html = "<div class=\"pictures\">\n", wide;
    for (const Picture& picture : pictures) {
        if (picture.figure < least || picture.figure > most) continue;
        std::string figure = picture_html(picture.name, fmt::format("Figure {}: {}", picture.figure, picture.caption),
                                          picture.image.width, picture.image.height);
        (picture.image.width > kWideFrom_px ? wide : html) += figure;
    }
    return html + "</div>\n" + wide;
}

std::string figure_2_html(const Figure2& figure) {
    if (figure.ways.empty()) return "";
    std::string html =
        "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>" +
        table_row({"", "away, m", "views", "E", "E p99", "E, unfilled", "holes, %", "filled, %", "beyond its rim, %",
                   "too near or far, %", "otherwise by depth, %", "samples warped", "ms, one thread", "samples, all", "bytes"},
                  "th") +
        "</thead>\n<tbody>\n";
    for (const Way& way : figure.ways)
        for (const SeenFrom& row : way.rows) {
            bool is_first = &row == &way.rows.front(), is_one = &way == &figure.ways.front();
            html += table_row({is_first ? way.name : "", short_number(row.away_m), std::to_string(row.views),
                               short_number(row.e_mean), short_number(row.e_p99), short_number(row.unfilled_e_mean),
                               short_number(100 * row.hole_share), short_number(100 * row.filled_share),
                               is_one ? short_number(100 * row.beyond_share) : "", short_number(100 * row.wrong_share),
                               short_number(100 * row.order_share), short_count(row.samples), short_number(row.warp_ms),
                               is_first ? short_count(double(way.samples)) : "", is_first ? short_bytes(double(way.bytes)) : ""},
                              "td", is_first ? " class=\"floor\"" : "");
        }
    return html + "</tbody></table></div>\n<p class=\"note\">" +
           fmt::format(
               "A ground of {} x {} tiles, {} x {} pixels, beside rays from the same eyes. The one LDI is a perspective "
               "one, made for eyes within {} m along each axis ({} % unseen as estimated, up to {} layers), drawn towards or "
               "away from the epipole without depths. It and the tiles as published stand for the same ground; a single "
               "tile and Overlook's tiles are held against rays of their own. E (LDR-FLIP): small holes filled, what no plant "
               "covers grey; holes, and too near or far by more than 5 %: of the pixels in which rays meet a plant. "
               "Otherwise by depth: pixels that show another sample where each pixel's depth decides in place of the order.",
               figure.tiles_a_side, figure.tiles_a_side, figure.width_px, figure.height_px, short_number(figure.cell_m),
               short_number(100 * figure.unseen_share), figure.most_layers) +
           " <a href=\"figure-2.csv\">figure-2.csv</a></p>\n" + figures_html(figure.pictures, 2, 2);
}

}  // namespace overlook::measure::paper::wang
