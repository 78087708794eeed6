#include "runtime/wang_ldi/list_parts.h"

#include <algorithm>

namespace overlook::wang_ldi {
namespace {

constexpr double kWidestOfSample_px = 256 / 16.0;

double cost_of(const Field& field, const FieldList& list, const Item& item) {
    double cost = 1;
    for (const Shown& shown : list.shown_of(item)) {
        Stage stage = field.ladder().rungs[shown.rung].stage;
        if (stage == Stage::ldi) cost += field.parts().sample_counts[field.image_of(item, shown)];
        if (stage == Stage::texture || stage == Stage::colour) cost += double(item.texels_px) * item.texels_px;
    }
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
    double widest_m = 0, side_m = images.tile_m * double(int64_t(1) << item.tiles_log2);
    for (const Shown& shown : list.shown_of(item)) {
        const Rung& rung = field.ladder().rungs[shown.rung];
        if (rung.stage == Stage::ldi) {
            const Level& level = images.levels[rung.level];
            widest_m = std::max(
                widest_m, images.tile_m / level.side_px * (images.has_splats ? kWidestOfSample_px : double(level.splat_px)));
        } else if (item.texels_px > 0) {
            widest_m = std::max(widest_m, 1.5 * side_m / item.texels_px);  // the diagonal, rounded up
        }
    }
    return widest_m;
}

}  // namespace overlook::wang_ldi
