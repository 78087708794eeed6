#include "tools/bake/wang_ldi/texture_shape.h"

#include <algorithm>
#include <cmath>

#include "formats/steady_math.h"
#include "tools/bake/wang_ldi/texture_boxes.h"

namespace overlook::wang_ldi {
namespace {

constexpr size_t kLinesTried = 1 << 16;
constexpr double kWorth = 0.005;

std::vector<BoxShape> shapes() {
    std::vector<BoxShape> all;
    for (double raised : {0.0, -0.3})
        for (double share : {1.0, 0.7, 0.4}) all.push_back({raised, share * BoxShape().half_height});
    return all;
}

double shown_along(const TextureSet& set, const DirectionalTexture& texture, const Line& line) {
    glm::dvec3 from(line.from_m), along(line.along);
    return seen_along(set, texture, from, along, over_tile(from, along, set.tile_m)).coverage;
}

}  // namespace

LinesByDistance::LinesByDistance(const Wedge& wedge) : middle_m_(wedge.tile_m / 2) {
    for (size_t c = 0; c + 1 < kClasses; ++c) {
        double end_m = wedge.nearest_m * steady::pow(wedge.farthest_m / wedge.nearest_m, double(c + 1) / kClasses);
        ends_squared_m_[c] = end_m * end_m;
    }
}

void LinesByDistance::add(const glm::vec3& from_m, double shown) {
    glm::dvec2 away = glm::dvec2(from_m) - middle_m_;
    auto past = std::upper_bound(ends_squared_m_.begin(), ends_squared_m_.end(), glm::dot(away, away));
    auto c = size_t(past - ends_squared_m_.begin());
    lines_[c] += 1, shown_[c] += shown;
}

double LinesByDistance::off(const LinesByDistance& truth) const {
    double squares = 0, classes = 0;
    for (size_t c = 0; c < kClasses; ++c) {
        if (lines_[c] == 0 || truth.shown_[c] == 0) continue;
        double share = shown_[c] / lines_[c] / (truth.shown_[c] / truth.lines_[c]) - 1;
        squares += share * share, classes += 1;
    }
    return classes > 0 ? std::sqrt(squares / classes) : 0;
}

BoxShape chosen_shape(const TextureSet& set, const Wedge& wedge, std::span<const Line> lines, std::span<const double> shown,
                      const LinesByDistance& truth, const std::function<DirectionalTexture(const BoxShape&)>& made) {
    std::vector<Line> some;
    for (size_t i = 0; i < lines.size(); i += 1 + lines.size() / kLinesTried) some.push_back(lines[i]);
    BoxShape best;
    double even = INFINITY, least = INFINITY;
    for (const BoxShape& shape : shapes()) {
        DirectionalTexture texture = made(shape);
        choose_opacity(set, some, shown, texture, 1);
        LinesByDistance drawn(wedge);
        for (const Line& line : some) drawn.add(line.from_m, shown_along(set, texture, line));
        double off = drawn.off(truth);
        if (std::isinf(even)) even = off;
        if (off < least) least = off, best = shape;
    }
    return even - least > kWorth ? best : BoxShape();
}

}  // namespace overlook::wang_ldi
