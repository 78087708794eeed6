// Neighbours made to agree on which side is outside.

#include <glm/geometric.hpp>

#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/sheets.h"

namespace overlook::mesh {
namespace {

// Across each halfedge the one of the other face, where its edge has exactly two.
std::vector<uint32_t> across_edges(const EdgeGroups& groups, size_t halfedge_count) {
    std::vector<uint32_t> across(halfedge_count, kNone);
    for (size_t i = 0; i < groups.size(); ++i) {
        const auto group = groups.group(i);
        if (group.size() != 2) continue;
        across[group[0]] = group[1];
        across[group[1]] = group[0];
    }
    return across;
}

struct Piece {
    std::vector<uint32_t> faces;
    size_t turned_count = 0;
    bool is_closed = true;
};

class Orienter {
  public:
    Orienter(const Mesh& mesh, std::span<const uint8_t> layer) : mesh_(mesh), layer_(layer), turns_(mesh.faces.size(), kUnknown) {
        const EdgeGroups groups = group_edges(mesh.faces, mesh.positions_m.size(), layer);
        across_ = across_edges(groups, 3 * mesh.faces.size());
    }

    // For each face of layer 0 whether it is to be turned.
    std::vector<uint8_t> decide() {
        Piece piece;
        for (uint32_t f = 0; f < turns_.size(); ++f) {
            if (layer_[f] != 0 || turns_[f] != kUnknown) continue;
            walk(f, piece);
            if (!is_better_as_it_is(piece))
                for (const uint32_t face : piece.faces) turns_[face] ^= 1;
        }
        for (uint8_t& turn : turns_)
            if (turn == kUnknown) turn = 0;
        return std::move(turns_);
    }

  private:
    static constexpr uint8_t kUnknown = 2;

    bool go_the_same_way(uint32_t h, uint32_t g) const { return start_of(mesh_.faces, h) == start_of(mesh_.faces, g); }

    // Breadth first from a face that stays as it is.
    void walk(uint32_t seed, Piece& piece) {
        piece.faces.assign(1, seed);
        piece.turned_count = 0;
        piece.is_closed = true;
        turns_[seed] = 0;
        for (size_t i = 0; i < piece.faces.size(); ++i) {
            const uint32_t f = piece.faces[i];
            for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
                const uint32_t g = across_[h];
                if (g == kNone) {
                    piece.is_closed = false;
                    continue;
                }
                const uint8_t wanted = turns_[f] ^ uint8_t(go_the_same_way(h, g));
                if (turns_[g / 3] == kUnknown) {
                    turns_[g / 3] = wanted;
                    piece.turned_count += wanted;
                    piece.faces.push_back(g / 3);
                }
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
    std::vector<uint8_t> turns_;
    std::vector<uint32_t> across_;
};

}  // namespace

std::vector<uint8_t> orient(Mesh& mesh, std::span<const uint32_t> other_side, MeshReport& report) {
    std::vector<uint8_t> layer(mesh.faces.size(), 0);
    for (uint32_t f = 0; f < layer.size(); ++f)
        if (other_side[f] != kNone && other_side[f] < f) layer[f] = 1, ++report.back_side_count;

    const std::vector<uint8_t> turns = Orienter(mesh, layer).decide();
    for (uint32_t f = 0; f < turns.size(); ++f) {
        if (!turns[f]) continue;
        if (other_side[f] != kNone) {
            layer[f] = 1, layer[other_side[f]] = 0;
        } else {
            flip_face(mesh, f);
            ++report.flipped_face_count;
        }
    }
    return layer;
}

}  // namespace overlook::mesh
