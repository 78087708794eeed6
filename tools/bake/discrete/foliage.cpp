#include "tools/bake/discrete/foliage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "formats/parallel.h"
#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::discrete {
namespace {

using caveclod::Triangle;
using caveclod::TriangleTree;

constexpr double kCountFactor = 1.3;         // between counts that are measured ahead
constexpr uint64_t kMostMeasured = 1 << 26;  // cards times counts

// Places on a curve through 2^21 cells a side (G. Morton, 1966).
uint64_t spread(uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

uint32_t reversed(uint32_t v) {
    uint32_t r = 0;
    for (int bit = 0; bit < 32; ++bit) r |= ((v >> bit) & 1u) << (31 - bit);
    return r;
}

}  // namespace

void Foliage::find_cards() {
    std::map<std::array<double, 3>, uint32_t> at;
    std::vector<uint32_t> place(shape_.vertices.size());
    for (uint32_t v = 0; v < place.size(); ++v) {
        const glm::dvec3& p = shape_.vertices[v].at_m;
        place[v] = at.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
    caveclod::DisjointSets sets(place.size());
    for (const auto& [a, b, c] : shape_.faces) sets.unite(place[a], place[b]), sets.unite(place[a], place[c]);
    std::map<uint32_t, uint32_t> number;
    for (uint32_t f = 0; f < shape_.faces.size(); ++f) {
        uint32_t card = number.try_emplace(sets.find(place[shape_.faces[f][0]]), uint32_t(number.size())).first->second;
        if (card == cards_.size()) cards_.emplace_back();
        cards_[card].faces.push_back(f);
    }
    for (Card& card : cards_) {
        glm::dvec3 sum_m(0);
        for (uint32_t f : card.faces) {
            std::array<glm::dvec3, 3> t;
            for (size_t c = 0; c < 3; ++c) t[c] = shape_.vertices[shape_.faces[f][c]].at_m;
            double area_m2 = glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
            card.area_m2 += area_m2;
            sum_m += area_m2 / 3 * (t[0] + t[1] + t[2]);
        }
        const glm::dvec3& corner_m = shape_.vertices[shape_.faces[card.faces[0]][0]].at_m;
        card.middle_m = card.area_m2 > 0 ? sum_m / card.area_m2 : corner_m;
        for (uint32_t f : card.faces)
            for (uint32_t v : shape_.faces[f])
                card.radius_m = std::max(card.radius_m, glm::distance(card.middle_m, shape_.vertices[v].at_m));
    }
}

// Neighbours on the curve play for who stays, the larger wins: round after round half of them go, evenly everywhere, the smallest
// of a round first.
void Foliage::rank() {
    glm::dvec3 low(1e300), high(-1e300);
    for (const Card& card : cards_) low = glm::min(low, card.middle_m), high = glm::max(high, card.middle_m);
    double cell_m = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-300}) / 0x1fffff;
    std::vector<std::pair<uint64_t, uint32_t>> curve;
    for (uint32_t i = 0; i < cards_.size(); ++i) {
        glm::dvec3 cell = (cards_[i].middle_m - low) / cell_m;
        curve.emplace_back(spread(uint64_t(cell.x)) | spread(uint64_t(cell.y)) << 1 | spread(uint64_t(cell.z)) << 2, i);
    }
    std::sort(curve.begin(), curve.end());
    std::vector<uint32_t> playing;
    for (const auto& [key, card] : curve) playing.push_back(card);
    std::vector<uint32_t> lost_first;
    while (playing.size() > 1) {
        std::vector<uint32_t> winners;
        std::vector<std::tuple<double, uint32_t, uint32_t>> losers;  // area, a scattered number, card
        for (uint32_t i = 0; i < playing.size(); i += 2) {
            if (i + 1 == playing.size()) {
                winners.push_back(playing[i]);
                continue;
            }
            uint32_t a = playing[i], b = playing[i + 1];
            if (cards_[b].area_m2 > cards_[a].area_m2) std::swap(a, b);
            winners.push_back(a);
            losers.emplace_back(cards_[b].area_m2, reversed(i / 2), b);
        }
        std::sort(losers.begin(), losers.end());
        for (const auto& [area, scattered, card] : losers) lost_first.push_back(card);
        playing = std::move(winners);
    }
    if (!playing.empty()) lost_first.push_back(playing[0]);
    order_.assign(lost_first.rbegin(), lost_first.rend());
}

Shape Foliage::kept_shape(const std::vector<uint32_t>& kept, double grow_m) const {
    double all_m2 = 0, kept_m2 = 0;
    for (const Card& card : cards_) all_m2 += card.area_m2;
    for (uint32_t i : kept) kept_m2 += cards_[order_[i]].area_m2;
    double wanted = kept_m2 > 0 ? std::sqrt(all_m2 / kept_m2) : 1;
    std::vector<uint32_t> number(shape_.vertices.size(), ~0u);
    Shape drawn;
    for (uint32_t i : kept) {
        const Card& card = cards_[order_[i]];
        double grown = std::min(wanted, 1 + (card.radius_m > 0 ? grow_m / card.radius_m : 0));
        for (uint32_t f : card.faces) {
            std::array<uint32_t, 3> face{};
            for (size_t c = 0; c < 3; ++c) {
                uint32_t v = shape_.faces[f][c];
                if (number[v] == ~0u) {
                    number[v] = uint32_t(drawn.vertices.size());
                    drawn.vertices.push_back(shape_.vertices[v]);
                    drawn.vertices.back().at_m = card.middle_m + grown * (shape_.vertices[v].at_m - card.middle_m);
                }
                face[c] = number[v];
            }
            drawn.faces.push_back(face);
            drawn.face_surface.push_back(shape_.face_surface[f]);
        }
    }
    return drawn;
}

// The distance to one triangle is convex, so over a lost face it is greatest at a corner; any triangle that stays will do.
std::vector<float> Foliage::distances_m(const std::vector<uint32_t>& kept, const Shape& drawn) const {
    TriangleTree tree(drawn.triangles());
    std::vector<float> distances_m(order_.size());
    size_t next = 0;
    for (uint32_t i = 0; i < order_.size(); ++i) {
        if (next < kept.size() && kept[next] == i) {
            ++next;
            continue;
        }
        const Card& card = cards_[order_[i]];
        const Triangle& near = tree.triangle(tree.nearest(card.middle_m).triangle);
        caveclod::TriangleProbe probe = caveclod::probe_of(near[0], near[1], near[2]);
        double most_m = 0;
        for (uint32_t f : card.faces)
            for (uint32_t v : shape_.faces[f])
                most_m = std::max(most_m, std::sqrt(caveclod::distance2_to_triangle(shape_.vertices[v].at_m, probe)));
        distances_m[i] = rounded_up(most_m);
    }
    return distances_m;
}

void Foliage::measure() {
    double factor = std::max(kCountFactor, 1 + 16 * double(order_.size()) / double(kMostMeasured));
    for (double count = double(order_.size()); count >= 1; count /= factor)
        if (prefixes_.empty() || prefixes_.back().count != uint32_t(count)) prefixes_.push_back({uint32_t(count), {}});
    parallel_ranges(prefixes_.size(), 1, [&](size_t p, size_t) {
        std::vector<uint32_t> kept(prefixes_[p].count);
        std::iota(kept.begin(), kept.end(), 0u);
        prefixes_[p].distance_m = distances_m(kept, kept_shape(kept, 0));
    });
}

Foliage::Foliage(Shape shape) : shape_(std::move(shape)) {
    find_cards();
    rank();
    measure();
}

// A prefix, and all cards that are too far from it: of all prefixes the one for which that is fewest.
std::vector<uint32_t> Foliage::kept_within(double limit_m) const {
    const Prefix* best = nullptr;
    size_t fewest = 0;
    for (const Prefix& prefix : prefixes_) {
        auto far = size_t(std::count_if(prefix.distance_m.begin(), prefix.distance_m.end(),
                                        [&](float distance_m) { return double(distance_m) > limit_m; }));
        if (best == nullptr || prefix.count + far < fewest) best = &prefix, fewest = prefix.count + far;
    }
    std::vector<uint32_t> kept;
    for (uint32_t i = 0; best != nullptr && i < order_.size(); ++i)
        if (i < best->count || double(best->distance_m[i]) > limit_m) kept.push_back(i);
    return kept;
}

Foliage::Thinned Foliage::thinned(const std::vector<uint32_t>& kept, double grow_m) const {
    Thinned thinned;
    if (order_.empty()) return thinned;
    thinned.shape = kept_shape(kept, grow_m);
    double drift_m = 0;
    std::vector<Triangle> as_they_are = kept_shape(kept, 0).triangles(), drawn = thinned.shape.triangles();
    for (size_t i = 0; i < drawn.size(); ++i)
        for (size_t c = 0; c < 3; ++c) drift_m = std::max(drift_m, glm::distance(as_they_are[i][c], drawn[i][c]));
    std::vector<float> lost_m = distances_m(kept, thinned.shape);
    thinned.error_m = std::max(drift_m, double(*std::max_element(lost_m.begin(), lost_m.end())));
    thinned.lost_m2 = std::max(0.0, shape_.area_m2() - thinned.shape.area_m2());
    return thinned;
}

}  // namespace overlook::discrete
