// What each collapse that a pass has chosen would do, measured before any of them is made.
#include <algorithm>
#include <array>

#include "formats/parallel.h"
#include "tools/bake/caveclod/attribute_deviation.h"
#include "tools/bake/caveclod/simplify_passes.h"
#include "tools/bake/caveclod/stopwatch.h"
#include "tools/bake/caveclod/thickness.h"

namespace overlook::caveclod {

void Passes::measure() {
    Stopwatch watch(report_.measuring_s);
    fans_.resize(std::max(fans_.size(), chosen_.size()));
    parallel_ranges(chosen_.size(), kFanGrain, [&](size_t begin, size_t end) {
        MapChanges& changes = changes_[begin / kFanGrain];
        changes.splices.clear(), changes.added.clear();
        for (size_t i = begin; i < end; ++i) measure_one(chosen_[i], fans_[i], changes);
    });
}

void Passes::prepare(const Chosen& chosen, TurnedFan& prepared) const {
    Star star;
    gather_star(mesh_, chosen.gone, star);
    uint32_t at = uint32_t(std::find(star.link.begin(), star.link.begin() + star.count + 1, chosen.kept) - star.link.begin());
    fan_of(star, chosen.gone, at, prepared.fan);
    keeps_groups(mesh_, prepared.fan, prepared.turned);
}

void Passes::measure_one(Chosen& chosen, TurnedFan& prepared, MapChanges& changes) {
    prepare(chosen, prepared);
    const Fan& fan = prepared.fan;
    chosen.measured = measure_collapse(map_, mesh_, fan, chosen.fan, changes);
    uint32_t place = map_.placement[chosen.gone].place;
    chosen.stated_m = std::max(chosen.measured.error_m, kThinningWeight * chosen.measured.thinning_m);
    chosen.fan_error_m = chosen.measured.error_m;
    for (uint32_t i = 0; i < fan.count; ++i)
        chosen.fan_error_m = std::max(chosen.fan_error_m, double(face_error_m_[fan.corner[i] / kCorners]));
    if (mesh_.seams_move) measure_seams(chosen, prepared, changes);
    chosen.worst_m = std::max(chosen.stated_m, attribute_deviation_m(mesh_, fan, prepared.turned, place));
    bool is_within = chosen.seam_error.is_within(seams_), has_slid = chosen.seam_error.uv_texels > seams_.uv_texels;
    chosen.is_refused = !chosen.measured.faces_its_source || !is_within;
    if (!is_within) chosen.refused_by = has_slid ? Hindrance::texels : Hindrance::degrees;
    bool may_be_made = !chosen.is_refused && chosen.worst_m <= most_allowed_m();
    if (may_be_made) chosen.turned_face = find_turned_face(chosen, fan);
    chosen.is_refused |= chosen.turned_face != kNone;
}

void Passes::measure_seams(Chosen& chosen, const TurnedFan& prepared, const MapChanges& changes) const {
    std::vector<uint32_t> places;
    for (uint32_t v : changes.inside) places.push_back(map_.placement[v].place);
    chosen.seam_error = seam_error(mesh_, prepared.fan, prepared.turned, changes.inside, places, seams_);
    chosen.seam_shift_m = seam_shift_m(mesh_, prepared.fan, prepared.turned);
    chosen.stated_m = std::max(chosen.stated_m, chosen.seam_shift_m);
}

// Every point of a new face is where the map has moved some point of the source, so some source is within the fan's error of it.
uint32_t Passes::find_turned_face(const Chosen& chosen, const Fan& fan) const {
    std::array<Triangle, kMostValence> faces;
    std::array<uint32_t, kMostValence> guesses;  // what the face was in the source
    uint32_t count = 0;
    for (uint32_t i = fan.first; i <= fan.last; ++i, ++count) {
        faces[count] = {mesh_.at(fan.kept), mesh_.at(fan.link[i]), mesh_.at(fan.link[i + 1])};
        guesses[count] = fan.corner[i] / kCorners;
    }
    size_t turned =
        source_.first_turned(std::span(faces).first(count), chosen.fan_error_m, slack_m_, std::span(guesses).first(count));
    return turned == count ? kNone : fan.first + uint32_t(turned);
}

}  // namespace overlook::caveclod
