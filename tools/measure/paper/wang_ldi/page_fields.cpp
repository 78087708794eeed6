#include "tools/measure/paper/wang_ldi/page_fields.h"

#include "tools/measure/page_text.h"
#include "tools/measure/paper/page_parts.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr char kTable[] = "<div class=\"wide\"><table class=\"runs numbers\">\n<thead>";
constexpr char kTableEnd[] = "</tbody></table></div>\n";

std::string number(const std::optional<double>& value) {
    return value ? short_number(*value) : "";
}

std::string table_of(const FlownLand& land, const char* set, const std::vector<std::string>& head,
                     const std::function<std::vector<std::string>(const FieldRow&)>& cells) {
    std::string html = kTable + table_row(head, "th") + "</thead>\n<tbody>\n";
    for (const FieldRow& row : land.rows)
        if (row.set == set) html += table_row(cells(row), "td", row.family == "Overlook" ? "" : " class=\"floor\"");
    return html + kTableEnd;
}

std::string flights_html(const FlownLand& land) {
    return table_of(land, "flight",
                    {"", "drawn", "ms, median", "99 %", "frames a second", "samples", "million samples a second", "tiles",
                     "outside the cell, % of frames"},
                    [](const FieldRow& row) {
                        return std::vector<std::string>{row.what,
                                                        row.family,
                                                        short_number(row.ms_p50),
                                                        short_number(row.ms_p99),
                                                        short_number(1000 / std::max(1e-3, row.ms_p50)),
                                                        short_count(row.samples),
                                                        short_number(row.samples / 1000 / std::max(1e-3, row.ms_p50)),
                                                        short_count(row.tiles),
                                                        short_number(100 * row.outside_share)};
                    }) +
           fmt::format(
               "<p class=\"note\">{} x {} pixels, one sample a pixel, the terrain in it: about {} plants and {} million "
               "triangles of their "
               "finest levels in view at the beginning. Of an eye higher or lower than images were sampled for it says so, "
               "and draws the images there are.</p>\n",
               land.width_px, land.height_px, short_count(land.plants_in_view), short_number(land.millions_in_view));
}

std::string errors_html(const FlownLand& land) {
    return table_of(land, "error",
                    {"", "pixels asked", "ms, median", "samples", "triangles", "E, 99 %", "E, mean", "W", "pop index"},
                    [](const FieldRow& row) {
                        return std::vector<std::string>{row.family == "Overlook" ? "images, near tiles geometry" : "geometry",
                                                        short_number(row.x),
                                                        short_number(row.ms_p50),
                                                        short_count(row.samples),
                                                        short_count(row.triangles),
                                                        number(row.e_p99),
                                                        number(row.e_mean),
                                                        number(row.w),
                                                        number(row.pop)};
                    });
}

std::string race_html(const FlownLand& land) {
    return table_of(land, "race",
                    {"drawn", "", "pixels asked", "ms, median", "samples", "triangles", "times as fast as it is Overlook"},
                    [](const FieldRow& row) {
                        return std::vector<std::string>{row.family,
                                                        row.what,
                                                        short_number(row.x),
                                                        short_number(row.ms_p50),
                                                        short_count(row.samples),
                                                        short_count(row.triangles),
                                                        number(row.own_times_as_fast)};
                    }) +
           fmt::format(
               "<p class=\"note\">The walk, {} x {} pixels, each frame drawn in turn: as Overlook does by itself, and with "
               "geometry "
               "in place of all images, plants at discrete levels of the same error up to where textures begin, the same far "
               "points "
               "beyond.</p>\n",
               land.width_px, land.height_px);
}

std::string remedies_html(const FlownLand& land) {
    auto gaps = [](const std::optional<Gaps>& of) { return of ? short_number(100 * of->share()) : std::string(); };
    return table_of(land, "remedy",
                    {"", "without", "ms, median", "samples", "E, 99 %", "E, mean", "W", "pop index", "holes in the cell, %",
                     "widest, px", "largest, pixels", "holes anywhere, %"},
                    [&](const FieldRow& row) {
                        return std::vector<std::string>{row.family,
                                                        row.what.empty() ? "-" : row.what,
                                                        short_number(row.ms_p50),
                                                        short_count(row.samples),
                                                        number(row.e_p99),
                                                        number(row.e_mean),
                                                        number(row.w),
                                                        number(row.pop),
                                                        gaps(row.in_cell),
                                                        row.in_cell ? std::to_string(row.in_cell->widest_px) : "",
                                                        row.in_cell ? std::to_string(row.in_cell->largest_px) : "",
                                                        gaps(row.anywhere)};
                    }) +
           "<p class=\"note\">Each remedy switched off alone. Holes: of the pixels that plants cover, and all round, those that "
           "show "
           "magenta ground or the sky; widest: side of the largest square of them. In the cell: of plants as near and as far as "
           "images "
           "were sampled for.</p>\n";
}

std::string streamed_html(const StreamedWalk& walk) {
    if (!walk.refused.empty()) return "<p class=\"note\">With a quarter of the memory: " + escaped(walk.refused) + ".</p>\n";
    return fmt::format(
        "<p class=\"note\">Driven through with a quarter of the memory that all images take ({} of {}): over {} frames at most "
        "{} there or on "
        "their way, at most {} taken over in one frame ({} allowed), {} in all, {} images dropped; of {} images shown {} were "
        "late, "
        "another in their place, in {} frames, {} were missing.</p>\n",
        short_bytes(double(walk.budget_bytes)), short_bytes(double(walk.all_bytes)), walk.frames,
        short_bytes(double(walk.most_resident_bytes)), short_bytes(double(walk.most_uploaded_bytes)),
        short_bytes(double(walk.upload_budget_bytes)), short_bytes(double(walk.uploaded_bytes)),
        short_count(double(walk.dropped)), short_count(double(walk.shown)), short_count(double(walk.late)), walk.late_frames,
        short_count(double(walk.missing)));
}

std::string pictures_html(const FlownLand& land, bool is_magenta) {
    std::string html = "<div class=\"pictures\">\n";
    for (const Picture& picture : land.pictures)
        if ((picture.figure == 0) == is_magenta)
            html +=
                picture_html(picture.name,
                             picture.figure > 0 ? fmt::format("Figure {}: {}", picture.figure, picture.caption) : picture.caption,
                             picture.image.width, picture.image.height);
    return html + "</div>\n";
}

}  // namespace

std::string fields_html(const WangPage& page, const Plants& plants) {
    std::string html;
    for (const FlownLand& land : plants.lands) {
        std::string where = escaped(plants.name) + (land.name == "valley" ? " in a valley" : " over gentle hills");
        html += "<h2>Section 6: " + where + "</h2>\n" + pictures_html(land, false) + flights_html(land) + errors_html(land) +
                race_html(land);
        for (const char* name : {"race", "time", "error", "radius"})
            for (const Chart& chart : page.charts)
                if (page.has_charts && chart.name == fmt::format("{}-{}-{}", name, land.name, plants.name))
                    html += chart_html(chart.name, chart.title, "");
        html += "<h3>What each remedy buys, and holes over magenta</h3>\n" + remedies_html(land) + pictures_html(land, true) +
                streamed_html(land.streamed) + "<p class=\"note\"><a href=\"fields.csv\">fields.csv</a></p>\n";
    }
    return html;
}

std::string directions_html(const Plants& plants) {
    if (!plants.directions) return "";
    std::string html = kTable +
                       table_row({"", "bytes", "tiles", "samples", "of them warped", "ms, one thread", "pixels that show a plant",
                                  "nothing where eight show something, %", "too near or too far, %"},
                                 "th") +
                       "</thead>\n<tbody>\n";
    auto add = [&](const char* title, const DirectionsRow& row, bool is_beside) {
        html += table_row({title, short_bytes(double(row.bytes)), short_count(double(row.tiles)),
                           short_count(double(row.samples)), short_count(double(row.kept)), short_number(row.warp_ms),
                           short_count(double(row.shown_px)), is_beside ? short_number(100 * row.beside_eight.hole_share) : "",
                           is_beside ? short_number(100 * row.beside_eight.wrong_share) : ""},
                          "td");
    };
    add("an image for each of several directions", plants.directions->eight, false);
    add("one image for all", plants.directions->one, true);
    add("one, what faces away skipped", plants.directions->one_facing, true);
    return html + kTableEnd +
           "<p class=\"note\">The same levels, without light and with normals, by the exact warper; the time is of warping what "
           "is "
           "kept, not of finding it.</p>\n";
}

}  // namespace overlook::measure::paper::wang
