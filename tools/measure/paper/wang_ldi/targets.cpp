#include "tools/measure/paper/wang_ldi/targets.h"

#include <algorithm>
#include <cmath>

#include "tools/measure/page_text.h"

namespace overlook::measure::paper::wang {
namespace {

using Value = std::optional<double>;

// What the paper prints of its two sets: hours on 500 MHz, megabytes.
struct Printed {
    const char *hours, *bytes;
    double minutes_goal;
};
Printed printed_of(const std::string& name) {
    if (name == "sunflowers") return {"64 h (500 MHz)", "195 MB", 20};
    if (name == "grass") return {"288 h (500 MHz)", "278 MB", 30};
    return {"-", "-", 30};
}

Target target(const Plants& plants, const std::string& name, const char* printed, double goal, bool is_at_least) {
    return {plants.name + ": " + name, printed, goal, is_at_least, {}, "", ""};
}

// Of both reports.
Target of_both(const Plants& plants, Target target, Value (*of)(const BakeReport&)) {
    target.measured = {of(plants.paper), of(plants.own)};
    return target;
}

Value worst_zone(const BakeReport& report) {
    return std::max(
        {std::abs(report.density_corner - 1), std::abs(report.density_edge - 1), std::abs(report.density_inside - 1)});
}

Value finest_unseen(const BakeReport& report) {
    if (!report.images || report.images->levels.empty()) return std::nullopt;
    return 100 * report.images->levels[0].unseen_share_mean;
}

// Of the finest level's pictures, among the tiles' own or among foreign neighbours.
Value finest_judged(const BakeReport& report, std::optional<Judged> LevelReport::*among, double Judged::*of) {
    if (!report.images || report.images->levels.empty() || !(report.images->levels[0].*among)) return std::nullopt;
    return 100 * (*(report.images->levels[0].*among)).*of;
}

std::string both_numbers(Value paper, Value own) {
    return (paper ? short_number(*paper) : "-") + " and " + (own ? short_number(*own) : "-");
}

// Holes after small ones were filled, and in the note before.
void add_holes(const Plants& plants, const char* name, const char* printed, double goal,
               std::optional<Judged> LevelReport::*among, std::vector<Target>& targets) {
    auto holes = [&](const BakeReport& report, double Judged::*of) { return finest_judged(report, among, of); };
    Target one = target(plants, name, printed, goal, false);
    one.measured = {holes(plants.paper, &Judged::filled_hole_share), holes(plants.own, &Judged::filled_hole_share)};
    Value paper = holes(plants.paper, &Judged::hole_share), own = holes(plants.own, &Judged::hole_share);
    if (paper || own) one.note = "Before any are filled " + both_numbers(paper, own);
    targets.push_back(one);
}

void add_of_planting(const Plants& plants, std::vector<Target>& targets) {
    targets.push_back(of_both(
        plants, target(plants, "greatest correlation of tiles over lags 2 to 10", "\"looks like white noise\"", 0.02, false),
        [](const BakeReport& r) { return Value(std::abs(r.correlation)); }));
    targets.back().note =
        fmt::format("A single tile {}, Robinson's sixteen {}", short_number(std::abs(plants.single.correlation)),
                    short_number(std::abs(plants.robinson.correlation)));
    targets.push_back(of_both(
        plants, target(plants, "density at corners, at edges and inside, farthest off the mean", "voids at corners", 0.05, false),
        worst_zone));
    Target& zones = targets.back();
    zones.note = fmt::format("As published {:.2f}, {:.2f}, {:.2f}; Overlook {:.2f}, {:.2f}, {:.2f}", plants.paper.density_corner,
                             plants.paper.density_edge, plants.paper.density_inside, plants.own.density_corner,
                             plants.own.density_edge, plants.own.density_inside);
    targets.push_back(of_both(plants, target(plants, "relative radius", "-", 0.7, true),
                              [](const BakeReport& r) { return Value(r.relative_radius); }));
    targets.push_back(of_both(plants, target(plants, "tight radii that overlap in any legal neighbourhood", "-", 0, false),
                              [](const BakeReport& r) { return Value(double(r.tight_overlaps)); }));
    targets.back().note = fmt::format("Of {} and {} neighbourhoods", short_count(double(plants.paper.neighbourhoods)),
                                      short_count(double(plants.own.neighbourhoods)));
}

void add_of_images(const Plants& plants, std::vector<Target>& targets) {
    Printed printed = printed_of(plants.name);
    targets.push_back(of_both(plants,
                              target(plants, "minutes to sample and light all images (and to judge them, where that was asked)",
                                     printed.hours, printed.minutes_goal, false),
                              [](const BakeReport& r) { return r.images ? Value(r.images->seconds / 60) : std::nullopt; }));
    uint64_t found = plants.paper.images ? plants.paper.images->taken_from_parts : 0;
    if (found > 0)
        targets.back().note =
            fmt::format("{} images of the paper's constants were there from a bake before", short_count(double(found)));
    targets.push_back(of_both(plants, target(plants, "bytes a sample", "about 8", 2.5, false), [](const BakeReport& r) {
        return r.images ? Value(double(r.images->all.bytes) / double(std::max<uint64_t>(1, r.images->all.samples)))
                        : std::nullopt;
    }));
    targets.push_back(of_both(plants, target(plants, "megabytes of images", printed.bytes, 80, false), [](const BakeReport& r) {
        return r.images ? Value(double(r.images->all.bytes) / 1e6) : std::nullopt;
    }));
    targets.back().note = fmt::format("{} samples and {}", short_count(double(plants.paper_size.samples)),
                                      short_count(double(plants.own_size.samples)));
    targets.push_back(
        of_both(plants, target(plants, "unseen of what eyes of the cell see, nearest level, %", "14.7 (a prototype)", 2, false),
                finest_unseen));
    add_holes(plants, "pixels that show nothing, nearest level, %", "8.4 (a prototype, unfilled)", 0.1, &LevelReport::own,
              targets);
    add_holes(plants, "the same among foreign neighbours, %", "-", 1, &LevelReport::foreign, targets);
}

const FieldRow* row_of(const FlownLand& land, const char* set, const char* family, const char* what, double x) {
    for (const FieldRow& row : land.rows)
        if (row.set == set && row.family == family && row.what == what && row.x == x) return &row;
    return nullptr;
}

// Where geometry comes nearest to what Overlook takes; null: there was no race.
const FieldRow* closest_race(const FlownLand& land, std::string_view family) {
    const FieldRow* closest = nullptr;
    for (const FieldRow& row : land.rows) {
        if (row.family != family || !row.own_times_as_fast) continue;
        if (closest == nullptr || *row.own_times_as_fast < *closest->own_times_as_fast) closest = &row;
    }
    return closest;
}

// Section 6: the paper's way and Overlook's.
void add_of_fields(const Plants& plants, std::vector<Target>& targets) {
    bool is_grass = plants.name == "grass";
    for (const FlownLand& land : plants.lands) {
        auto add = [&](const std::string& name, const char* printed, double goal, bool is_at_least, const Value& paper,
                       const Value& own) {
            targets.push_back(target(plants, land.name + ": " + name, printed, goal, is_at_least));
            targets.back().measured = {paper, own};
        };
        const FieldRow *paper = row_of(land, "flight", "the paper's", "walk", 0),
                       *own = row_of(land, "flight", "Overlook", "walk", 0);
        if (paper && own)
            add("frames a second, walking, with terrain", is_grass ? "1 to 2" : "1.5 to 3", is_grass ? 20 : 30, true,
                1000 / std::max(1e-3, paper->ms_p50), 1000 / std::max(1e-3, own->ms_p50));
        for (const char* family : {kByOpenGl, kByProcessor})
            if (const FieldRow* race = closest_race(land, family)) {
                add(fmt::format("times as fast as {} in place of images, the least from 1 px on", family), "-", 1, true,
                    std::nullopt, race->own_times_as_fast);
                targets.back().note = fmt::format("At {} px, {}", short_number(race->x), race->what);
            }
        const FieldRow *printed_way = row_of(land, "remedy", "the paper's", "", 1),
                       *remedied = row_of(land, "remedy", "Overlook", "", 1);
        if (printed_way && remedied && printed_way->in_cell && remedied->in_cell) {
            add("holes in the cell after filling, %", "\"some\"", 0.1, false, 100 * printed_way->in_cell->share(),
                100 * remedied->in_cell->share());
            add("widest hole over magenta, px", "-", 2, false, double(printed_way->in_cell->widest_px),
                double(remedied->in_cell->widest_px));
        }
        const FieldRow *wide = row_of(land, "radius", "Overlook", "", 1000), *near = row_of(land, "radius", "Overlook", "", 40);
        if (wide && near)
            add("cost of a radius of 1,000 tiles beside 40", "-", 2, false, std::nullopt,
                wide->ms_p50 / std::max(1e-3, near->ms_p50));
    }
}

// From the run's own numbers.
void say_why(const Plants& plants, Target& target) {
    if (target.measured.back().value_or(target.goal) <= target.goal || target.is_at_least) return;
    if (target.name.find("show nothing") != std::string::npos)
        target.why = fmt::format("{} % of what is seen was never sampled, and only gaps of two pixels are filled",
                                 short_number(finest_unseen(plants.own).value_or(0)));
    if (target.name.find("megabytes") != std::string::npos)
        target.why = fmt::format("{} samples of {} tiles", short_count(double(plants.own_size.samples)), plants.own.tiles);
}

}  // namespace

std::vector<std::string> target_columns() {
    return {"the paper's constants", "Overlook"};
}

std::vector<Target> targets_of(const Flown& flown) {
    std::vector<Target> targets;
    for (const Plants& plants : flown.plants) {
        size_t first = targets.size();
        add_of_planting(plants, targets), add_of_images(plants, targets), add_of_fields(plants, targets);
        for (size_t i = first; i < targets.size(); ++i) say_why(plants, targets[i]);
    }
    return targets;
}

}  // namespace overlook::measure::paper::wang
