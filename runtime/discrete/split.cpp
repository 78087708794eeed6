#include "runtime/discrete/split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/discrete/select.h"

namespace overlook::discrete {
namespace {

constexpr size_t kBunches = 4096;
constexpr double kNearest = 1.2;       // radii from the eye to a thing's middle
constexpr double kLeastAcross = 0.05;  // of the eye's way, which share must go across the view
constexpr double kRounding = 1e-6;     // of distances and angles

Bunch bunch_of(const Chain& chain, const Level& level, uint32_t draw, uint32_t first_index, uint32_t triangle_count) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    bool moves = false;
    for (uint32_t k = 0; k < 3 * triangle_count; ++k) {
        const Vertex& vertex = level.vertices[level.indices[level.draws[draw].first_index + first_index + k]];
        low = glm::min(low, position_m(chain, vertex)), high = glm::max(high, position_m(chain, vertex));
        moves = moves || (vertex.part < chain.parts.size() && !chain.parts[vertex.part].at_s.empty());
    }
    glm::dvec3 half_m = moves ? glm::dvec3(std::numeric_limits<double>::infinity()) : (high - low) / 2.0;
    return {(low + high) / 2.0, half_m, draw, first_index, triangle_count};
}

// The chain's own directions of those of the world.
glm::dvec3 own(const Placement& placement, const glm::dvec3& v) {
    return {placement.cosine * v.x + placement.sine * v.y, placement.cosine * v.y - placement.sine * v.x, v.z};
}

// How far a bunch reaches along a direction of the world, of length 1, from its middle.
double reach_m(const Bunch& bunch, const Placement& placement, const glm::dvec3& along) {
    // Nothing of what is infinite is lost where the direction has no share.
    glm::dvec3 shares = glm::max(glm::abs(own(placement, along)), glm::dvec3(std::numeric_limits<double>::min()));
    return glm::dot(shares, bunch.half_m) * placement.scale;
}

// Which bunches of a placed level are seen; in the chain's own world, where this is soon said.
class Sight {
  public:
    Sight(std::span<const Bunch> bunches, const Placement& placement, const glm::dvec3& eye_m, Sides sides)
        : eye_m_(own(placement, eye_m - placement.translation_m) / placement.scale) {
        // Vertices are placed in floats, so what is near is as far off as what is far away.
        for (const Bunch& bunch : bunches) rounding_m_ = std::max(rounding_m_, kRounding * glm::length(bunch.middle_m - eye_m_));
        for (const glm::dvec3& inwards : sides) {
            glm::dvec3 normal = own(placement, glm::normalize(inwards));
            sides_.push_back({normal, glm::max(glm::abs(normal), glm::dvec3(std::numeric_limits<double>::min()))});
        }
    }
    bool sees(const Bunch& bunch) const {
        glm::dvec3 from_eye_m = bunch.middle_m - eye_m_;
        return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
            return glm::dot(side.normal, from_eye_m) >= -glm::dot(side.shares, bunch.half_m) - rounding_m_;
        });
    }

  private:
    struct Side {
        glm::dvec3 normal, shares;
    };
    glm::dvec3 eye_m_;
    double rounding_m_ = 0;
    std::vector<Side> sides_;
};

// Of planes that hold an axis through the eye, at an angle from `ahead` to `side`: the one on whose two sides there is as much
// more of the finer level. NaN if there is none.
double best_angle(const std::array<std::span<const Bunch>, 2>& finer_and_coarser, const Placement& placement, Sides sides,
                  const glm::dvec3& eye_m, const glm::dvec3& ahead, const glm::dvec3& side) {
    // Up to `last` on the plane's side of greater angles, from `first` on on the other.
    std::vector<std::pair<double, double>> last, first;
    double more = 0;
    for (double sign : {1.0, -1.0}) {
        std::span<const Bunch> bunches = finer_and_coarser[sign > 0 ? 0 : 1];
        Sight sight(bunches, placement, eye_m, sides);
        for (const Bunch& bunch : bunches) {
            if (std::isinf(bunch.half_m.x) || !sight.sees(bunch)) continue;
            glm::dvec3 from_eye_m = placement.at(bunch.middle_m) - eye_m;
            double angle = std::atan2(glm::dot(from_eye_m, side), glm::dot(from_eye_m, ahead));
            double reach = reach_m(bunch, placement, std::cos(angle) * side - std::sin(angle) * ahead);
            double half = std::asin(std::min(1.0, reach / glm::length(from_eye_m)));
            last.emplace_back(angle + half, sign * bunch.triangle_count);
            first.emplace_back(angle - half, sign * bunch.triangle_count);
            more += sign * bunch.triangle_count;
        }
    }
    std::sort(last.begin(), last.end()), std::sort(first.begin(), first.end());
    double best = std::nan(""), least = std::numeric_limits<double>::infinity();
    size_t i = 0, k = 0;
    while (i < last.size() && k < first.size()) {
        double at = std::min(last[i].first, first[k].first);
        while (i < last.size() && last[i].first <= at + kRounding) more -= last[i++].second;
        while (k < first.size() && first[k].first <= at + kRounding) more -= first[k++].second;
        double next = std::min(i < last.size() ? last[i].first : at, k < first.size() ? first[k].first : at);
        if (next > at && std::abs(more) < least) least = std::abs(more), best = (at + next) / 2;
    }
    return best;
}

}  // namespace

std::vector<Bunch> bunches_of(const Chain& chain, const Level& level) {
    auto most = uint32_t(std::max<size_t>(1, level.triangle_count() / kBunches));
    std::vector<Bunch> bunches;
    for (uint32_t draw = 0; draw < level.draws.size(); ++draw) {
        uint32_t count = level.draws[draw].index_count / 3;
        for (uint32_t first = 0; first < count; first += most)
            bunches.push_back(bunch_of(chain, level, draw, 3 * first, std::min(most, count - first)));
    }
    return bunches;
}

std::optional<Split> split_of(std::span<const Bunch> finer, std::span<const Bunch> coarser, const Placement& placement,
                              const glm::dvec3& middle_m, double radius_m, const glm::dvec3& eye_m, const glm::dvec3& way_m,
                              Sides sides) {
    glm::dvec3 towards_m = placement.at(middle_m) - eye_m;
    double distance_m = glm::length(towards_m);
    if (finer.empty() || coarser.empty() || !(distance_m > kNearest * radius_m * placement.scale)) return std::nullopt;
    glm::dvec3 ahead = towards_m / distance_m, across = way_m - glm::dot(way_m, ahead) * ahead;
    if (!(glm::length(across) > kLeastAcross * glm::length(way_m))) {
        glm::dvec3 up = std::abs(ahead.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        // Aslant, since many things are built in rows and columns.
        up += 0.7 * glm::cross(ahead, up);
        across = up - glm::dot(up, ahead) * ahead;
    }
    glm::dvec3 side = glm::cross(glm::normalize(across), ahead);
    double best = best_angle({finer, coarser}, placement, sides, eye_m, ahead, side);
    if (std::isnan(best)) return std::nullopt;
    glm::dvec3 anchor_m = eye_m + distance_m * (std::cos(best) * ahead + std::sin(best) * side);
    return Split{own(placement, anchor_m - placement.translation_m) / placement.scale,
                 own(placement, std::cos(best) * side - std::sin(best) * ahead)};
}

glm::dvec3 turn_to_eye(Split& split, const Placement& placement, const glm::dvec3& eye_m) {
    glm::dvec3 normal = placement.turned(split.normal) / placement.scale;
    glm::dvec3 along = glm::normalize(placement.at(split.anchor_m) - eye_m);
    normal = glm::normalize(normal - glm::dot(normal, along) * along);
    split.normal = own(placement, normal);
    return normal;
}

uint64_t append_seen(std::span<const Bunch> bunches, const Placement& placement, const glm::dvec3& eye_m, Sides sides,
                     std::vector<TriangleRun>& runs) {
    uint64_t count = 0;
    size_t first_own = runs.size();
    Sight sight(bunches, placement, eye_m, sides);
    for (const Bunch& bunch : bunches) {
        if (!sight.sees(bunch)) continue;
        bool goes_on = runs.size() > first_own && runs.back().draw == bunch.draw &&
                       runs.back().first_index + runs.back().index_count == bunch.first_index;
        if (!goes_on) runs.push_back({bunch.draw, bunch.first_index, 0});
        runs.back().index_count += 3 * bunch.triangle_count;
        count += bunch.triangle_count;
    }
    return count;
}

uint64_t seen_count(std::span<const Bunch> bunches, const Placement& placement, const glm::dvec3& eye_m, Sides sides) {
    uint64_t count = 0;
    Sight sight(bunches, placement, eye_m, sides);
    for (const Bunch& bunch : bunches) count += sight.sees(bunch) ? bunch.triangle_count : 0;
    return count;
}

glm::dvec3 line_of(const glm::dvec3& normal_in_eye, double focal_px, uint32_t width_px, uint32_t height_px) {
    glm::dvec2 slope = glm::dvec2(normal_in_eye) / focal_px;
    double shift = normal_in_eye.z - glm::dot(slope, glm::dvec2(width_px, height_px) / 2.0);
    return glm::dvec3(slope, shift) * focal_px;
}

}  // namespace overlook::discrete
