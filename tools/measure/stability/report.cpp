#include "tools/measure/stability/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "runtime/gl/png.h"
#include "tools/measure/page.h"
#include "tools/measure/page_style.h"
#include "tools/measure/page_text.h"

namespace overlook::measure {
namespace {

using Json = nlohmann::ordered_json;

// "images/s01-terrain-hard-error-px-1-samples-4-test.png".
std::string image_path(const Verdict& verdict, const char* what) {
    std::string name = verdict.number + "-" + label_of(verdict.spec) + "-" + what;
    for (char& c : name) {
        if (c == ':' || c == '@' || c == '=' || c == '.') c = '-';
        if (c == 'S') c = 's';
    }
    return "images/" + name + ".png";
}

Json json_of(const Verdict& verdict) {
    Json gates = Json::array();
    for (const HeldGate& gate : verdict.gates) {
        // What has no bound (a promise of nothing that is broken) has no number in JSON.
        Json value = gate.value && std::isfinite(*gate.value) ? Json(*gate.value) : Json(nullptr);
        gates.push_back({{"figure", gate.figure},
                         {"measured", gate.value.has_value()},
                         {"value", value},
                         {"most", gate.limit},
                         {"kept", gate.is_kept()}});
    }
    Json made = {{"case", verdict.number},
                 {"what", verdict.what},
                 {"run", label_of(verdict.spec)},
                 {"outcome", verdict.outcome()},
                 {"kept", verdict.is_kept()},
                 {"frames", verdict.finding.frames},
                 {"gates", gates},
                 {"sentence", verdict.finding.sentence}};
    if (verdict.finding.worst) {
        made["worst"] = {{"frame", verdict.finding.worst->frame},
                         {"picture", image_path(verdict, "test")},
                         {"reference", image_path(verdict, "reference")}};
    }
    return made;
}

std::string gates_html(const Verdict& verdict) {
    std::string html;
    std::vector<std::string> numbers = verdict.numbers();
    for (size_t i = 0; i < numbers.size(); ++i) {
        bool is_kept = i >= verdict.gates.size() || verdict.gates[i].is_kept();
        html += html.empty() ? "" : "<br>";
        html += is_kept ? numbers[i] : "<span class=\"broken\">" + numbers[i] + "</span>";
    }
    return html;
}

std::string outcome_html(const Verdict& verdict, const char* element) {
    if (verdict.is_kept()) return std::string(verdict.outcome());
    return fmt::format("<{0} class=\"broken\">{1}</{0}>", element, verdict.outcome());
}

std::string matrix_html(const SuiteResult& result) {
    std::string html =
        "<h2>Matrix</h2>\n<div class=\"wide\"><table class=\"runs matrix\">\n<thead><tr><th>case</th><th>method</th><th>numbers "
        "and "
        "gates</th><th>frames</th><th>verdict</th></tr></thead>\n<tbody>\n";
    for (const Verdict& verdict : result.verdicts) {
        html += fmt::format(
            "<tr><th scope=\"row\"><a href=\"#{0}\">{0}</a> {1}</th><td>{2}</td><td>{3}</td><td>{4}</td><td>{5}</td></tr>\n",
            verdict.number, escaped(verdict.what), escaped(family_of(verdict.spec)), gates_html(verdict), verdict.finding.frames,
            outcome_html(verdict, "strong"));
    }
    return html + "</tbody></table></div>\n";
}

std::string shot_html(const Verdict& verdict) {
    if (!verdict.finding.worst) return "";
    const Shot& shot = *verdict.finding.worst;
    std::string html = "<div class=\"three\">\n";
    for (const char* what : {"test", "reference"}) {
        const ImageRgb8& image = what == std::string_view("test") ? shot.test : shot.reference;
        std::string caption = what == std::string_view("test")
                                  ? fmt::format("{}, frame {}", escaped(family_of(verdict.spec)), shot.frame)
                                  : std::string("what it should be");
        html += fmt::format(
            "<figure><img loading=\"lazy\" src=\"{}\" alt=\"{}\" width=\"{}\" "
            "height=\"{}\"><figcaption>{}</figcaption></figure>\n",
            image_path(verdict, what), caption, image.width, image.height, caption);
    }
    return html + "</div>\n";
}

std::string cases_html(const SuiteResult& result) {
    std::string html, number;
    for (const Verdict& verdict : result.verdicts) {
        if (verdict.number != number) {
            html += fmt::format("<h2 id=\"{0}\">{0}: {1}</h2>\n", verdict.number, escaped(verdict.what));
            if (!verdict.note.empty()) html += fmt::format("<p class=\"note\">{}</p>\n", escaped(verdict.note));
        }
        number = verdict.number;
        html += fmt::format("<section>\n<h3>{}: {}</h3>\n<p>{}<br>{}</p>\n{}</section>\n",
                            with_labels_html(label_of(verdict.spec)), outcome_html(verdict, "span"), gates_html(verdict),
                            escaped(verdict.finding.sentence), shot_html(verdict));
    }
    return html;
}

std::string owed_html(const SuiteResult& result) {
    std::string html = "<h2>Not yet</h2>\n<table class=\"facts\">\n", methods;
    for (size_t i = 0; i < result.owed.size(); ++i) {
        const Owed& owed = result.owed[i];
        methods += (methods.empty() ? "" : ", ") + owed.method;
        bool is_last = i + 1 == result.owed.size() || result.owed[i + 1].number != owed.number;
        if (!is_last) continue;
        html += fmt::format("<tr><th scope=\"row\">{} {}</th><td>not yet: owed by {}</td></tr>\n", owed.number,
                            escaped(owed.what), escaped(methods));
        methods.clear();
    }
    return html + "</table>\n";
}

std::string facts_html(const RunSetup& setup, const Stage& stage) {
    auto row = [](const char* name, const std::string& value) {
        return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, value);
    };
    std::string frames = stage.frames == 0 ? "every frame of a flight"
                                           : fmt::format(
                                                 "at most {} of a flight where pictures are judged: the first ones where change "
                                                 "from frame to frame counts (S01, S16), spread over all of it elsewhere; every "
                                                 "frame where only decisions are (S02, S19)",
                                                 stage.frames);
    return "<pre>" + command_html(setup.command) + "</pre>\n<table class=\"facts\">\n" +
           row("Renderer", escaped(setup.renderer.name) +
                               (setup.renderer.is_software ? " <strong class=\"software\">software OpenGL</strong>" : "")) +
           row("Scene", escaped(setup.scene) + " <code>" + setup.scene_hash.substr(0, 12) + "</code>") +
           row("Pictures", fmt::format("{} x {} pixels", stage.width_px, stage.height_px)) + row("Frames", frames) +
           row("Error asked", fmt::format("{} px", stage.asked_px)) + row("Overlook", escaped(setup.version)) + "</table>\n";
}

Result<void> write_pictures(const SuiteResult& result, const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder + "/images", problem);
    if (problem) return cannot_write("{}/images: cannot make the folder: {}", folder, problem.message());
    for (const Verdict& verdict : result.verdicts) {
        if (!verdict.finding.worst) continue;
        const Shot& shot = *verdict.finding.worst;
        if (Result<void> written = write_png(folder + "/" + image_path(verdict, "test"), shot.test); !written) return written;
        Result<void> written = write_png(folder + "/" + image_path(verdict, "reference"), shot.reference);
        if (!written) return written;
    }
    return {};
}

}  // namespace

std::string stability_json(const SuiteResult& result, const RunSetup& setup, const Stage& stage) {
    Json verdicts = Json::array(), owed = Json::array();
    for (const Verdict& verdict : result.verdicts) verdicts.push_back(json_of(verdict));
    for (const Owed& each : result.owed) owed.push_back({{"case", each.number}, {"what", each.what}, {"method", each.method}});
    Json all = {{"version", 1},
                {"overlook", setup.version},
                {"command", setup.command},
                {"scene", {{"name", setup.scene}, {"hash", setup.scene_hash}}},
                {"renderer", {{"name", setup.renderer.name}, {"software", setup.renderer.is_software}}},
                {"width_px", stage.width_px},
                {"height_px", stage.height_px},
                {"most_frames", stage.frames},
                {"asked_px", stage.asked_px},
                {"kept", is_kept(result)},
                {"verdicts", verdicts},
                {"owed", owed}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stability_html(const SuiteResult& result, const RunSetup& setup, const Stage& stage) {
    auto count = [&](std::string_view outcome) {
        return std::count_if(result.verdicts.begin(), result.verdicts.end(),
                             [&](const Verdict& verdict) { return verdict.outcome() == outcome; });
    };
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>Stability suite</title>\n<style>\n{}</style>\n</head>\n<body>\n"
        "<main>\n<h1>Stability suite: {} of {} verdicts pass</h1>\n<p class=\"note\">{} more have no gate: their figures are "
        "stated. terrain:hard, which exchanges its levels at once, the papers' own forms and what discrete:fsi is compared with "
        "are "
        "baselines: their misses are shown and not held against them.</p>\n{}{}{}{}</main>\n</body>\n</html>\n",
        kPageStyle, count("pass"), count("pass") + count("miss"), count("stated"), facts_html(setup, stage), matrix_html(result),
        cases_html(result), owed_html(result));
}

Result<void> write_report(const SuiteResult& result, const RunSetup& setup, const Stage& stage, const std::string& folder) {
    if (Result<void> written = write_pictures(result, folder); !written) return written;
    std::string json = stability_json(result, setup, stage), page = stability_html(result, setup, stage);
    if (Result<void> written = write_file(folder + "/stability.json", std::string_view(json)); !written) return written;
    return write_file(folder + "/index.html", std::string_view(page));
}

}  // namespace overlook::measure
