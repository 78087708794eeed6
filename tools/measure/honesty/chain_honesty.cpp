#include "tools/measure/honesty/chain_honesty.h"

#include <algorithm>
#include <limits>

#include "formats/parallel.h"
#include "runtime/discrete/select.h"
#include "tools/measure/honesty/nearest_point.h"
#include "tools/measure/honesty/screen.h"

namespace overlook::measure {
namespace {

constexpr size_t kPlacesAtOnce = 256;

std::vector<glm::dvec3> corners_of(const discrete::Chain& chain, const discrete::Level& level) {
    std::vector<glm::dvec3> corners_m;
    for (uint32_t index : level.indices) corners_m.push_back(position_m(chain, level.vertices[index]));
    return corners_m;
}

// The middles of the triangles that are no cards.
std::vector<glm::dvec3> middles_of(const discrete::Chain& chain, const discrete::Level& level) {
    std::vector<glm::dvec3> middles_m;
    for (const discrete::Draw& draw : level.draws) {
        if (draw.surface >= chain.surfaces.size() - chain.picture_count) continue;
        for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
            glm::dvec3 sum(0);
            for (uint32_t k = 0; k < 3; ++k) sum += position_m(chain, level.vertices[level.indices[i + k]]);
            middles_m.push_back(sum / 3.0);
        }
    }
    return middles_m;
}

std::vector<glm::dvec3> evenly(const std::vector<glm::dvec3>& all, size_t most) {
    size_t step = (all.size() + most - 1) / most;
    std::vector<glm::dvec3> some;
    for (size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
}

}  // namespace

ChainHonesty::ChainHonesty(const discrete::Chain& chain) {
    of_level_.resize(chain.levels.size());
    std::vector<glm::dvec3> places_m;
    for (const discrete::Vertex& vertex : chain.levels[0].vertices) places_m.push_back(position_m(chain, vertex));
    places_m = evenly(places_m, kPlaces);
    NearestPoint finest(corners_of(chain, chain.levels[0]));
    for (size_t l = 1; l < chain.levels.size(); ++l) {
        auto add = [&](const std::vector<glm::dvec3>& from_m, const NearestPoint& nearest) {
            std::vector<Displaced> all(from_m.size());
            parallel_ranges(all.size(), kPlacesAtOnce, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) all[i] = {from_m[i], nearest(from_m[i])};
            });
            std::stable_sort(all.begin(), all.end(), [](const Displaced& a, const Displaced& b) {
                return glm::distance(a.from_m, a.to_m) > glm::distance(b.from_m, b.to_m);
            });
            all.resize(std::min(all.size(), kProjected));
            of_level_[l].insert(of_level_[l].end(), all.begin(), all.end());
        };
        add(places_m, NearestPoint(corners_of(chain, chain.levels[l])));
        add(evenly(middles_of(chain, chain.levels[l]), kPlaces), finest);
    }
}

void ChainHonesty::append_to(Promises& promises, const discrete::Director& director, const view::Camera& camera) const {
    Screen screen(camera);
    discrete::Selector selector(director.facts(), director.options().select, camera);
    auto append = [&](const discrete::Item& item) {
        const discrete::Placement& placement = director.placements()[item.instance];
        double most_px = item.level == 0 ? 0 : -1;
        for (const Displaced& one : of_level_[item.level]) {
            std::optional<glm::dvec2> from = screen.at(placement.at(one.from_m)), to = screen.at(placement.at(one.to_m));
            if (!from || !screen.is_in_frame(*from)) continue;
            most_px = std::max(most_px, to ? glm::distance(*from, *to) : std::numeric_limits<double>::infinity());
        }
        if (most_px < 0) return;
        promises.predicted_px.push_back(float(selector.error_px(placement, item.level)));
        promises.measured_px.push_back(float(most_px));
    };
    for (const discrete::Item& item : director.frame().items) append(item);
    for (const discrete::Item& item : director.frame().translucent) append(item);
}

}  // namespace overlook::measure
