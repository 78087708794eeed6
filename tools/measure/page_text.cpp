#include "tools/measure/page_text.h"

#include <algorithm>
#include <cmath>

#include "formats/numbers.h"
#include "tools/measure/error_colours.h"
#include "tools/measure/figures.h"
#include "tools/measure/methods.h"

namespace overlook::measure {
namespace {

double e_of(const RunResult& run) {
    return percentiles_of(run, "e_p99_flip").p99;
}
double time_ms_of(const RunResult& run) {
    return percentiles_of(run, "frame_ms").p50;
}
double triangles_of(const RunResult& run) {
    return percentiles_of(run, "triangles").p50;
}

// Runs that are not floors, the order kept.
std::vector<const RunResult*> methods_of(const CourseResult& course) {
    std::vector<const RunResult*> runs;
    for (const RunResult& run : course.runs) {
        if (!is_floor(run.spec)) runs.push_back(&run);
    }
    return runs;
}

const RunResult& floor_of(const CourseResult& course) {
    return *std::find_if(course.runs.begin(), course.runs.end(), [](const RunResult& run) { return is_floor(run.spec); });
}

template <class Value>
const RunResult& with_most(const std::vector<const RunResult*>& runs, Value value) {
    return **std::max_element(runs.begin(), runs.end(), [&](auto* a, auto* b) { return value(*a) < value(*b); });
}

std::string front_text(const CourseResult& course, bool by_time) {
    auto cost = [&](const RunResult& run) { return by_time ? time_ms_of(run) : triangles_of(run); };
    auto shown = [&](const RunResult& run) {
        return by_time ? short_number(time_ms_of(run)) + " ms" : short_count(triangles_of(run)) + " triangles";
    };
    const RunResult& floor = floor_of(course);
    std::string text =
        fmt::format("Full geometry ({}) takes {} a frame at E {}.", floor.label, shown(floor), short_number(e_of(floor)));
    std::vector<const RunResult*> runs = methods_of(course);
    if (runs.empty()) return text;
    const RunResult& dear = with_most(runs, cost);
    const RunResult& cheap = with_most(runs, [&](const RunResult& run) { return -cost(run); });
    if (&dear != &cheap) {
        text += fmt::format(" The methods reach from {} at E {} ({}) to {} at E {} ({}).", shown(cheap),
                            short_number(e_of(cheap)), cheap.label, shown(dear), short_number(e_of(dear)), dear.label);
    }
    std::vector<const RunResult*> at_floor;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(at_floor),
                 [&](const RunResult* run) { return is_at_floor(*run, course.runs[run->floor]); });
    if (at_floor.empty()) {
        const RunResult& best = with_most(runs, [](const RunResult& run) { return -e_of(run); });
        return text + fmt::format(" None is at the floor (within 1.02 times its E); the nearest is {} at {} times.", best.label,
                                  short_number(e_of(best) / e_of(course.runs[best.floor])));
    }
    const RunResult& least = with_most(at_floor, [&](const RunResult& run) { return -cost(run); });
    return text + fmt::format(" The cheapest at the floor (within 1.02 times its E) is {}, for {} of the floor's cost.",
                              least.label, short_number(cost(least) / cost(course.runs[least.floor])));
}

std::string flight_text(const CourseResult& course) {
    std::vector<const RunResult*> runs = methods_of(course);
    if (runs.empty()) runs.push_back(&floor_of(course));
    const RunResult& slow = with_most(runs, [](const RunResult& run) { return percentiles_of(run, "frame_ms").p99; });
    std::string text = fmt::format("The longest frames besides the floor's are of {}: {} ms at the 99th percentile.", slow.label,
                                   short_number(percentiles_of(slow, "frame_ms").p99));
    if (!slow.worst_w.is_there) return text;
    const RunResult& popping = with_most(runs, [](const RunResult& run) { return run.pop.index; });
    text += fmt::format(" The greatest pop is of {}: index {} at frame {} (1 = as steady as the floor, up to 1.2 is allowed),",
                        popping.label, short_number(popping.pop.index), popping.pop.frame);
    text += fmt::format(" with a median W of {} against the floor's {}.", short_number(popping.pop.method_median),
                        short_number(popping.pop.floor_median));
    double events = 0;
    for (const RunResult& run : course.runs) {
        for (double value : values_of(run, figure("events"))) events += value;
    }
    return text + (events > 0 ? fmt::format(" Crosses at the foot: the {} events that methods told of.", short_count(events))
                              : std::string(" No method told of an event."));
}

std::string distribution_text(const CourseResult& course) {
    std::string text = "The farther left and the steeper, the better; a long foot to the right is a few bad frames.";
    std::vector<const RunResult*> runs = methods_of(course);
    if (runs.empty()) return text;
    auto spread = [](const RunResult& run) {
        Percentiles e = percentiles_of(run, "e_p99_flip");
        return e.p50 > 0 ? e.max / e.p50 : 1;
    };
    const RunResult& widest = with_most(runs, spread);
    return text +
           fmt::format(
               " Over the {} frames on which E was taken, {} has the longest foot: its worst frame has {} times the E of its "
               "median frame ({}).",
               values_of(widest, figure("e_p99_flip")).size(), widest.label, short_number(spread(widest)),
               short_number(percentiles_of(widest, "e_p99_flip").p50));
}

std::string promise_text(const CourseResult& course) {
    std::vector<const RunResult*> runs;
    HonestyTally all;
    size_t frames = 0;
    for (const RunResult& run : course.runs) {
        if (!has_ratios(run.g.all())) continue;
        runs.push_back(&run);
        all.add(run.g);
        frames += values_of(run, figure("g_max")).size();
    }
    const RunResult& worst = with_most(runs, [](const RunResult& run) { return run.g.all().ratio_max; });
    const RunResult& idlest = with_most(runs, [](const RunResult& run) { return -run.g.all().ratio_median; });
    const Honesty& g = all.all();
    std::string text = fmt::format(
        "Of {} triangles in {} frames of {} runs, {} lie farther from a source sample that they cover than was promised of them; "
        "the "
        "greatest share of a promise used is {} ({}).",
        short_count(double(g.count)), frames, runs.size(),
        g.above_prediction == 0 ? "none" : short_count(double(g.above_prediction)), short_number(g.ratio_max), worst.label);
    if (g.exact + g.broken_zeros > 0) {
        text += fmt::format(" Nothing at all was promised of {}: {} of them are out of place.",
                            short_count(double(g.exact + g.broken_zeros)),
                            g.broken_zeros == 0 ? "none" : short_count(double(g.broken_zeros)));
    }
    text += fmt::format(" The median triangle uses {}, in {} {}; under {} a promise is called idle.",
                        short_number(g.ratio_median), idlest.label, short_number(idlest.g.all().ratio_median), kIdleRatio);
    bool is_kept = std::all_of(runs.begin(), runs.end(), [](const RunResult* run) { return is_honest(run->g.all()); });
    return text + (is_kept ? " Every promise is kept." : " Not every promise is kept.");
}

}  // namespace

std::string short_count(double count) {
    return with_commas(uint64_t(std::llround(count)));
}

std::string short_bytes(double bytes) {
    if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
    return bytes < 1e6 ? fmt::format("{:.1f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string short_number(double number) {
    if (!std::isfinite(number)) return "infinite";
    if (number != 0 && std::abs(number) < 0.001) return fmt::format("{:.2g}", number);
    if (std::abs(number) < 1) return fmt::format("{:.3g}", number);
    return std::abs(number) < 100 ? fmt::format("{:.3g}", number) : short_count(number);
}

std::string chart_sentence(std::string_view chart_name, const CourseResult& course) {
    if (chart_name == "front_ms") return front_text(course, true);
    if (chart_name == "front_triangles") return front_text(course, false);
    if (chart_name == "flight") return flight_text(course);
    if (chart_name == "distribution") return distribution_text(course);
    return promise_text(course);
}

std::string worst_sentence(const RunResult& run, const RunResult& floor, bool is_e) {
    const WorstFrame& worst = is_e ? run.worst_e : run.worst_w;
    WorstPart part = worst_part(worst.map, worst.test.width, worst.test.height);
    const Numbers& floor_numbers = floor.frames[worst.frame].numbers;
    double floor_value = (is_e ? floor_numbers.e_p99 : floor_numbers.w).value_or(0);
    std::string text = fmt::format("Frame {}: {} {}", worst.frame, is_e ? "E" : "W", short_number(worst.value));
    if (&run != &floor && floor_value > 0) {
        text += fmt::format(", {} times the floor's {} on the same frame", short_number(worst.value / floor_value),
                            short_number(floor_value));
    }
    if (part.share == 0) return text + "; nothing differs.";
    return text +
           fmt::format("; the greatest part of it ({:.0f} %) lies in {} ninth of the picture.", 100 * part.share, part.name);
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (char c : text) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

std::string with_labels_html(std::string_view text) {
    auto is_of_label = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view(":@=.-").find(c) != std::string_view::npos;
    };
    std::string html;
    for (size_t begin = 0, end = 0; begin < text.size(); begin = end) {
        while (end < text.size() && is_of_label(text[end])) ++end;
        std::string_view word = text.substr(begin, end - begin), rest;
        if (word.ends_with('.')) rest = word.substr(word.size() - 1), word.remove_suffix(1);
        if (word.find('@') == std::string_view::npos) {
            if (end == begin) ++end;
            html += escaped(text.substr(begin, end - begin));
            continue;
        }
        html += "<span class=\"name\"><span>";
        for (char c : word) html += c == '@' ? std::string("</span><wbr><span>@") : std::string(1, c);
        html += "</span></span>" + std::string(rest);
    }
    return html;
}

std::string command_html(const std::vector<std::string>& words) {
    std::string html;
    for (const std::string& word : words) {
        bool is_plain = !word.empty() && word.find_first_of(" '\"\\$&|;<>()*?") == std::string::npos;
        html += (html.empty() ? "<span>" : " <span>") + escaped(is_plain ? word : "'" + word + "'") + "</span>";
    }
    return html;
}

}  // namespace overlook::measure
