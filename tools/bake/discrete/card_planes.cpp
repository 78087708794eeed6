#include "tools/bake/discrete/card_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "formats/parallel.h"
#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::discrete {
namespace {

constexpr size_t kMostPlanes = 64;
constexpr uint32_t kNobody = 0xffffffff;

std::array<double, 3> key_of(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

// The direction in which points spread least, from the sums of their products (by Jacobi's turns).
glm::dvec3 least_direction(glm::dmat3 m) {
    glm::dmat3 axes(1);
    for (int sweep = 0; sweep < 32; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(m[p][q]) < 1e-300) continue;
                double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                double c = 1 / std::sqrt(t * t + 1), s = t * c;
                glm::dmat3 turn(1);
                turn[p][p] = turn[q][q] = c, turn[q][p] = s, turn[p][q] = -s;
                m = glm::transpose(turn) * m * turn;
                axes = axes * turn;
            }
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (m[i][i] < m[least][least]) least = i;
    return axes[least];
}

// A face ready to be held against planes.
struct Item {
    std::array<glm::dvec3, 3> at_m;
    glm::dvec3 normal{0};  // of length 1, or 0
    double area_m2 = 0, worth = 0;
    uint32_t component = 0, plane = kNobody;
};

struct Found {
    glm::dvec3 normal{0};
    double offset_m = 0, score = 0;
};

class Coverer {
  public:
    Coverer(const Shape& shape, const Components& components, const std::vector<double>& worth, double distance_m)
        : component_count_(components.count), distance_m_(distance_m) {
        std::vector<double> area_m2(components.count, 0);
        for (size_t f = 0; f < shape.faces.size(); ++f) {
            Item& item = items_.emplace_back();
            for (size_t c = 0; c < 3; ++c) item.at_m[c] = shape.vertices[shape.faces[f][c]].at_m;
            glm::dvec3 normal = glm::cross(item.at_m[1] - item.at_m[0], item.at_m[2] - item.at_m[0]);
            double length = glm::length(normal);
            if (length > 0) item.normal = normal / length;
            item.area_m2 = length / 2, item.component = components.of_face[f];
            area_m2[item.component] += item.area_m2;
        }
        for (Item& item : items_)
            if (area_m2[item.component] > 0) item.worth = worth[item.component] * item.area_m2 / area_m2[item.component];
    }

    void run(double least_worth) {
        while (planes_.size() < kMostPlanes) {
            Found best = best_plane();
            for (int round = 0; round < 3 && best.score > 0; ++round) {
                Found refined = best_offset(fitted(best));
                if (refined.score <= best.score) break;
                best = refined;
            }
            if (best.score <= 0 || worth_of(best) < least_worth) break;
            for (Item& item : items_)
                if (item.plane == kNobody && is_near(item, best)) item.plane = uint32_t(planes_.size());
            planes_.push_back(best);
        }
        prune(least_worth);
    }

    Covering covering() const {
        Covering made{{}, covered()};
        for (const Found& plane : planes_) made.planes.push_back(plane_of(plane.normal * plane.offset_m, plane.normal));
        return made;
    }

  private:
    bool is_near(const Item& item, const Found& plane) const {
        return std::all_of(item.at_m.begin(), item.at_m.end(), [&](const glm::dvec3& p) {
            return std::abs(glm::dot(p, plane.normal) - plane.offset_m) <= distance_m_;
        });
    }
    double worth_of(const Found& plane) const {
        double sum = 0;
        for (const Item& item : items_)
            if (item.plane == kNobody && is_near(item, plane)) sum += item.worth;
        return sum;
    }

    // Of all planes across a direction the one near which most lies that faces it.
    Found best_offset(const glm::dvec3& normal) const {
        constexpr double kBinsOfDistance = 8;
        double low = 1e300, high = -1e300, bin_m = distance_m_ / kBinsOfDistance;
        for (const Item& item : items_)
            if (item.plane == kNobody)
                for (const glm::dvec3& p : item.at_m)
                    low = std::min(low, glm::dot(p, normal)), high = std::max(high, glm::dot(p, normal));
        if (low > high || (high - low) / bin_m > 1e6) return {};
        low -= distance_m_;
        std::vector<double> change(size_t((high + distance_m_ - low) / bin_m) + 3, 0);
        for (const Item& item : items_) {
            if (item.plane != kNobody || item.worth <= 0) continue;
            std::array<double, 3> at;
            for (size_t c = 0; c < 3; ++c) at[c] = glm::dot(item.at_m[c], normal);
            auto [least, most] = std::minmax_element(at.begin(), at.end());
            if (*most - *least > 2 * distance_m_) continue;
            auto begin = size_t(std::ceil((*most - distance_m_ - low) / bin_m)),
                 end = size_t(std::floor((*least + distance_m_ - low) / bin_m));
            if (begin > end) continue;
            double score = item.worth * (0.1 + 0.9 * std::abs(glm::dot(item.normal, normal)));
            change[begin] += score, change[end + 1] -= score;
        }
        Found best{normal, 0, 0};
        double sum = 0;
        for (size_t bin = 0; bin < change.size(); ++bin) {
            sum += change[bin];
            if (sum > best.score * (1 + 1e-9)) best.score = sum, best.offset_m = low + double(bin) * bin_m;
        }
        return best;
    }

    // Directions all round, those that many faces look in, and across what is worth most.
    std::vector<glm::dvec3> normals_to_try() const {
        constexpr int kAround = 48, kGrid = 24;
        constexpr size_t kOfFaces = 24, kOfComponents = 16;
        std::vector<glm::dvec3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int i = 0; i < kAround; ++i) {
            double up = (i + 0.5) / kAround, round = std::sqrt(1 - up * up), angle = 2.399963229728653 * i;
            normals.emplace_back(round * std::cos(angle), round * std::sin(angle), up);
        }
        std::map<std::array<int, 3>, glm::dvec4> bins;
        std::map<uint32_t, std::pair<double, std::vector<const Item*>>> open;
        for (const Item& item : items_) {
            if (item.plane != kNobody || item.worth <= 0) continue;
            glm::dvec3 n = item.normal;
            if (n.z < 0 || (n.z == 0 && (n.y < 0 || (n.y == 0 && n.x < 0)))) n = -n;
            std::array<int, 3> key{int(std::lround(n.x * kGrid)), int(std::lround(n.y * kGrid)), int(std::lround(n.z * kGrid))};
            bins[key] += item.worth * glm::dvec4(n, 1);
            auto& [worth, items] = open[item.component];
            worth += item.worth, items.push_back(&item);
        }
        std::vector<std::pair<double, glm::dvec3>> peaks, across;
        for (const auto& [key, sum] : bins)
            if (glm::length(glm::dvec3(sum)) > 0) peaks.emplace_back(-sum.w, glm::normalize(glm::dvec3(sum)));
        for (const auto& [component, of] : open) across.emplace_back(-of.first, across_of(of.second));
        for (auto* list : {&peaks, &across}) {
            std::stable_sort(list->begin(), list->end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            list->resize(std::min(list->size(), list == &peaks ? kOfFaces : kOfComponents));
            for (const auto& [worth, normal] : *list) normals.push_back(normal);
        }
        return normals;
    }

    static glm::dvec3 across_of(std::span<const Item* const> items) {
        glm::dvec3 middle(0);
        double area = 0;
        for (const Item* item : items)
            for (const glm::dvec3& p : item->at_m) middle += item->area_m2 * p, area += item->area_m2;
        if (area > 0) middle /= area;
        glm::dmat3 sums(0);
        for (const Item* item : items)
            for (const glm::dvec3& p : item->at_m) sums += item->area_m2 * glm::outerProduct(p - middle, p - middle);
        return least_direction(sums);
    }

    Found best_plane() const {
        std::vector<glm::dvec3> normals = normals_to_try();
        std::vector<Found> found(normals.size());
        parallel_ranges(normals.size(), 1, [&](size_t i, size_t) { found[i] = best_offset(normals[i]); });
        Found best;
        for (const Found& one : found)
            if (one.score > best.score * (1 + 1e-9)) best = one;
        return best;
    }

    glm::dvec3 fitted(const Found& plane) const {
        std::vector<const Item*> near;
        for (const Item& item : items_)
            if (item.plane == kNobody && is_near(item, plane)) near.push_back(&item);
        return near.empty() ? plane.normal : across_of(near);
    }

    std::vector<uint8_t> covered() const {
        std::vector<uint8_t> is_covered(component_count_, 1);
        for (const Item& item : items_)
            if (item.plane == kNobody) is_covered[item.component] = 0;
        return is_covered;
    }

    // Without planes that are not worth it, since what they cover is covered only in part.
    void prune(double least_worth) {
        for (bool changed = true; changed;) {
            changed = false;
            std::vector<uint8_t> is_covered = covered();
            std::vector<double> worth(planes_.size(), 0);
            for (const Item& item : items_)
                if (item.plane != kNobody && is_covered[item.component] != 0) worth[item.plane] += item.worth;
            auto least = std::min_element(worth.begin(), worth.end());
            if (least == worth.end() || *least >= least_worth) return;
            auto gone = uint32_t(least - worth.begin());
            planes_.erase(planes_.begin() + gone);
            for (Item& item : items_) {
                if (item.plane == kNobody || item.plane < gone) continue;
                item.plane = item.plane == gone ? kNobody : item.plane - 1;
                for (uint32_t p = 0; p < planes_.size() && item.plane == kNobody; ++p)
                    if (is_near(item, planes_[p])) item.plane = p;
            }
            changed = true;
        }
    }

    std::vector<Item> items_;
    std::vector<Found> planes_;
    uint32_t component_count_ = 0;
    double distance_m_ = 0;
};

}  // namespace

Components components_by_place(const Shape& shape) {
    std::map<std::array<double, 3>, uint32_t> at;
    std::vector<uint32_t> place(shape.vertices.size());
    for (uint32_t v = 0; v < place.size(); ++v) place[v] = at.try_emplace(key_of(shape.vertices[v].at_m), v).first->second;
    caveclod::DisjointSets sets(place.size());
    for (const auto& [a, b, c] : shape.faces) sets.unite(place[a], place[b]), sets.unite(place[a], place[c]);
    std::map<uint32_t, uint32_t> number;
    Components components;
    for (const auto& face : shape.faces)
        components.of_face.push_back(number.try_emplace(sets.find(place[face[0]]), uint32_t(number.size())).first->second);
    components.count = uint32_t(number.size());
    return components;
}

std::vector<uint32_t> components_of_cut(const Shape& finest, const Components& components, const Shape& cut) {
    std::map<std::array<double, 3>, uint32_t> at;
    for (size_t f = 0; f < finest.faces.size(); ++f)
        for (uint32_t v : finest.faces[f]) at.try_emplace(key_of(finest.vertices[v].at_m), components.of_face[f]);
    std::vector<uint32_t> of_cut;
    for (const auto& face : cut.faces) {
        auto found = at.find(key_of(cut.vertices[face[0]].at_m));
        of_cut.push_back(found == at.end() ? kNobody : found->second);
    }
    return of_cut;
}

Covering cover(const Shape& shape, const Components& components, const std::vector<double>& worth, double distance_m,
               double least_worth) {
    Coverer coverer(shape, components, worth, distance_m);
    coverer.run(least_worth);
    return coverer.covering();
}

std::vector<CardPlane> slabs(const Shape& shape, double distance_m, int stride) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const ShapeVertex& v : shape.vertices) low = glm::min(low, v.at_m), high = glm::max(high, v.at_m);
    glm::dvec3 middle = (low + high) / 2.0, size = high - low;
    int first = size.x <= size.y ? 0 : 1;
    std::vector<CardPlane> planes;
    for (int i = 0; i < 3; ++i) {
        int axis = i == 0 ? first : i == 1 ? 1 - first : 2;
        double apart_m = 2 * distance_m * (i == 0 ? 1 : stride);
        auto count = int(std::max(1.0, std::ceil(size[axis] / apart_m)));
        glm::dvec3 normal(0);
        normal[axis] = 1;
        for (int k = 0; k < count; ++k) {
            glm::dvec3 at = middle;
            at[axis] = low[axis] + size[axis] * (k + 0.5) / count;
            planes.push_back(plane_of(at, normal));
        }
    }
    return planes;
}

}  // namespace overlook::discrete
