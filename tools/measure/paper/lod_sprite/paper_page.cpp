#include "tools/measure/paper/lod_sprite/paper_page.h"

#include <algorithm>
#include <cstdlib>

#include "tools/measure/error_colours.h"
#include "tools/measure/figures.h"
#include "tools/measure/methods.h"
#include "tools/measure/page.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/lod_sprite/page_sections.h"
#include "tools/measure/paper/lod_sprite/targets.h"
#include "tools/measure/paper/page_parts.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::sprite {
namespace {

struct Difference {
    std::vector<float> map;  // [height, width], kDifferenceGain times
    double mean = 0;         // 0..1
};

Difference difference_of(const ImageRgb8& a, const ImageRgb8& b) {
    Difference difference;
    difference.map.resize(a.pixels.size() / 3);
    double sum = 0;
    for (size_t i = 0; i < difference.map.size(); ++i) {
        int greatest = 0;
        for (size_t channel = 0; channel < 3; ++channel)
            greatest = std::max(greatest, std::abs(int(a.pixels[3 * i + channel]) - int(b.pixels[3 * i + channel])));
        sum += greatest / 255.0;
        difference.map[i] = std::min(1.0f, float(kDifferenceGain * greatest) / 255);
    }
    difference.mean = sum / double(difference.map.size());
    return difference;
}

FigurePicture difference_picture(const std::string& name, const std::string& what, const ImageRgb8& a, const ImageRgb8& b) {
    Difference difference = difference_of(a, b);
    return {name, fmt::format("{}: mean {} of 255", what, short_number(255 * difference.mean)),
            error_picture(difference.map, a.width, a.height)};
}

std::string runs_html(const Flown& flown) {
    std::string html =
        "<h2>The runs</h2>\n<div class=\"wide\"><table class=\"runs numbers\">\n<thead><tr><th>run</th><th>mean ms</th><th>p50 "
        "ms</th>"
        "<th>p99 ms</th><th>slowest ms</th><th>triangles, mean</th><th>keyframes</th><th>E p99</th><th>W p99</th>"
        "<th>holes px</th></tr></thead>\n<tbody>\n";
    for (const RunResult& run : flown.beside.runs) {
        Percentiles times_ms = percentiles_of(run, "frame_ms");
        double triangles = 0;
        for (const FrameRecord& frame : run.frames)
            triangles += double(frame.counters.triangle_count) / double(run.frames.size());
        html += table_row(
            {with_labels_html(run.label), short_number(mean_ms(run)), short_number(times_ms.p50), short_number(times_ms.p99),
             short_number(times_ms.max), short_count(triangles), short_count(swept_from(run, nullptr, kThreshold_px).keyframes),
             short_number(percentiles_of(run, "e_p99_flip").p99), short_number(percentiles_of(run, "w_luma").p99),
             short_count(percentiles_of(run, "hole_px").max)},
            "td", is_floor(run.spec) ? " class=\"floor\"" : "");
    }
    return html +
           fmt::format(
               "</tbody></table></div>\n<p class=\"note\">The paper's, on an SGI Onyx 2: high {} ms, low {} ms, {} keyframes "
               "of {} ms, the frames between them {} ms, all of LOD-sprite {} ms in the mean. Grey: the floor. Every number "
               "beside the reference: <a href=\"measured.html\">measured.html</a>, <a href=\"runs.json\">runs.json</a>, <a "
               "href=\"frames.csv\">frames.csv</a>.</p>\n",
               Printed::kHighMean_ms, Printed::kLowMean_ms, Printed::kKeyframes, Printed::kKeyframeMean_ms,
               Printed::kNovelMean_ms, Printed::kMean_ms);
}

std::string views_html(const PaperPage& page) {
    std::string html = "<h2>Figures 6 and 7: two views</h2>\n";
    for (size_t i = 0; i < page.pictures.size(); ++i) {
        const ViewPictures& view = page.flown.views[i];
        html += fmt::format(
            "<section>\n<h3>Figure {}</h3>\n<p>Frame {:.0f} of the flight. The paper counts {} triangles in its high cut and {} "
            "in "
            "its low one; here they are {} and {}.</p>\n<div class=\"four\">\n",
            view.view.figure, view.view.time_s / page.flown.step_s, short_count(view.view.high_triangle_count),
            short_count(view.view.low_triangle_count), short_count(double(view.high.triangle_count)),
            short_count(double(view.low.triangle_count)));
        for (const FigurePicture& picture : page.pictures[i])
            html += picture_html(picture.name, picture.caption, picture.image.width, picture.image.height);
        html += "</div>\n</section>\n";
    }
    return html;
}

// The curve of figure 13 of one method.
std::vector<CurvePoint> threshold_curve(const Flown& flown, const std::string& family) {
    std::vector<CurvePoint> curve;
    for (const Swept& one : flown.thresholds) {
        if (one.family == family) curve.push_back({one.threshold_px, one.keyframe_share()});
    }
    std::sort(curve.begin(), curve.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
    return curve;
}

std::string keyframe_text(const Flown& flown) {
    std::string text;
    for (const RunResult* sprite : sprites_of(flown)) {
        Swept swept = swept_from(*sprite, nullptr, kThreshold_px);
        text += fmt::format(" {}: {} in {} frames.", family_of(sprite->spec), swept.keyframes, swept.frames);
    }
    return fmt::format("The paper makes {} keyframes in {} frames.", Printed::kKeyframes, Printed::kFrames) + text;
}

std::string knee_text(const Flown& flown) {
    std::string text = "The paper's curve flattens at about 1 px.";
    for (const RunResult* sprite : sprites_of(flown)) {
        std::string family = family_of(sprite->spec);
        std::optional<double> knee = knee_of(threshold_curve(flown, family));
        text +=
            knee ? fmt::format(" {} bends most at {} px.", family, short_number(*knee)) : fmt::format(" {} has no bend.", family);
    }
    return text;
}

std::string speed_up_text(const Flown& flown) {
    std::string text = "Mean time of a frame at the high cut over the method's, both of one run. The paper: 9.9 at 1 px.";
    for (const Swept& one : flown.thresholds) {
        if (one.threshold_px == kThreshold_px) text += fmt::format(" {}: {}.", one.family, short_number(one.speed_up()));
    }
    return text;
}

std::string times_text(const Flown& flown) {
    std::string text = fmt::format("High {} ms, low {} ms in the mean.", short_number(mean_ms(high_of(flown))),
                                   short_number(mean_ms(low_of(flown))));
    for (const RunResult* sprite : sprites_of(flown)) {
        double key_ms = 0, novel_ms = 0, keys = 0, novel = 0;
        for (const FrameRecord& frame : sprite->frames) {
            bool is_key = frame.counters.event_count > 0;
            (is_key ? key_ms : novel_ms) += frame.frame_ms();
            (is_key ? keys : novel) += 1;
        }
        text += fmt::format(" {}: frames that re-key {} ms, the others {} ms, all {} ms.", family_of(sprite->spec),
                            keys > 0 ? short_number(key_ms / keys) : "none,",
                            novel > 0 ? short_number(novel_ms / novel) : "none,", short_number(mean_ms(*sprite)));
    }
    return text;
}

std::string sentence_of(const std::string& chart, const Flown& flown) {
    if (chart == "figure-9") {
        return fmt::format("The high cut's median frame has {} triangles, {} times the low one's; the paper's about 100 times.",
                           short_count(percentiles_of(high_of(flown), "triangles").p50),
                           short_number(percentiles_of(high_of(flown), "triangles").p50 /
                                        std::max(1.0, percentiles_of(low_of(flown), "triangles").p50)));
    }
    if (chart == "figure-10")
        return "What each method holds against its threshold; a keyframe takes it back. " + keyframe_text(flown);
    if (chart == "figure-11") return times_text(flown);
    if (chart == "figure-12") return "The nearer the frames, the longer each keyframe serves.";
    if (chart == "figure-13") return knee_text(flown);
    if (chart == "figure-14") return speed_up_text(flown);
    return "Numbers: every hundredth frame. Dots: where the first method made a keyframe.";
}

std::string charts_html(const PaperPage& page) {
    std::string html = "<h2>Figures 8 to 14</h2>\n";
    if (!page.has_charts) return html + "<p class=\"note\">gnuplot was not installed; the scripts lie in charts/.</p>\n";
    for (const Chart& chart : page.charts) {
        html += chart_html(chart.name, chart.title, sentence_of(chart.name, page.flown));
    }
    return html;
}

std::string setup_html(const PaperPage& page) {
    const RunSetup& setup = page.setup;
    return fmt::format(
        "<p>512 x 512 heights and texels in the paper; {} of {} x {} pixels, one sample each, keyframes at {} px of error, cuts "
        "at {} and {} "
        "px.</p>\n<p class=\"note\">{}. Numbers beside the reference on every tenth frame and the "
        "one "
        "after it, and round keyframes. The floor is full geometry at one sample a pixel.</p>\n",
        fmt::format("here {} frames", page.flown.path.size()), setup.width_px, setup.height_px, kThreshold_px,
page.flown.plan.high_px, page.flown.plan.low_px, machine_html(setup));
}

}  // namespace

std::vector<FigurePicture> pictures_of(const ViewPictures& views) {
    std::string figure = fmt::format("figure-{}", views.view.figure);
    auto counted = [](const std::string& what, const ViewPicture& picture) {
        return fmt::format("{}: {} triangles", what, short_count(double(picture.triangle_count)));
    };
    std::vector<FigurePicture> pictures;
    pictures.push_back({figure + "a", counted("a. low cut", views.low), views.low.image});
    pictures.push_back({figure + "b", counted("b. high cut", views.high), views.high.image});
    auto place_of = [](size_t i) { return i == 0 ? std::string() : std::to_string(i + 1); };
    for (size_t i = 0; i < views.sprites.size(); ++i)
        pictures.push_back(
            {figure + "c" + place_of(i), counted("c. " + views.sprites[i].family, views.sprites[i]), views.sprites[i].image});
    pictures.push_back(difference_picture(figure + "d", "d. |low - high| x " + std::to_string(kDifferenceGain), views.low.image,
                                          views.high.image));
    for (size_t i = 0; i < views.sprites.size(); ++i) {
        pictures.push_back(difference_picture(figure + "e" + place_of(i),
                                              fmt::format("e. |{} - high| x {}", views.sprites[i].family, kDifferenceGain),
                                              views.sprites[i].image, views.high.image));
    }
    return pictures;
}

std::string paper_page_html(const PaperPage& page) {
    std::string targets = targets_html(targets_of(page.flown), sprite_names(page.flown),
                                       "Red: missed; the reason is the last method's, from this run's numbers.");
    return paper_page("LOD-sprite: section 4 of the paper, run anew",
                      setup_html(page) + targets + runs_html(page.flown) + remedies_html(page.flown.remedies) +
                          held_keys_html(page.flown.held, page.has_charts) + views_html(page) + charts_html(page));
}

}  // namespace overlook::measure::paper::sprite
