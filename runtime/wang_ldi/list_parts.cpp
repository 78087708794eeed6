#include "runtime/wang_ldi/list_parts.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kWidestOfSample_px = 256 / 16.0;
constexpr double kDrawn = 0.1;  // of texels about so many points are drawn

double cost_of(const Field& field, const FieldList& list, const Item& item) {
    double cost = 1;
    for (const Shown& shown : list.shown_of(item)) {
        Stage stage = field.ladder().rungs[shown.rung].stage;
        if (stage == Stage::ldi) cost += field.parts().sample_counts[field.image_of(item, shown)];
        if (stage == Stage::texture || stage == Stage::colour) cost += kDrawn * item.texels_px * item.texels_px;
    }
    if (item.tiles_log2 > 0) cost += kDrawn * item.texels_px * item.texels_px;
    return cost;
}

}  // namespace

std::vector<size_t> parts_of(const Field& field, const FieldList& list, unsigned most) {
    std::vector<double> sums;
    double sum = 0;
    for (const Item& item : list.items) sums.push_back(sum += cost_of(field, list, item));
    std::vector<size_t> ends;
    for (unsigned part = 1; part < most; ++part) {
        auto end = size_t(std::lower_bound(sums.begin(), sums.end(), sum * part / most) - sums.begin());
        if (end > (ends.empty() ? 0 : ends.back()) && end < sums.size()) ends.push_back(end);
    }
    ends.push_back(sums.size());
    return ends;
}

double widest_splat_m(const Field& field, const FieldList& list, const Item& item) {
    const ImageSet& images = *field.parts().images;
    auto texel_m = [&](uint32_t rung) { return 1.5 * images.tile_m / field.texels_of(field.ladder().rungs[rung]); };  // aslant
    if (item.tiles_log2 > 0) return texel_m(item.last_rung);
    double widest_m = 0, slope = field.options().widens_splats ? steepest(list.halves_of(item)) : 0;
    for (const Shown& shown : list.shown_of(item)) {
        const Rung& rung = field.ladder().rungs[shown.rung];
        if (rung.stage == Stage::ldi) {
            const Level& level = images.levels[rung.level];
            double splat_px = images.has_splats ? kWidestOfSample_px : double(level.splat_px) * std::sqrt(1 + slope * slope);
            widest_m = std::max(widest_m, images.tile_m / level.side_px * splat_px);
        } else if (item.texels_px > 0) {
            widest_m = std::max(widest_m, texel_m(shown.rung));
        }
    }
    return widest_m;
}

double highest_step_m(const ImageSet& images) {
    float highest = 0;
    for (const Level& level : images.levels) highest = std::max(highest, level.height_step_m);
    return double(highest);
}

}  // namespace overlook::wang_ldi
