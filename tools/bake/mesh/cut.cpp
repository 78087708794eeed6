// Cutting and splitting: corners at a position are joined over the edges that stay joined; each set of joined corners is a
// position.

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/sheets.h"

namespace overlook::mesh {
namespace {

// Beyond so many faces at one edge they are joined in the order of their numbers: comparing all pairs would take too long.
constexpr size_t kMostCompared = 32;
// How much flatter (as a cosine) a continuation on another surface must be to be taken before one on the same.
constexpr double kSameSurfaceBonus = 0.5;

class Cutter {
  public:
    Cutter(Mesh& mesh, std::span<const uint8_t> layer, MeshReport& report)
        : mesh_(mesh),
          layer_(layer),
          report_(report),
          faces_(mesh.faces),
          pair_(3 * mesh.faces.size(), kNone),
          is_in_odd_group_(3 * mesh.faces.size(), 0) {}

    void run(const EdgeGroups& groups) {
        for (size_t i = 0; i < groups.size(); ++i) join(groups.group(i));
        do {
            split_positions();
        } while (take_apart_what_is_joined_wrongly());
        count_cuts();
        count_pieces();
        apply();
    }

  private:
    uint32_t start(uint32_t h) const { return start_of(faces_, h); }
    bool are_opposite(uint32_t h, uint32_t g) const { return start(h) != start(g); }

    void pair(uint32_t h, uint32_t g) {
        pair_[h] = g;
        pair_[g] = h;
    }
    // Pairs the halfedges of one edge.
    void join(std::span<const uint32_t> group) {
        if (group.size() == 1) return;
        if (group.size() == 2 && are_opposite(group[0], group[1])) return pair(group[0], group[1]);
        odd_groups_.emplace_back(group.begin(), group.end());
        for (const uint32_t h : group) is_in_odd_group_[h] = 1;
        if (group.size() == 2) return;
        if (layer_[group[0] / 3] == 0) ++report_.complex_edge_count;
        group.size() <= kMostCompared ? join_flattest(group) : join_in_order(group);
    }

    glm::dvec3 unit_normal(uint32_t h) const {
        const glm::dvec3 a(corner_m(mesh_, h / 3, 0)), b(corner_m(mesh_, h / 3, 1)), c(corner_m(mesh_, h / 3, 2));
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        return length > 0 ? normal / length : glm::dvec3(0);
    }

    void join_flattest(std::span<const uint32_t> group) {
        struct Choice {
            double worth;
            uint32_t h, g;
        };
        std::vector<Choice> choices;
        for (size_t i = 0; i < group.size(); ++i) {
            for (size_t k = i + 1; k < group.size(); ++k) {
                const uint32_t h = group[i], g = group[k];
                if (!are_opposite(h, g)) continue;
                const bool is_same_surface = mesh_.face_surface[h / 3] == mesh_.face_surface[g / 3];
                choices.push_back({glm::dot(unit_normal(h), unit_normal(g)) + (is_same_surface ? kSameSurfaceBonus : 0), h, g});
            }
        }
        std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) { return a.worth > b.worth; });
        for (const Choice& choice : choices)
            if (pair_[choice.h] == kNone && pair_[choice.g] == kNone) pair(choice.h, choice.g);
    }

    void join_in_order(std::span<const uint32_t> group) {
        std::vector<uint32_t> forth, back;
        for (const uint32_t h : group) (are_opposite(h, group[0]) ? back : forth).push_back(h);
        for (size_t i = 0; i < std::min(forth.size(), back.size()); ++i) pair(forth[i], back[i]);
    }

    uint32_t root(uint32_t corner) {
        while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void unite(uint32_t a, uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);  // a root is its set's lowest corner
    }

    // Gives each fan of corners a position of its own: the first fan keeps the old one.
    void split_positions() {
        parent_.resize(pair_.size());
        for (uint32_t c = 0; c < parent_.size(); ++c) parent_[c] = c;
        for (uint32_t h = 0; h < pair_.size(); ++h) {
            const uint32_t g = pair_[h];
            if (g == kNone || g < h) continue;
            unite(h, next_halfedge(g));  // corner k is where halfedge k starts
            unite(g, next_halfedge(h));
        }
        split_.assign(faces_.begin(), faces_.end());
        origin_.resize(mesh_.positions_m.size());
        for (uint32_t p = 0; p < origin_.size(); ++p) origin_[p] = p;
        std::vector<uint8_t> is_taken(origin_.size(), 0);
        for (uint32_t c = 0; c < parent_.size(); ++c) {
            uint32_t& position = split_[c / 3][c % 3];
            const uint32_t r = root(c);
            if (r != c) {
                position = split_[r / 3][r % 3];
            } else if (is_taken[position]) {
                origin_.push_back(position);
                position = uint32_t(origin_.size() - 1);
            } else {
                is_taken[position] = 1;
            }
        }
    }

    // Edges that are cut in the middle of a sheet have the same ends on both sides still: all but the first pair (or single
    // halfedge) of such an edge get a start of their own. Only halfedges that had the same ends before can have them now. False
    // if there is none. Each call that finds one undoes a pair, so it ends: a corner without pairs has a position of its own.
    bool take_apart_what_is_joined_wrongly() {
        const auto ends = [&](uint32_t h) {
            const uint64_t a = start_of(split_, h), b = end_of(split_, h);
            return std::min(a, b) << 32 | std::max(a, b);
        };
        const auto is_before = [&](uint32_t h, uint32_t g) { return ends(h) != ends(g) ? ends(h) < ends(g) : h < g; };
        bool has_found = false;
        for (std::vector<uint32_t>& group : odd_groups_) {
            std::sort(group.begin(), group.end(), is_before);
            for (size_t first = 0, i = 1; i < group.size(); ++i) {
                const uint32_t h = group[i];
                if (ends(h) != ends(group[first])) {
                    first = i;
                } else if (pair_[h] == kNone || (pair_[h] != group[first] && pair_[h] > h)) {
                    has_found = true;
                    detach(h);
                }
            }
        }
        return has_found;
    }

    // Takes h's face, and the one that it is joined to over h, from all others at the start of h.
    void detach(uint32_t h) {
        unpair(previous_halfedge(h));
        if (pair_[h] != kNone) unpair(next_halfedge(pair_[h]));
    }
    // Pairs of odd groups are counted with their group.
    void unpair(uint32_t h) {
        const uint32_t g = pair_[h];
        if (g == kNone) return;
        pair_[h] = pair_[g] = kNone;
        if (!is_in_odd_group_[h]) ++detached_count_;
    }

    void count_cuts() {
        for (const std::vector<uint32_t>& group : odd_groups_) {
            size_t pieces = 0;
            for (const uint32_t h : group) pieces += pair_[h] == kNone || pair_[h] > h;
            report_.cut_edge_count += pieces - 1;
        }
        report_.cut_edge_count += detached_count_;
        report_.split_position_count += origin_.size() - mesh_.positions_m.size();
    }

    // Sets of faces joined over pairs.
    void count_pieces() {
        parent_.resize(faces_.size());
        for (uint32_t f = 0; f < parent_.size(); ++f) parent_[f] = f;
        for (uint32_t h = 0; h < pair_.size(); ++h)
            if (pair_[h] != kNone && h < pair_[h]) unite(h / 3, pair_[h] / 3);
        std::vector<uint8_t> has_border(faces_.size(), 0);
        for (uint32_t h = 0; h < pair_.size(); ++h) {
            if (pair_[h] != kNone) continue;
            has_border[root(h / 3)] = 1;
            ++report_.border_edge_count;
        }
        for (uint32_t f = 0; f < parent_.size(); ++f) {
            if (parent_[f] != f) continue;
            ++report_.component_count;
            report_.closed_component_count += has_border[f] == 0;
        }
    }

    void apply() {
        const size_t before = mesh_.positions_m.size();
        mesh_.faces = std::move(split_);
        for (size_t p = before; p < origin_.size(); ++p) mesh_.positions_m.push_back(mesh_.positions_m[origin_[p]]);
        link(before);
    }

    // The first position of each point and layer is the class's number.
    void link(size_t before) {
        std::vector<uint8_t> layer_of(origin_.size(), 0);
        for (size_t f = 0; f < mesh_.faces.size(); ++f)
            for (const uint32_t p : mesh_.faces[f]) layer_of[p] = layer_[f];
        std::vector<uint32_t> first[2];
        first[0].assign(before, kNone);
        first[1].assign(before, kNone);
        std::vector<uint32_t> link(origin_.size());
        bool has_linked = false;
        for (uint32_t p = 0; p < link.size(); ++p) {
            uint32_t& number = first[layer_of[p]][origin_[p]];
            if (number == kNone) number = p;
            link[p] = number;
            has_linked = has_linked || number != p;
        }
        if (has_linked) mesh_.link = std::move(link);
    }

    Mesh& mesh_;
    std::span<const uint8_t> layer_;
    MeshReport& report_;
    std::span<const Corners> faces_;                 // as they were before splitting
    std::vector<uint32_t> pair_;                     // [3F] the halfedge that this one is joined to, or kNone
    std::vector<uint8_t> is_in_odd_group_;           // [3F]
    std::vector<std::vector<uint32_t>> odd_groups_;  // halfedges of edges that are no pair of opposite ones, nor a border
    uint64_t detached_count_ = 0;                    // edges cut beside those
    std::vector<uint32_t> parent_;                   // [3F] sets of corners
    std::vector<Corners> split_;                     // faces after splitting
    std::vector<uint32_t> origin_;                   // [positions after splitting] the position that each was
};

}  // namespace

void cut(Mesh& mesh, const Orientation& orientation, MeshReport& report) {
    Cutter(mesh, orientation.layer, report).run(orientation.edges);
}

}  // namespace overlook::mesh
