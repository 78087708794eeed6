#include "runtime/wang_ldi/plant_levels.h"

#include <algorithm>
#include <array>
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

// A level of a plant.
struct InSight {
    double distance_m = 0, error_px = 0;
    view::Cylinder cylinder;
    discrete::Item item;
};

// Both levels behind one door, of which the plant has the first `share`.
void add_levels(const LevelMix& mix, double share, InSight of, std::vector<InSight>& seen) {
    of.item.level = mix.coarser, of.item.share = mix.coarser_share * share;
    of.item.show = of.item.share < 1 ? discrete::Show::dithered_in : discrete::Show::whole;
    if (of.item.share > 0) seen.push_back(of);
    if (mix.coarser_share >= 1) return;
    of.item.level = mix.finer, of.item.show = discrete::Show::dithered_out, of.item.up_to = share;
    seen.push_back(of);
}

std::vector<InSight> in_sight(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera,
                              const PlantAccuracy& accuracy) {
    view::BoxErrorBound bound(camera);
    std::vector<InSight> seen;
    for (uint32_t p = 0; p < places.placements.size(); ++p) {
        const discrete::Placement& placement = places.placements[p];
        double scale = placement.scale;
        view::Cylinder cylinder{placement.translation_m, scale * form.reach_m, scale * form.low_m, scale * form.high_m};
        if (!bound.may_be_seen(cylinder)) continue;
        view::BoxErrorBound::Sight sight = bound.of(cylinder);
        LevelMix mix{0, 0, 1};
        if (accuracy.error_px > 0) mix = levels_within(form, bound.metres(sight, accuracy.error_px) / scale, accuracy.fade);
        double error = std::max(error_m(form.facts.levels[mix.finer]), error_m(form.facts.levels[mix.coarser]));
        InSight one{glm::length(placement.translation_m - camera.position_m), bound.pixels(sight, scale * error), cylinder, {}};
        one.item.instance = p;
        add_levels(mix, double(places.shares[p]), one, seen);
    }
    return seen;
}

struct PictureSides {
    explicit PictureSides(const view::Camera& camera) : bound(camera), eye_m(camera.position_m), sides(view::sides_of(camera)) {}
    view::BoxErrorBound bound;
    glm::dvec3 eye_m;
    std::array<glm::dvec3, 4> sides;
};
// Of an item that a side of the picture may cut, the runs of its level that are in it; none if all are. Returns the triangles.
uint64_t add_runs(const PlantForm& form, const discrete::Placement& placement, const PictureSides& picture, InSight& one,
                  std::vector<discrete::TriangleRun>& runs) {
    uint64_t all = form.facts.levels[one.item.level].triangle_count;
    if (all <= kLeastInBunch || picture.bound.is_within_sides(one.cylinder)) return all;
    one.item.first_run = uint32_t(runs.size());
    uint64_t count = discrete::append_seen(form.bunches[one.item.level], placement, picture.eye_m, picture.sides, runs);
    if (count == all) runs.resize(one.item.first_run), one.item.first_run = 0;
    if (count < all) one.item.run_count = uint32_t(runs.size()) - one.item.first_run;
    return count;
}

ListedPlants listed_of(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera, std::vector<InSight> seen) {
    std::sort(seen.begin(), seen.end(), [](const InSight& a, const InSight& b) {
        return std::tuple(a.item.level, a.distance_m, a.item.instance) < std::tuple(b.item.level, b.distance_m, b.item.instance);
    });
    PictureSides picture(camera);
    ListedPlants listed;
    discrete::FrameList& list = listed.frame;
    std::vector<bool> is_listed(places.placements.size());
    for (InSight& one : seen) {
        listed.error_px = std::max(listed.error_px, one.error_px);
        uint32_t instance = one.item.instance;
        uint64_t count = add_runs(form, places.placements[instance], picture, one, list.runs);
        if (count == 0) continue;
        list.items.push_back(one.item), list.triangle_count += count;
        list.in_view_count += !is_listed[instance], is_listed[instance] = true;
    }
    list.tested_count = places.placements.size();
    return listed;
}

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

LevelMix levels_within(const PlantForm& form, double within_m, double fade) {
    auto error = [&](uint32_t level) { return error_m(form.facts.levels[level]); };
    uint32_t coarser = coarsest_within(form, within_m);
    double from_m = error(coarser), to_m = from_m / (1 - fade);
    for (size_t next = coarser + 1; next < form.facts.levels.size(); ++next) to_m = std::min(to_m, error(uint32_t(next)));
    if (coarser == 0 || !(within_m < to_m)) return {coarser, coarser, 1};
    uint32_t finer = coarser - 1;
    while (finer > 0 && !(error(finer) < from_m)) --finer;
    return {finer, coarser, (within_m - from_m) / (to_m - from_m)};
}

ListedPlants plants_listed(const PlantForm& form, const PlantPlaces& places, const view::Camera& camera,
                           const PlantAccuracy& accuracy) {
    return listed_of(form, places, camera, in_sight(form, places, camera, accuracy));
}

std::vector<PlantList> plant_lists(std::span<const PlantForm> forms, std::vector<PlantPlaces> by_model,
                                   const view::Camera& camera, const PlantAccuracy& accuracy) {
    std::vector<PlantList> lists;
    for (uint32_t model = 0; model < forms.size(); ++model) {
        if (by_model[model].placements.empty()) continue;
        auto places = std::make_shared<const PlantPlaces>(std::move(by_model[model]));
        std::vector<InSight> whole = in_sight(forms[model], *places, camera, accuracy), fading;
        std::erase_if(whole, [&](const InSight& one) {
            bool is_fading = one.item.show != discrete::Show::whole;
            if (is_fading) fading.push_back(one);
            return is_fading;
        });
        for (bool is_fading : {false, true}) {
            ListedPlants listed = listed_of(forms[model], *places, camera, is_fading ? std::move(fading) : std::move(whole));
            if (!listed.frame.items.empty()) lists.push_back({model, is_fading, places, std::move(listed)});
        }
    }
    return lists;
}

}  // namespace overlook::wang_ldi
