#include "tools/measure/page.h"

#include "tools/measure/figures.h"
#include "tools/measure/judge.h"
#include "tools/measure/methods.h"
#include "tools/measure/numbers/flip.h"
#include "tools/measure/page_style.h"
#include "tools/measure/page_text.h"

namespace overlook::measure {
namespace {

std::string row(const std::string& name, const std::string& value) {
    return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>\n";
}

// On how many frames G was taken of the runs that have any.
size_t honesty_frames(const CourseResult& course) {
    size_t most = 0;
    for (const RunResult& run : course.runs) most = std::max(most, values_of(run, figure("g_max")).size());
    return most;
}

std::string what_was_run(const PageInput& input) {
    const RunSetup& setup = input.setup;
    size_t frames = input.course.runs.front().frames.size();
    std::string software = setup.renderer.is_software ? " <strong class=\"software\">software OpenGL</strong>" : "";
    std::string html = "<h2>What was run</h2>\n<pre>" + command_html(setup.command) + "</pre>\n<table class=\"facts\">\n";
    html += row("Renderer", escaped(setup.renderer.name) + software);
    html += row("Machine", escaped(setup.processor) + fmt::format(", {} threads", setup.processor_threads));
    html += row("Scene", escaped(setup.scene) + " <code>" + setup.scene_hash.substr(0, 12) + "</code>");
    html += row("Flight", escaped(setup.flight) + " <code>" + setup.flight_hash.substr(0, 12) + "</code>");
    html += row("Frames", setup.is_wall_clock ? std::string("as many as the wall clock left time for")
                                              : fmt::format("{} of {} x {} pixels, {} s apart on the logical clock", frames,
                                                            setup.width_px, setup.height_px, short_number(setup.step_s)));
    if (input.course.runs.front().worst_e.is_there) {
        html += row("Reference", fmt::format("full geometry, {0} x {0} supersampled, averaged in linear light", kSupersampling));
        html += row("E", fmt::format("LDR-FLIP, {} pixels per degree, on {} of the frames", kPixelsPerDegree,
                                     values_of(input.course.runs.front(), figure("e_p99_flip")).size()));
    }
    if (size_t judged = honesty_frames(input.course); judged > 0) {
        html += row("G", fmt::format("every triangle drawn, at every source sample that it covers, on {} of the frames", judged));
    }
    html += row("Overlook", escaped(setup.version)) + "</table>\n";
    if (setup.renderer.is_software) {
        html +=
            "<p class=\"note\">Drawn by the processor: the times say nothing about a graphics card. Judge by the counters.</p>\n";
    }
    return html;
}

// The table leads with what a viewer feels: 99th percentiles, steadiness, long frames.
std::string cells_of(const RunResult& run) {
    auto cell = [](const std::string& text) { return "<td>" + text + "</td>"; };
    Percentiles times_ms = percentiles_of(run, "frame_ms");
    std::string html;
    if (run.worst_e.is_there) {
        html += cell(short_number(percentiles_of(run, "e_p99_flip").p99)) +
                cell(short_number(percentiles_of(run, "w_luma").p99)) + cell(short_number(run.pop.index)) +
                cell(short_number(times_ms.p99)) + cell(short_number(times_ms.p50)) +
                cell(short_count(percentiles_of(run, "hole_px").max)) + cell(short_number(percentiles_of(run, "s_max_px").max));
    } else {
        html += cell(short_number(times_ms.p99)) + cell(short_number(times_ms.p50));
    }
    html += cell(short_count(percentiles_of(run, "triangles").p50)) +
            cell(short_bytes(percentiles_of(run, "resident_bytes").max)) +
            cell(short_number(percentiles_of(run, "predicted_error_px").max));
    if (!run.worst_e.is_there) return html;
    const Honesty& g = run.g.all();
    if (g.count == 0) return html + cell("") + cell("");
    return html + cell(short_number(g.measured_max_px)) + cell(short_number(g.ratio_max) + "; " + short_number(g.ratio_median));
}

std::string gates_text(const RunResult& run) {
    std::string text;
    for (const Gate& gate : gates_of(run)) {
        if (gate.is_kept()) continue;
        text += (text.empty() ? "" : "; ") + fmt::format("{} {} {} {}", gate.name, short_number(gate.value),
                                                         gate.is_least ? "&lt;" : "&gt;", short_number(gate.limit));
    }
    if (gates_of(run).empty()) return "not judged";
    return text.empty() ? "kept" : "<strong class=\"broken\">" + text + "</strong>";
}

std::string table_of_runs(const PageInput& input) {
    bool has_pictures = input.course.runs.front().worst_e.is_there;
    std::string html = "<h2>Runs</h2>\n<div class=\"wide\"><table class=\"runs\">\n<thead><tr><th>run</th>";
    if (has_pictures) html += "<th>E p99</th><th>W p99</th><th>pop index</th>";
    html += "<th>ms p99</th><th>ms p50</th>";
    if (has_pictures) html += "<th>holes px</th><th>outline px, max</th>";
    html += "<th>triangles p50</th><th>held</th><th>promised px</th>";
    if (has_pictures) html += "<th>measured px</th><th>G max; median</th>";
    html += "<th>gates</th></tr></thead>\n<tbody>\n";
    for (const RunResult& run : input.course.runs) {
        html += fmt::format("<tr{}><th scope=\"row\">{}</th>{}<td>{}</td></tr>\n", is_floor(run.spec) ? " class=\"floor\"" : "",
                            with_labels_html(run.label), cells_of(run), gates_text(run));
    }
    html +=
        "</tbody></table></div>\n<p class=\"note\">p99 and p50 are percentiles over the frames; E is itself the 99th percentile "
        "over a "
        "frame's pixels. Grey: the floor, full geometry at the same samples a pixel. Everything else is in <a "
        "href=\"runs.json\">runs.json</a>, frame by frame in <a href=\"frames.csv\">frames.csv</a>.</p>\n";
    return html;
}

std::string charts_html(const PageInput& input) {
    std::string html = "<h2>Charts</h2>\n";
    if (!input.has_charts) {
        return html + "<p class=\"note\">gnuplot was not installed, so no chart was drawn; the scripts lie in charts/.</p>\n";
    }
    for (const Chart& chart : input.charts) {
        html += fmt::format(
            "<figure>\n<h3>{1}</h3>\n<picture><source media=\"(max-width: 640px)\" srcset=\"charts/{0}-narrow.svg\"><img "
            "src=\"charts/{0}.svg\" alt=\"{1}\" width=\"900\" height=\"540\"></picture>\n<figcaption>{2} <a "
            "href=\"charts/{0}.png\">PNG</a></figcaption>\n</figure>\n",
            chart.name, escaped(chart.title), with_labels_html(chart_sentence(chart.name, input.course)));
    }
    return html;
}

std::string worst_html(const RunResult& run, const RunResult& floor, bool is_e) {
    const WorstFrame& worst = is_e ? run.worst_e : run.worst_w;
    if (!worst.is_there) return "";
    auto image = [&](Shown what, const char* caption) {
        return fmt::format(
            "<figure><img loading=\"lazy\" src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\"><figcaption>{}</figcaption></figure>",
            picture_path(run, worst, is_e, what), caption, worst.test.width, worst.test.height, caption);
    };
    std::string w_caption = fmt::format("W by tiles, black 0 to pale yellow {}", kMostShownW);
    return fmt::format("<p><strong>{}</strong> {}</p>\n<div class=\"three\">{}{}{}</div>\n",
                       is_e ? "Least accurate." : "Least steady.", escaped(worst_sentence(run, floor, is_e)),
                       image(Shown::test, "the method"), image(Shown::reference, "the reference"),
                       image(Shown::error, is_e ? "E, black 0 to pale yellow 1" : w_caption.c_str()));
}

std::string worst_frames(const PageInput& input) {
    if (!input.course.runs.front().worst_e.is_there) return "";
    std::string html = "<h2>Worst frames</h2>\n";
    for (const RunResult& run : input.course.runs) {
        const RunResult& floor = input.course.runs[run.floor];
        html += "<section>\n<h3>" + with_labels_html(run.label) + "</h3>\n" + worst_html(run, floor, true) +
                worst_html(run, floor, false) + "</section>\n";
    }
    return html;
}

std::string file_name_of(std::string label) {
    for (char& c : label) {
        bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
        if (!is_plain) c = '_';
    }
    return label;
}

}  // namespace

std::string picture_path(const RunResult& run, const WorstFrame& worst, bool is_e, Shown what) {
    if (what == Shown::reference) return fmt::format("images/reference-{:05}.png", worst.frame);
    std::string name = fmt::format("images/{}-{:05}", file_name_of(run.label), worst.frame);
    if (what == Shown::test) return name + ".png";
    return name + (is_e ? "-e.png" : "-w.png");
}

std::string page_html(const PageInput& input) {
    std::string title = "Overlook: " + escaped(input.setup.scene) + " measured";
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, "
           "initial-scale=1\">\n<title>" +
           title + "</title>\n<style>\n" + kPageStyle + "</style>\n</head>\n<body>\n<main>\n<h1>" + title + "</h1>\n" +
           what_was_run(input) + table_of_runs(input) + charts_html(input) + worst_frames(input) + "</main>\n</body>\n</html>\n";
}

}  // namespace overlook::measure
