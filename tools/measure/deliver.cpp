#include "tools/measure/deliver.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "formats/atomic_file.h"
#include "runtime/gl/png.h"
#include "tools/measure/charts.h"
#include "tools/measure/error_colours.h"
#include "tools/measure/figures.h"
#include "tools/measure/page.h"
#include "tools/measure/page_text.h"

namespace overlook::measure {
namespace {

Result<void> write_pictures(const RunResult& run, const WorstFrame& worst, bool is_e, const std::string& folder) {
    if (!worst.is_there) return {};
    const std::pair<Shown, ImageRgb8> pictures[] = {
        {Shown::test, worst.test},
        {Shown::reference, worst.reference},
        {Shown::error, error_picture(worst.map, worst.test.width, worst.test.height)}};
    for (const auto& [what, image] : pictures) {
        if (Result<void> written = write_png(folder + "/" + picture_path(run, worst, is_e, what), image); !written)
            return written;
    }
    return {};
}

Result<void> write_worst_frames(const CourseResult& course, const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder + "/images", problem);
    if (problem) return cannot_write("{}/images: cannot make the folder: {}", folder, problem.message());
    for (const RunResult& run : course.runs) {
        if (Result<void> written = write_pictures(run, run.worst_e, true, folder); !written) return written;
        if (Result<void> written = write_pictures(run, run.worst_w, false, folder); !written) return written;
    }
    return {};
}

void say_summary(const CourseResult& course, const RunSetup& setup, const std::string& folder, const command::Common& common) {
    for (const RunResult& run : course.runs) {
        Percentiles times_ms = percentiles_of(run, "frame_ms");
        std::string line = "measure: " + run.label;
        if (run.worst_e.is_there) {
            line += fmt::format(": E p99 {}, W p99 {}, pop index {}", short_number(percentiles_of(run, "e_p99_flip").p99),
                                short_number(percentiles_of(run, "w_luma").p99), short_number(run.pop.index));
        }
        line += fmt::format(", {} ms p99 ({} p50), {} triangles", short_number(times_ms.p99), short_number(times_ms.p50),
                            short_count(percentiles_of(run, "triangles").p50));
        command::note(common, line);
    }
    const TimeSpent& spent = course.spent;
    if (spent.numbers_ms > 0) {
        command::note(
            common,
            fmt::format("measure: {:.0f} s for references, {:.0f} s for methods, {:.0f} s for G, {:.0f} s for the other "
                        "numbers",
                        spent.references_ms / 1000, spent.methods_ms / 1000, spent.promises_ms / 1000, spent.numbers_ms / 1000));
    }
    command::note(common, fmt::format("measure: by {}{}; the page: {}/index.html", setup.renderer.name,
                                      setup.renderer.is_software ? " (software)" : "", folder));
}

}  // namespace

Result<void> deliver(const CourseResult& course, const RunSetup& setup, const std::string& folder,
                     const command::Common& common) {
    std::string json = runs_json(course, setup);
    const std::pair<const char*, std::string> tables[] = {{"frames.csv", frames_csv(course, setup.step_s)},
                                                          {"runs.csv", runs_csv(course)},
                                                          {"honesty.csv", honesty_csv(course)},
                                                          {"runs.json", json}};
    for (const auto& [name, text] : tables) {
        if (Result<void> written = write_file(folder + "/" + name, std::string_view(text)); !written) return written;
    }
    if (Result<void> written = write_worst_frames(course, folder); !written) return written;
    std::vector<Chart> charts = charts_of(course);
    Result<bool> drawn = draw_charts(charts, folder);
    if (!drawn) return tl::unexpected(drawn.error());
    if (!*drawn) command::note(common, "measure: gnuplot is not installed; the charts are left out");
    std::string page = page_html({course, setup, charts, *drawn});
    if (Result<void> written = write_file(folder + "/index.html", std::string_view(page)); !written) return written;
    if (common.json) std::fputs(json.c_str(), stdout);
    say_summary(course, setup, folder, common);
    return {};
}

}  // namespace overlook::measure
