#include "tests/caveclod/synthetic_hierarchy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>


namespace overlook::caveclod::synthetic {
namespace {

constexpr uint32_t kNone = ~0u;

struct Collapse {
    uint32_t from = 0, to = 0;
    float error_m = 0;
    std::vector<uint32_t> removed;                 // faces, with their corners at the time
    std::vector<std::array<uint32_t, 3>> corners;  // of the removed
    std::vector<uint32_t> moved;                   // face * kCorners + corner
};

class Baker {
  public:
    explicit Baker(const Source& source) : source_(source), faces_(source.faces), star_(source.positions_m.size()) {
        for (uint32_t face = 0; face < faces_.size(); ++face)
            for (uint32_t p : faces_[face]) star_[p].push_back(face);
        is_alive_.assign(faces_.size(), true);
        error_m_.assign(faces_.size(), 0);
        is_there_.assign(star_.size(), true);
    }

    void run() {
        while (pass()) {
        }
    }

    std::vector<std::vector<Collapse>> passes;
    const std::vector<bool>& is_alive() const { return is_alive_; }
    const std::vector<bool>& is_there() const { return is_there_; }
    const std::vector<std::array<uint32_t, 3>>& faces() const { return faces_; }

  private:
    struct Candidate {
        double cost = 0;
        uint32_t from = 0, to = 0;
        bool operator<(const Candidate& other) const {
            return std::tuple(cost, from, to) < std::tuple(other.cost, other.from, other.to);
        }
    };

    glm::dvec3 at(uint32_t p) const { return glm::dvec3(source_.positions_m[p]); }
    std::set<uint32_t> ring(uint32_t p) const {
        std::set<uint32_t> found;
        for (uint32_t face : star_[p]) found.insert(faces_[face].begin(), faces_[face].end());
        found.erase(p);
        return found;
    }
    std::set<uint32_t> groups_at(uint32_t p) const {
        std::set<uint32_t> found;
        for (uint32_t face : star_[p]) found.insert(source_.face_group[face]);
        return found;
    }
    // Neighbours across an edge at which a group ends, or the mesh does.
    std::set<uint32_t> features(uint32_t p) const {
        std::map<uint32_t, std::vector<uint32_t>> across;
        for (uint32_t face : star_[p])
            for (uint32_t q : faces_[face])
                if (q != p) across[q].push_back(source_.face_group[face]);
        std::set<uint32_t> found;
        for (const auto& [q, groups] : across)
            if (groups.size() != 2 || groups[0] != groups[1]) found.insert(q);
        return found;
    }
    glm::dvec3 normal(const std::array<uint32_t, 3>& face) const {
        return glm::cross(at(face[1]) - at(face[0]), at(face[2]) - at(face[0]));
    }

    // Does the line of a feature turn by more than 60 degrees?
    bool is_bend(uint32_t p, uint32_t before, uint32_t after) const {
        return glm::dot(glm::normalize(at(before) - at(p)), glm::normalize(at(after) - at(p))) > -0.5;
    }

    bool is_legal(uint32_t from, uint32_t to, double& cost) const {
        std::set<uint32_t> ring_from = ring(from), ring_to = ring(to), both, apexes;
        std::set_intersection(ring_from.begin(), ring_from.end(), ring_to.begin(), ring_to.end(),
                              std::inserter(both, both.end()));
        for (uint32_t face : star_[from])
            if (std::find(faces_[face].begin(), faces_[face].end(), to) != faces_[face].end())
                for (uint32_t q : faces_[face])
                    if (q != from && q != to) apexes.insert(q);
        if (both != apexes || apexes.empty() || ring_from.size() + ring_to.size() < 8 || ring_to.size() > 14) return false;
        std::set<uint32_t> features_from = features(from);
        if (!features_from.empty() && (features_from.size() != 2 || features_from.count(to) == 0)) return false;
        if (!features_from.empty() && is_bend(from, *features_from.begin(), *features_from.rbegin())) return false;
        for (uint32_t group : groups_at(from))
            if (groups_at(to).count(group) == 0) return false;
        cost = 0;
        for (uint32_t face : star_[from]) {
            std::array<uint32_t, 3> after = faces_[face];
            if (std::find(after.begin(), after.end(), to) != after.end()) continue;
            glm::dvec3 before = normal(after);
            std::replace(after.begin(), after.end(), from, to);
            glm::dvec3 turned = normal(after);
            if (glm::dot(before, turned) < 0.3 * glm::length(before) * glm::length(turned)) return false;
            cost = std::max(cost, std::abs(glm::dot(glm::normalize(turned), at(from) - at(to))));
        }
        return true;
    }

    bool pass() {
        std::vector<Candidate> candidates;
        for (uint32_t p = 0; p < star_.size(); ++p) {
            if (!is_there_[p]) continue;
            Candidate best{1e300, p, kNone};
            for (uint32_t q : ring(p)) {
                double cost = 0;
                if (is_legal(p, q, cost)) best = std::min(best, {cost, p, q});
            }
            if (best.to != kNone) candidates.push_back(best);
        }
        std::sort(candidates.begin(), candidates.end());
        candidates.resize((candidates.size() + 1) / 2);
        std::vector<bool> is_touched(star_.size(), false);
        std::vector<Collapse> done;
        for (const Candidate& candidate : candidates) {
            std::set<uint32_t> near = ring(candidate.from);
            near.insert(candidate.from);
            if (std::any_of(near.begin(), near.end(), [&](uint32_t p) { return bool(is_touched[p]); })) continue;
            for (uint32_t p : near) is_touched[p] = true;
            done.push_back(collapse(candidate));
        }
        if (done.empty()) return false;
        passes.push_back(std::move(done));
        return true;
    }

    Collapse collapse(const Candidate& candidate) {
        Collapse made{candidate.from, candidate.to, float(candidate.cost), {}, {}, {}};
        for (uint32_t face : star_[candidate.from]) made.error_m = std::max(made.error_m, error_m_[face]);
        for (uint32_t face : star_[candidate.from]) {
            auto& corners = faces_[face];
            error_m_[face] = made.error_m;
            if (std::find(corners.begin(), corners.end(), candidate.to) != corners.end()) {
                made.removed.push_back(face);
                made.corners.push_back(corners);
                is_alive_[face] = false;
                for (uint32_t p : corners)
                    if (p != candidate.from) std::erase(star_[p], face);
                continue;
            }
            uint32_t c = uint32_t(std::find(corners.begin(), corners.end(), candidate.from) - corners.begin());
            corners[c] = candidate.to;
            made.moved.push_back(face * kCorners + c);
            star_[candidate.to].push_back(face);
        }
        star_[candidate.from].clear();
        is_there_[candidate.from] = false;
        return made;
    }

    const Source& source_;
    std::vector<std::array<uint32_t, 3>> faces_;
    std::vector<std::vector<uint32_t>> star_;
    std::vector<bool> is_alive_, is_there_;
    std::vector<float> error_m_;
};

// Old ids to new ones, and what is made of them.
class Numbering {
  public:
    Numbering(const Source& source, const Baker& baker) : source_(source), baker_(baker) {
        position_.assign(source.positions_m.size(), kNone);
        face_.assign(source.faces.size(), kNone);
    }

    Hierarchy run() {
        for (uint32_t p = 0; p < position_.size(); ++p)
            if (baker_.is_there()[p]) add_position(p);
        h_.base_position_count = uint32_t(old_position_.size());
        for (uint32_t face = 0; face < face_.size(); ++face)
            if (baker_.is_alive()[face]) add_face(face, baker_.faces()[face]);
        h_.base_face_count = uint32_t(h_.face_positions.size());
        h_.added_begin.push_back(h_.base_face_count), h_.moved_begin.push_back(0);
        for (size_t pass = baker_.passes.size(); pass-- > 0;) {
            std::vector<Collapse> splits = baker_.passes[pass];
            std::sort(splits.begin(), splits.end(),
                      [&](const Collapse& a, const Collapse& b) { return position_[a.to] < position_[b.to]; });
            for (const Collapse& split : splits) add_split(split);
        }
        add_vertices();
        h_.group_surface = source_.group_surface;
        for (uint32_t group = 0; group < h_.group_surface.size(); ++group) h_.group_packed.push_back(uint16_t(group));
        uint32_t surface_count = 1 + *std::max_element(h_.group_surface.begin(), h_.group_surface.end());
        for (uint32_t i = 0; i < surface_count; ++i)
            h_.surfaces.push_back({fmt::format("surface {}", i),
                                   {uint8_t(200 - 40 * (i % 4)), uint8_t(90 + 50 * (i % 3)), 80, 255},
                                   "",
                                   {},
                                   false,
                                   0.5f,
                                   false});
        return std::move(h_);
    }

  private:
    void add_position(uint32_t old) {
        position_[old] = uint32_t(old_position_.size());
        old_position_.push_back(old);
        h_.positions_m.push_back(source_.positions_m[old]);
    }
    void add_face(uint32_t old, const std::array<uint32_t, 3>& corners) {
        face_[old] = uint32_t(h_.face_positions.size());
        h_.face_positions.push_back({position_[corners[0]], position_[corners[1]], position_[corners[2]]});
        h_.face_group.push_back(source_.face_group[old]);
    }
    void add_split(const Collapse& split) {
        h_.owner.push_back(position_[split.to]);
        h_.error_m.push_back(split.error_m);
        add_position(split.from);
        for (size_t i = 0; i < split.removed.size(); ++i) add_face(split.removed[i], split.corners[i]);
        h_.added_begin.push_back(uint32_t(h_.face_positions.size()));
        for (uint32_t corner : split.moved) h_.moved.push_back(face_[corner / kCorners] * kCorners + corner % kCorners);
        h_.moved_begin.push_back(uint32_t(h_.moved.size()));
    }

    uint16_t wedge_of(uint32_t position, uint32_t group) const {
        const auto& groups = groups_[position];
        return uint16_t(std::lower_bound(groups.begin(), groups.end(), group) - groups.begin());
    }
    void add_vertices() {
        groups_.resize(h_.positions_m.size());
        std::vector<glm::dvec3> normals(h_.positions_m.size(), glm::dvec3(0));
        for (uint32_t face = 0; face < source_.faces.size(); ++face) {
            const auto& c = source_.faces[face];
            glm::dvec3 a(source_.positions_m[c[0]]), b(source_.positions_m[c[1]]), d(source_.positions_m[c[2]]);
            for (uint32_t p : c) {
                groups_[position_[p]].push_back(source_.face_group[face]);
                normals[position_[p]] += glm::cross(b - a, d - a);
            }
        }
        h_.vertex_begin.push_back(0);
        for (uint32_t p = 0; p < groups_.size(); ++p) {
            auto& groups = groups_[p];
            std::sort(groups.begin(), groups.end());
            groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
            for (uint32_t group : groups) {
                glm::vec2 uv(h_.positions_m[p].x * 0.05f + float(group), h_.positions_m[p].y * 0.05f);
                h_.vertices.push_back({p, glm::vec3(glm::normalize(normals[p])), uv, {255, 255, 255, 255}});
            }
            h_.vertex_begin.push_back(uint32_t(h_.vertices.size()));
        }
        h_.attributes = source_.attributes;
        for (uint32_t face = 0; face < h_.face_positions.size(); ++face)
            for (uint32_t p : h_.face_positions[face]) h_.birth_wedge.push_back(wedge_of(p, h_.face_group[face]));
        for (uint32_t i = 0; i < h_.split_count(); ++i)
            for (uint32_t k = h_.moved_begin[i]; k < h_.moved_begin[i + 1]; ++k) {
                uint32_t group = h_.face_group[h_.moved[k] / kCorners];
                h_.moved_wedge.push_back(wedge_of(h_.new_position(i), group));
                h_.moved_back_wedge.push_back(wedge_of(h_.owner[i], group));
            }
    }

    const Source& source_;
    const Baker& baker_;
    Hierarchy h_;
    std::vector<uint32_t> position_, face_, old_position_;
    std::vector<std::vector<uint32_t>> groups_;
};

}  // namespace

Source hills(uint32_t columns, uint32_t rows, uint32_t group_columns, double height_m) {
    Source source;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x)
            source.positions_m.emplace_back(
                x, y, height_m * (std::sin(x * 0.21) * std::cos(y * 0.17) + 0.2 * std::sin(x * 0.9 + y * 1.3)));
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            source.faces.push_back({a, b, d}), source.faces.push_back({a, d, c});
            uint32_t group = x * group_columns / columns;
            source.face_group.insert(source.face_group.end(), {group, group});
        }
    }
    for (uint32_t group = 0; group < group_columns; ++group) source.group_surface.push_back(group);
    return source;
}

Source sphere(uint32_t rings) {
    Source source;
    constexpr double kPi = 3.14159265358979323846, kRadius_m = 10;
    uint32_t meridians = 2 * rings;
    source.positions_m.emplace_back(0, 0, kRadius_m);
    for (uint32_t ring = 1; ring < rings; ++ring)
        for (uint32_t m = 0; m < meridians; ++m) {
            double theta = kPi * ring / rings, phi = 2 * kPi * m / meridians;
            source.positions_m.emplace_back(kRadius_m * std::sin(theta) * std::cos(phi),
                                            kRadius_m * std::sin(theta) * std::sin(phi), kRadius_m * std::cos(theta));
        }
    source.positions_m.emplace_back(0, 0, -kRadius_m);
    auto place = [&](uint32_t ring, uint32_t m) { return 1 + (ring - 1) * meridians + m % meridians; };
    uint32_t south = uint32_t(source.positions_m.size() - 1);
    for (uint32_t m = 0; m < meridians; ++m) {
        source.faces.push_back({0, place(1, m), place(1, m + 1)});
        for (uint32_t ring = 1; ring + 1 < rings; ++ring) {
            source.faces.push_back({place(ring, m), place(ring + 1, m), place(ring + 1, m + 1)});
            source.faces.push_back({place(ring, m), place(ring + 1, m + 1), place(ring, m + 1)});
        }
        source.faces.push_back({south, place(rings - 1, m + 1), place(rings - 1, m)});
    }
    source.face_group.assign(source.faces.size(), 0);
    source.group_surface.assign(1, 0);
    return source;
}

Hierarchy bake(const Source& source, const Precision& precision) {
    Baker baker(source);
    baker.run();
    Hierarchy hierarchy = Numbering(source, baker).run();
    canonicalise(hierarchy);
    hierarchy.finest_error_m = float(quantise(hierarchy, precision).position_m);
    Result<void> completed = complete(hierarchy);
    assert(completed);
    (void)completed;
    round_errors(hierarchy);
    return hierarchy;
}

std::vector<Triangle> triangles_of(const Hierarchy& h, const std::vector<bool>& is_applied) {
    std::map<uint32_t, Triangle> faces;
    auto add = [&](uint32_t face) {
        Triangle& t = faces[face];
        t.face = face;
        for (size_t c = 0; c < 3; ++c) {
            t.positions[c] = h.face_positions[face][c];
            t.vertices[c] = h.vertex_begin[t.positions[c]] + h.birth_wedge[3 * size_t(face) + c];
        }
    };
    for (uint32_t face = 0; face < h.base_face_count; ++face) add(face);
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        if (!is_applied[i]) continue;
        for (uint32_t k = h.moved_begin[i]; k < h.moved_begin[i + 1]; ++k) {
            Triangle& t = faces.at(h.moved[k] / kCorners);
            size_t c = h.moved[k] % kCorners;
            assert(t.positions[c] == h.owner[i]);
            t.positions[c] = h.new_position(i);
            t.vertices[c] = h.vertex_begin[t.positions[c]] + h.moved_wedge[k];
        }
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) add(face);
    }
    std::vector<Triangle> triangles;
    for (const auto& [face, triangle] : faces) triangles.push_back(triangle);
    return triangles;
}

}  // namespace overlook::caveclod::synthetic
