#include "runtime/wang_ldi/plant_levels.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "runtime/discrete/poses.h"
#include "runtime/view/box_error.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kLeastInBunch = 192;  // triangles: fewer cost less than to find out whether they are seen

discrete::Bunch joined(const discrete::Bunch& a, const discrete::Bunch& b) {
    glm::dvec3 low = glm::min(a.middle_m - a.half_m, b.middle_m - b.half_m);
    glm::dvec3 high = glm::max(a.middle_m + a.half_m, b.middle_m + b.half_m);
    return {(low + high) / 2.0, (high - low) / 2.0, a.draw, a.first_index, a.triangle_count + b.triangle_count};
}

std::vector<discrete::Bunch> joined_bunches(std::span<const discrete::Bunch> from) {
    std::vector<discrete::Bunch> bunches;
    for (const discrete::Bunch& one : from) {
        bool goes_on = !bunches.empty() && bunches.back().draw == one.draw && bunches.back().triangle_count < kLeastInBunch &&
                       std::isfinite(one.half_m.x) && std::isfinite(bunches.back().half_m.x);
        if (goes_on)
            bunches.back() = joined(bunches.back(), one);
        else
            bunches.push_back(one);
    }
    return bunches;
}

double error_m(const discrete::LevelFacts& level) {
    return std::max(level.error_m, discrete::SelectSettings().area_weight * level.area_error_m);
}

uint32_t coarsest_within(const PlantForm& form, double within_m) {
    auto level = uint32_t(form.facts.levels.size() - 1);
    while (level > 0 && !(error_m(form.facts.levels[level]) <= within_m)) --level;
    return level;
}

struct InSight {
    double distance_m = 0;
    view::Cylinder cylinder;
    discrete::Item item;
};

}  // namespace

PlantForm form_of(const discrete::Chain& chain) {
    PlantForm form;
    form.facts = discrete::facts_of(chain);
    if (discrete::is_animated(chain)) {
        form.reach_m = glm::length(glm::dvec2(chain.middle_m)) + chain.radius_m;
        form.low_m = chain.middle_m.z - chain.radius_m, form.high_m = chain.middle_m.z + chain.radius_m;
    }
    for (const discrete::Level& level : chain.levels) {
        for (const discrete::Vertex& vertex : level.vertices) {
            glm::dvec3 at = discrete::position_m(chain, vertex);
            form.reach_m = std::max(form.reach_m, std::hypot(at.x, at.y));
            form.low_m = std::min(form.low_m, at.z), form.high_m = std::max(form.high_m, at.z);
        }
    }
    for (const discrete::LevelFacts& level : form.facts.levels) form.bunches.push_back(joined_bunches(level.bunches));
    return form;
}

ListedPlants plants_listed(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera, double error_px) {
    ListedPlants listed;
    view::BoxErrorBound bound(camera);
    std::array<glm::dvec3, 4> sides = view::sides_of(camera);
    std::vector<InSight> seen;
    for (uint32_t p = 0; p < places.placements.size(); ++p) {
        const discrete::Placement& placement = places.placements[p];
        double scale = placement.scale;
        view::Cylinder cylinder{placement.translation_m, scale * form.reach_m, scale * form.low_m, scale * form.high_m};
        if (!bound.may_be_seen(cylinder)) continue;
        view::BoxErrorBound::Sight sight = bound.of(cylinder);
        uint32_t level = error_px > 0 ? coarsest_within(form, bound.metres(sight, error_px) / scale) : 0;
        listed.error_px = std::max(listed.error_px, bound.pixels(sight, scale * error_m(form.facts.levels[level])));
        discrete::Show show = places.shares[p] < 1 ? discrete::Show::dithered_in : discrete::Show::whole;
        seen.push_back({glm::length(placement.translation_m - camera.position_m),
                        cylinder,
                        {p, level, show, double(places.shares[p]), 0, 1}});
    }
    std::sort(seen.begin(), seen.end(), [](const InSight& a, const InSight& b) {
        return std::tuple(a.item.level, a.distance_m, a.item.instance) < std::tuple(b.item.level, b.distance_m, b.item.instance);
    });
    discrete::FrameList& list = listed.frame;
    for (InSight& one : seen) {
        uint64_t all = form.facts.levels[one.item.level].triangle_count, count = all;
        if (all > kLeastInBunch && !bound.is_within_sides(one.cylinder)) {
            one.item.first_run = uint32_t(list.runs.size());
            count = discrete::append_seen(form.bunches[one.item.level], places.placements[one.item.instance], camera.position_m,
                                          sides, list.runs);
            if (count == 0) continue;
            if (count == all) list.runs.resize(one.item.first_run), one.item.first_run = 0;
            if (count < all) one.item.run_count = uint32_t(list.runs.size()) - one.item.first_run;
        }
        list.items.push_back(one.item), list.triangle_count += count;
    }
    list.in_view_count = list.items.size(), list.tested_count = places.placements.size();
    return listed;
}

std::vector<PlantList> plant_lists(std::span<const PlantForm> forms, std::span<const PlantPlaces> by_model,
                                   const view::Camera& camera, double error_px) {
    std::vector<PlantList> lists;
    for (uint32_t model = 0; model < forms.size(); ++model) {
        PlantList whole{model, false, {}, {}}, fading{model, true, {}, {}};
        for (size_t p = 0; p < by_model[model].placements.size(); ++p) {
            PlantPlaces& of = by_model[model].shares[p] < 1 ? fading.places : whole.places;
            of.placements.push_back(by_model[model].placements[p]), of.shares.push_back(by_model[model].shares[p]);
        }
        for (PlantList* list : {&whole, &fading}) {
            list->listed = plants_listed(forms[model], list->places, camera, error_px);
            if (!list->listed.frame.items.empty()) lists.push_back(std::move(*list));
        }
    }
    return lists;
}

}  // namespace overlook::wang_ldi
