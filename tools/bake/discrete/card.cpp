#include "tools/bake/discrete/card.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"

namespace overlook::discrete {
namespace {

constexpr uint32_t kMostTexels = 4096;  // a side

// Numbers 0..1 that follow from a seed alone (G. Steele, D. Lea, C. Flood, Fast Splittable Pseudorandom Number Generators, 2014).
double scattered(uint64_t seed) {
    seed += 0x9e3779b97f4a7c15;
    seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9;
    seed = (seed ^ (seed >> 27)) * 0x94d049bb133111eb;
    return double((seed ^ (seed >> 31)) >> 11) * 0x1p-53;
}

// The sums for a plane through values over (x, y).
struct Fit {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    glm::dvec3 v{0}, xv{0}, yv{0};

    void add(double at_x, double at_y, const glm::dvec3& value) {
        n += 1, x += at_x, y += at_y, xx += at_x * at_x, xy += at_x * at_y, yy += at_y * at_y;
        v += value, xv += at_x * value, yv += at_y * value;
    }
    void add(const Fit& o) { n += o.n, x += o.x, y += o.y, xx += o.xx, xy += o.xy, yy += o.yy, v += o.v, xv += o.xv, yv += o.yv; }
    // The mean where there is too little to lay a plane through.
    glm::dvec3 at(double at_x, double at_y) const {
        if (n == 0) return glm::dvec3(0);
        glm::dmat3 sums(n, x, y, x, xx, xy, y, xy, yy);
        double spread = (xx - x * x / n) * (yy - y * y / n);
        if (n < 16 || std::abs(glm::determinant(sums)) < 1e-6 * n * std::max(spread, 1e-12)) return v / n;
        glm::dmat3 inverse = glm::inverse(sums);
        glm::dvec3 weights = inverse * glm::dvec3(1, at_x, at_y);
        return weights.x * v + weights.y * xv + weights.z * yv;
    }
};

// What rays through a row of texels have hit.
struct Row {
    std::vector<double> coverage;
    std::vector<glm::dvec3> colour;
    Fit normals;
    double difference = 0, seen_from_both = 0;
};

// What the rays through a texel from one side have hit.
struct Seen {
    glm::dvec3 colour{0};
    int hits = 0;
};

class Caster {
  public:
    Caster(const CardSource& source, const CardOrder& order, const Card& card) : source_(source), order_(order), card_(card) {}

    Row row(uint32_t y) const {
        Row row;
        row.coverage.assign(card_.width, 0), row.colour.assign(card_.width, glm::dvec3(0));
        for (uint32_t x = 0; x < card_.width; ++x) cast_texel(x, y, row);
        return row;
    }

  private:
    void cast_texel(uint32_t x, uint32_t y, Row& row) const {
        constexpr int kSide = 4;
        static_assert(kSide * kSide == kRaysPerTexel);
        std::array<Seen, 2> seen;  // from the front, from behind
        for (int i = 0; i < kRaysPerTexel; ++i) {
            uint64_t seed = (order_.seed << 40) ^ ((uint64_t(y) * card_.width + x) * kRaysPerTexel + uint64_t(i)) << 1;
            double at_x = x + (i % kSide + scattered(seed)) / kSide, at_y = y + (i / kSide + scattered(seed | 1)) / kSide;
            // Every other one from behind, each side on all rows and columns.
            int side = (i % kSide + i / kSide) % 2 == 0 ? 1 : -1;
            cast(at_x, at_y, side, row, seen[side > 0 ? 0 : 1]);
        }
        row.coverage[x] = double(seen[0].hits + seen[1].hits) / kRaysPerTexel;
        std::array<double, 2> weights{order_.side >= 0 ? 1.0 : 0.0, order_.side <= 0 ? 1.0 : 0.0};
        for (size_t s = 0; s < 2; ++s)
            if (weights[s] == 1 && weights[1 - s] == 0 && seen[s].hits == 0) weights = {1, 1};
        double count = weights[0] * seen[0].hits + weights[1] * seen[1].hits;
        if (count > 0) row.colour[x] = (weights[0] * seen[0].colour + weights[1] * seen[1].colour) / count;
        if (seen[0].hits == 0 || seen[1].hits == 0) return;
        glm::dvec3 off = glm::abs(seen[0].colour / double(seen[0].hits) - seen[1].colour / double(seen[1].hits));
        row.difference += std::max({off.x, off.y, off.z}), row.seen_from_both += 1;
    }

    void cast(double at_x, double at_y, int side, Row& row, Seen& seen) const {
        const Shape& shape = source_.shape;
        auto weights_of = [](float second, float third) {
            return glm::dvec3(1.0 - double(second) - double(third), second, third);
        };
        AcceptHit accept = [&](uint32_t face, float second, float third) {
            return (order_.takes.empty() || order_.takes[face] != 0) && faces_plane(face) &&
                   source_.looks.is_drawn(shape, face, weights_of(second, third));
        };
        glm::dvec3 direction = -double(side) * card_.plane.normal;
        RayHit hit =
            source_.rays.first(card_.at_m(at_x, at_y) - order_.reach_m * direction, direction, 2 * order_.reach_m, accept);
        if (hit.triangle == RayHit::kNone) return;
        glm::dvec3 weights = weights_of(hit.second, hit.third);
        seen.colour += glm::dvec3(source_.looks.at(shape, hit.triangle, weights)), ++seen.hits;
        if (order_.side == -side) return;
        glm::dvec3 normal(0);
        for (size_t c = 0; c < 3; ++c)
            normal += weights[int(c)] * glm::dvec3(shape.vertices[shape.faces[hit.triangle][c]].normal);
        // As seen from this side, then as if it were the front.
        if (glm::dot(normal, direction) > 0) normal = -normal;
        if (side < 0) normal -= 2 * glm::dot(normal, card_.plane.normal) * card_.plane.normal;
        row.normals.add(at_x, at_y, normal);
    }

    bool faces_plane(uint32_t face) const {
        if (order_.least_cosine <= 0) return true;
        std::array<glm::dvec3, 3> t;
        for (size_t c = 0; c < 3; ++c) t[c] = source_.shape.vertices[source_.shape.faces[face][c]].at_m;
        glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        return std::abs(glm::dot(normal, card_.plane.normal)) >= order_.least_cosine * glm::length(normal);
    }

    const CardSource& source_;
    const CardOrder& order_;
    const Card& card_;
};

// The box of all that might be seen.
bool fit_box(const Shape& shape, const CardOrder& order, Card& card) {
    glm::dvec2 low(1e300), high(-1e300);
    for (size_t f = 0; f < shape.faces.size(); ++f) {
        if (!order.takes.empty() && order.takes[f] == 0) continue;
        double nearest_m = 1e300, farthest_m = -1e300;
        glm::dvec2 face_low(1e300), face_high(-1e300);
        for (uint32_t v : shape.faces[f]) {
            glm::dvec3 from = shape.vertices[v].at_m - card.plane.middle_m;
            double off_m = glm::dot(from, card.plane.normal);
            nearest_m = std::min(nearest_m, off_m), farthest_m = std::max(farthest_m, off_m);
            glm::dvec2 at(glm::dot(from, card.plane.right), glm::dot(from, card.plane.up));
            face_low = glm::min(face_low, at), face_high = glm::max(face_high, at);
        }
        if (nearest_m > order.reach_m || farthest_m < -order.reach_m) continue;
        low = glm::min(low, face_low), high = glm::max(high, face_high);
    }
    if (low.x > high.x) return false;
    glm::dvec2 texels = glm::ceil((high - low) / card.texel_m) + 2.0;
    if (texels.x > kMostTexels || texels.y > kMostTexels) return false;
    card.width = uint32_t(texels.x), card.height = uint32_t(texels.y);
    card.low_m = (low + high) / 2.0 - texels * card.texel_m / 2.0;
    return true;
}

std::vector<uint8_t> all_or_nothing(const std::vector<double>& coverage, uint32_t width, uint32_t height) {
    std::vector<uint8_t> is_opaque(coverage.size(), 0);
    std::vector<double> owed(size_t(width) + 2, 0), next(size_t(width) + 2, 0);
    for (uint32_t y = 0; y < height; ++y) {
        std::fill(next.begin(), next.end(), 0.0);
        int step = y % 2 == 0 ? 1 : -1;
        for (uint32_t i = 0; i < width; ++i) {
            uint32_t x = step > 0 ? i : width - 1 - i;
            size_t at = size_t(y) * width + x, slot = size_t(x) + 1;
            double wanted = coverage[at] + owed[slot];
            bool opaque = coverage[at] >= 1 || (coverage[at] > 0 && wanted >= 0.5);
            is_opaque[at] = opaque;
            double error = std::clamp(wanted - (opaque ? 1 : 0), -1.0, 1.0);
            owed[size_t(int(slot) + step)] += error * 7 / 16;
            next[size_t(int(slot) - step)] += error * 3 / 16;
            next[slot] += error * 5 / 16;
            next[size_t(int(slot) + step)] += error * 1 / 16;
        }
        std::swap(owed, next);
    }
    return is_opaque;
}

// To what is opaque, and a texel round it that is not.
void trim(Card& card) {
    uint32_t left = card.width, right = 0, top = card.height, bottom = 0;
    for (uint32_t y = 0; y < card.height; ++y)
        for (uint32_t x = 0; x < card.width; ++x) {
            if (card.is_opaque[size_t(y) * card.width + x] == 0) continue;
            left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
        }
    Card trimmed = card;
    trimmed.is_opaque.clear(), trimmed.colour.clear();
    if (left > right) {
        trimmed.width = trimmed.height = 0;
        card = std::move(trimmed);
        return;
    }
    trimmed.width = right - left + 3, trimmed.height = bottom - top + 3;
    trimmed.low_m += card.texel_m * glm::dvec2(double(left) - 1, double(card.height) - double(bottom) - 2);
    for (uint32_t y = 0; y < trimmed.height; ++y)
        for (uint32_t x = 0; x < trimmed.width; ++x) {
            bool is_rim = x == 0 || y == 0 || x + 1 == trimmed.width || y + 1 == trimmed.height;
            size_t from = is_rim ? 0 : size_t(y + top - 1) * card.width + (x + left - 1);
            trimmed.is_opaque.push_back(is_rim ? uint8_t(0) : card.is_opaque[from]);
            trimmed.colour.push_back(is_rim ? glm::dvec3(0) : card.colour[from]);
        }
    card = std::move(trimmed);
}

// Texels that nothing is known of take the mean of those round them, round after round; then the mean of all.
void spread_colour(Card& card) {
    constexpr int kRounds = 8;
    std::vector<uint8_t> is_known = card.is_opaque;
    glm::dvec3 sum(0);
    size_t count = 0;
    for (size_t i = 0; i < is_known.size(); ++i)
        if (is_known[i] != 0) sum += card.colour[i], ++count;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<uint8_t> before = is_known;
        for (uint32_t y = 0; y < card.height; ++y)
            for (uint32_t x = 0; x < card.width; ++x) {
                size_t at = size_t(y) * card.width + x;
                if (before[at] != 0) continue;
                glm::dvec3 round_it(0);
                int neighbours = 0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        uint32_t nx = uint32_t(int(x) + dx), ny = uint32_t(int(y) + dy);
                        if (nx >= card.width || ny >= card.height || before[size_t(ny) * card.width + nx] == 0) continue;
                        round_it += card.colour[size_t(ny) * card.width + nx], ++neighbours;
                    }
                if (neighbours > 0) card.colour[at] = round_it / double(neighbours), is_known[at] = 1;
            }
    }
    for (size_t i = 0; i < is_known.size() && count > 0; ++i)
        if (is_known[i] == 0) card.colour[i] = sum / double(count);
}

void set_normals(Card& card, const Fit& fit, const glm::dvec2& first) {
    glm::dvec2 size(card.width, card.height);
    const std::array<glm::dvec2, 4> corners{glm::dvec2(0, size.y), size, glm::dvec2(size.x, 0), glm::dvec2(0, 0)};
    for (size_t c = 0; c < 4; ++c) {
        glm::dvec3 normal = fit.at(first.x + corners[c].x, first.y + corners[c].y);
        // Never away from the front: then it would be dark from both sides.
        double out = glm::dot(normal, card.plane.normal);
        if (out < 0.1) normal += (0.1 - out) * card.plane.normal;
        card.normals[c] = glm::vec3(glm::normalize(normal));
    }
}

}  // namespace

CardPlane plane_of(const glm::dvec3& middle_m, const glm::dvec3& normal) {
    CardPlane plane;
    plane.middle_m = middle_m, plane.normal = glm::normalize(normal);
    glm::dvec3 upright = std::abs(plane.normal.z) > 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    plane.right = glm::normalize(glm::cross(upright, plane.normal));
    plane.up = glm::cross(plane.normal, plane.right);
    return plane;
}

uint64_t texels_of_card(const Shape& shape, const CardOrder& order, double texel_m) {
    Card card;
    card.plane = order.plane, card.texel_m = texel_m;
    return fit_box(shape, order, card) ? uint64_t(card.width) * card.height : 0;
}

Card cast_card(const CardSource& source, const CardOrder& order, double texel_m) {
    Card card;
    card.plane = order.plane, card.part = order.part, card.texel_m = texel_m;
    if (!fit_box(source.shape, order, card)) return card;
    std::vector<Row> rows(card.height);
    Caster caster(source, order, card);
    parallel_ranges(card.height, 1, [&](size_t y, size_t) { rows[y] = caster.row(uint32_t(y)); });
    std::vector<double> coverage;
    Fit normals;
    double both = 0;
    for (const Row& row : rows) {
        card.difference += row.difference, both += row.seen_from_both;
        coverage.insert(coverage.end(), row.coverage.begin(), row.coverage.end());
        card.colour.insert(card.colour.end(), row.colour.begin(), row.colour.end());
        normals.add(row.normals);
    }
    if (both > 0) card.difference /= both;
    card.is_opaque = all_or_nothing(coverage, card.width, card.height);
    glm::dvec2 low_m = card.low_m;
    double height = card.height;
    trim(card);
    if (card.width == 0) return card;
    spread_colour(card);
    glm::dvec2 moved = (card.low_m - low_m) / texel_m;
    set_normals(card, normals, {moved.x, height - moved.y - card.height});
    return card;
}

}  // namespace overlook::discrete
