#include <algorithm>
#include <cassert>

#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/numbers/temporal.h"

namespace overlook::measure {
namespace {

constexpr double kLeastW = 1e-3;

double median_of(std::span<const TemporalError> errors) {
    std::vector<double> means;
    for (const TemporalError& error : errors) means.push_back(error.mean);
    return percentile(std::span<const double>(means), 0.5);
}

}  // namespace

PopIndex pop_index(std::span<const TemporalError> method, std::span<const TemporalError> floor) {
    assert(method.size() == floor.size());
    PopIndex pop;
    for (size_t i = 0; i < method.size(); ++i) {
        assert(method[i].frame == floor[i].frame && method[i].tiles.size() == floor[i].tiles.size());
        for (size_t tile = 0; tile < method[i].tiles.size(); ++tile) {
            double excess = double(method[i].tiles[tile]) - double(floor[i].tiles[tile]);
            if (excess <= pop.excess) continue;
            pop.excess = excess;
            pop.frame = method[i].frame;
            pop.tile_column = uint32_t(tile % method[i].columns);
            pop.tile_row = uint32_t(tile / method[i].columns);
        }
    }
    pop.floor_median = median_of(floor);
    pop.method_median = median_of(method);
    pop.index = 1 + pop.excess / (pop.floor_median + kLeastW);
    return pop;
}

}  // namespace overlook::measure
