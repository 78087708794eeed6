// Neighbours made to agree on which side is outside.

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/sheets.h"

namespace overlook::mesh {
namespace {

// Whether a face says twice where its outside is: by its corners' order and by the normals at all of them.
bool has_evidence(const Mesh& mesh, size_t face) {
    if (mesh.face_normals.empty()) return false;
    const glm::dvec3 a(corner_m(mesh, face, 0)), b(corner_m(mesh, face, 1)), c(corner_m(mesh, face, 2));
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return std::all_of(mesh.face_normals[face].begin(), mesh.face_normals[face].end(),
                       [&](uint32_t i) { return i != kNone && glm::dot(normal, glm::dvec3(mesh.normals[i])) > 0; });
}

struct Piece {
    std::vector<uint32_t> faces;
    size_t turned_count = 0;
    bool is_closed = true;
};

class Orienter {
  public:
    Orienter(const Mesh& mesh, std::span<const uint8_t> layer)
        : mesh_(mesh),
          layer_(layer),
          groups_(group_edges(mesh.faces, mesh.positions_m.size(), layer)),
          turns_(mesh.faces.size(), kUnknown),
          is_evident_(mesh.faces.size()),
          across_(3 * mesh.faces.size(), kNone) {
        for (size_t f = 0; f < is_evident_.size(); ++f) is_evident_[f] = has_evidence(mesh, f);
        for (size_t i = 0; i < groups_.size(); ++i) {
            const auto group = groups_.group(i);
            if (group.size() != 2 || do_contradict(group[0], group[1])) continue;
            across_[group[0]] = group[1];
            across_[group[1]] = group[0];
        }
    }

    // For each face of layer 0 whether it is to be turned.
    std::vector<uint8_t> decide() {
        Piece piece;
        for (uint32_t f = 0; f < turns_.size(); ++f)
            if (is_evident_[f] && layer_[f] == 0 && turns_[f] == kUnknown) walk(f, piece);
        for (uint32_t f = 0; f < turns_.size(); ++f) {
            if (layer_[f] != 0 || turns_[f] != kUnknown) continue;
            walk(f, piece);
            if (!is_better_as_it_is(piece))
                for (const uint32_t face : piece.faces) turns_[face] ^= 1;
        }
        for (uint8_t& turn : turns_)
            if (turn == kUnknown) turn = 0;
        return turns_;
    }
    EdgeGroups take_edges() { return std::move(groups_); }

    // Counts the edges of two faces of layer 0 that do not agree after turning.
    void count(MeshReport& report) const {
        for (size_t i = 0; i < groups_.size(); ++i) {
            const auto group = groups_.group(i);
            if (group.size() != 2 || layer_[group[0] / 3] != 0) continue;
            const bool is_odd = turns_[group[0] / 3] != turns_[group[1] / 3];
            if (go_the_same_way(group[0], group[1]) == is_odd) continue;
            do_contradict(group[0], group[1]) ? ++report.contradicting_edge_count : ++report.unorientable_edge_count;
        }
    }

  private:
    static constexpr uint8_t kUnknown = 2;

    bool go_the_same_way(uint32_t h, uint32_t g) const { return start_of(mesh_.faces, h) == start_of(mesh_.faces, g); }
    bool do_contradict(uint32_t h, uint32_t g) const { return is_evident_[h / 3] && is_evident_[g / 3] && go_the_same_way(h, g); }

    void add(uint32_t face, uint8_t turn, Piece& piece) {
        turns_[face] = turn;
        piece.faces.push_back(face);
        piece.turned_count += turn;
    }

    // Breadth first from a face that stays as it is. What is evident is never turned, so evident faces come first.
    void walk(uint32_t seed, Piece& piece) {
        piece.faces.clear();
        piece.turned_count = 0;
        piece.is_closed = true;
        add(seed, 0, piece);
        for (size_t i = 0; i < piece.faces.size(); ++i) {
            const uint32_t f = piece.faces[i];
            for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
                const uint32_t g = across_[h];
                if (g == kNone) {
                    piece.is_closed = false;
                    continue;
                }
                const uint8_t wanted = turns_[f] ^ uint8_t(go_the_same_way(h, g));
                const bool may_be_so = wanted == 0 || !is_evident_[g / 3];
                if (turns_[g / 3] == kUnknown && may_be_so) add(g / 3, wanted, piece);
                piece.is_closed = piece.is_closed && turns_[g / 3] == wanted;
            }
        }
    }

    bool is_better_as_it_is(const Piece& piece) const {
        const size_t kept = piece.faces.size() - piece.turned_count;
        const bool is_undecided = 3 * std::min(kept, piece.turned_count) >= piece.faces.size();
        if (is_undecided && piece.is_closed) return volume(piece) >= 0;
        return piece.turned_count <= kept;
    }

    // Six times what the piece encloses, as it is turned now.
    double volume(const Piece& piece) const {
        const glm::dvec3 middle(corner_m(mesh_, piece.faces[0], 0));
        double sum = 0;
        for (const uint32_t f : piece.faces) {
            const glm::dvec3 a = glm::dvec3(corner_m(mesh_, f, 0)) - middle, b = glm::dvec3(corner_m(mesh_, f, 1)) - middle,
                             c = glm::dvec3(corner_m(mesh_, f, 2)) - middle;
            sum += (turns_[f] ? -1 : 1) * glm::dot(a, glm::cross(b, c));
        }
        return sum;
    }

    const Mesh& mesh_;
    std::span<const uint8_t> layer_;
    EdgeGroups groups_;
    std::vector<uint8_t> turns_, is_evident_;
    std::vector<uint32_t> across_;  // [3F] the other face's halfedge, where an edge has exactly two that do not contradict
};

}  // namespace

Orientation orient(Mesh& mesh, std::span<const uint32_t> other_side, MeshReport& report) {
    Orientation result;
    std::vector<uint8_t>& layer = result.layer;
    layer.assign(mesh.faces.size(), 0);
    for (uint32_t f = 0; f < layer.size(); ++f)
        if (other_side[f] != kNone && other_side[f] < f) layer[f] = 1, ++report.back_side_count;

    Orienter orienter(mesh, layer);
    const std::vector<uint8_t> turns = orienter.decide();
    orienter.count(report);
    bool has_turned = false;
    for (uint32_t f = 0; f < turns.size(); ++f) {
        if (!turns[f]) continue;
        has_turned = true;
        if (other_side[f] != kNone) {
            layer[f] = 1, layer[other_side[f]] = 0;
        } else {
            flip_face(mesh, f);
            ++report.flipped_face_count;
        }
    }
    result.edges = has_turned ? group_edges(mesh.faces, mesh.positions_m.size(), layer) : orienter.take_edges();
    return result;
}

}  // namespace overlook::mesh
