// The floor of the strict rule: see least_face_count.
#include <algorithm>
#include <array>
#include <tuple>

#include "tools/bake/caveclod/disjoint_sets.h"
#include "tools/bake/caveclod/position_kinds.h"

namespace overlook::caveclod {
namespace {

// A part of the surface that hangs together over edges of two faces.
struct Piece {
    int64_t face_count = 0, edge_count = 0, fan_count = 0;
    int64_t kept_count = 0, kept_on_border_count = 0;  // fans of positions that stay
    int64_t fixed_face_count = 0;
    bool is_open = false;
};

struct PieceTable {
    Corners faces;
    const MeshEdges& edges;
    const Groups& groups;
    DisjointSets pieces;
    std::vector<Piece> of;             // [F] at each piece's least face
    std::vector<uint32_t> any_corner;  // [P] one at each position that has some

    bool is_rigid(uint32_t position) const { return groups.kind[position] == PositionKind::rigid; }
    Piece& piece_at(uint32_t corner) { return of[pieces.find(face_of(corner))]; }
};

void count_faces_and_edges(PieceTable& table) {
    const MeshEdges& edges = table.edges;
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge)
        if (edges.twin[edge] != kNoTwin) table.pieces.unite(face_of(edge), face_of(edges.twin[edge]));
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge) {
        table.any_corner[value_at(table.faces, edge)] = edge;
        Piece& piece = table.piece_at(edge);
        bool is_border = edges.twin[edge] == kNoTwin;
        piece.edge_count += is_border || edge < edges.twin[edge];
        piece.is_open |= is_border;
        if (edge % 3 != 0) continue;
        const std::array<uint32_t, 3>& corners = table.faces[face_of(edge)];
        ++piece.face_count;
        piece.fixed_face_count += table.is_rigid(corners[0]) && table.is_rigid(corners[1]) && table.is_rigid(corners[2]);
    }
}

void count_fans(PieceTable& table) {
    const MeshEdges& edges = table.edges;
    DisjointSets fans(edges.twin.size());
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge)
        if (edges.twin[edge] != kNoTwin) fans.unite(edge, next_corner(edges.twin[edge]));
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge) {
        bool is_kept = table.is_rigid(value_at(table.faces, edge));
        // A fan that is no ring begins with one border edge that leaves its position.
        if (edges.twin[edge] == kNoTwin && is_kept) ++table.piece_at(edge).kept_on_border_count;
        if (fans.find(edge) != edge) continue;
        ++table.piece_at(edge).fan_count;
        table.piece_at(edge).kept_count += is_kept;
    }
}

// A boundary curve between rigid positions, or a loop without one.
struct Curve {
    uint32_t piece = 0, a = 0, b = 0;  // a <= b; a == b: it returns to where it began
    bool is_border = false, has_sharp = false;
    // Of curves between the same two, the one that costs most to lengthen comes first: it may stay an edge.
    bool operator<(const Curve& other) const {
        return std::tie(piece, a, b, has_sharp, is_border) <
               std::tie(other.piece, other.a, other.b, other.has_sharp, other.is_border);
    }
    bool has_ends_of(const Curve& other) const { return piece == other.piece && a == other.a && b == other.b; }
};

// From one sharp position along the edge to `next` as far as the next rigid one, or round to where it began. Returns where.
uint32_t walk(const Groups& groups, uint32_t from, uint32_t next, std::vector<uint8_t>& is_walked) {
    uint32_t start = from;
    while (next != start && groups.kind[next] == PositionKind::sharp) {
        is_walked[next] = 1;
        const uint32_t* ends = &groups.feature_ends[groups.feature_begin[next]];
        uint32_t after = ends[0] == from ? ends[1] : ends[0];
        from = next;
        next = after;
    }
    return next;
}

// Feature edges from one rigid position to another.
void add_single_edges(PieceTable& table, std::vector<Curve>& curves) {
    const Groups& groups = table.groups;
    for (uint32_t edge = 0; edge < table.edges.twin.size(); ++edge) {
        auto [a, b] = std::minmax({value_at(table.faces, edge), value_at(table.faces, next_corner(edge))});
        if (!table.is_rigid(a) || !table.is_rigid(b)) continue;
        auto row = groups.feature_ends.begin() + groups.feature_begin[a],
             end = groups.feature_ends.begin() + groups.feature_begin[a + 1];
        if (std::binary_search(row, end, b)) curves.push_back({table.pieces.find(face_of(edge)), a, b, false, false});
    }
}

// Loops of sharp positions alone keep three of them, at once; the other curves are returned.
std::vector<Curve> curves_of(PieceTable& table) {
    const Groups& groups = table.groups;
    std::vector<Curve> curves;
    std::vector<uint8_t> is_walked(groups.kind.size(), 0), on_border(groups.kind.size(), 0);
    for (const FeatureEdge& feature : groups.features)
        if (feature.kind == FeatureKind::border) on_border[feature.a] = on_border[feature.b] = 1;
    add_single_edges(table, curves);
    for (uint32_t position = 0; position < groups.kind.size(); ++position) {
        if (groups.kind[position] != PositionKind::sharp || is_walked[position]) continue;
        is_walked[position] = 1;
        const uint32_t* ends = &groups.feature_ends[groups.feature_begin[position]];
        uint32_t a = walk(groups, position, ends[0], is_walked), piece = face_of(table.any_corner[position]);
        piece = table.pieces.find(piece);
        if (a == position) {
            table.of[piece].kept_count += 3;
            table.of[piece].kept_on_border_count += on_border[position] ? 3 : 0;
            continue;
        }
        uint32_t b = walk(groups, position, ends[1], is_walked);
        curves.push_back({piece, std::min(a, b), std::max(a, b), on_border[position] != 0, true});
    }
    return curves;
}

void keep_curves_apart(PieceTable& table) {
    std::vector<Curve> curves = curves_of(table);
    std::sort(curves.begin(), curves.end());
    for (size_t i = 0; i < curves.size(); ++i) {
        const Curve& curve = curves[i];
        if (!curve.has_sharp) continue;
        bool is_further = i > 0 && curve.has_ends_of(curves[i - 1]);
        int64_t kept = curve.a == curve.b ? 2 : is_further ? 1 : 0;
        table.of[curve.piece].kept_count += kept;
        table.of[curve.piece].kept_on_border_count += curve.is_border ? kept : 0;
    }
}

int64_t least_face_count_of(const Piece& piece) {
    int64_t euler = piece.fan_count - piece.edge_count + piece.face_count;
    int64_t by_euler = 2 * piece.kept_count - piece.kept_on_border_count - 2 * euler;
    return std::max({by_euler, piece.fixed_face_count, std::min(piece.face_count, int64_t(piece.is_open ? 1 : 4))});
}

}  // namespace

uint64_t least_face_count(Corners faces, const MeshEdges& edges, const Groups& groups) {
    PieceTable table{faces,
                     edges,
                     groups,
                     DisjointSets(faces.size()),
                     std::vector<Piece>(faces.size()),
                     std::vector<uint32_t>(groups.kind.size(), kNoTwin)};
    count_faces_and_edges(table);
    count_fans(table);
    keep_curves_apart(table);

    int64_t sum = 0;
    for (uint32_t face = 0; face < faces.size(); ++face)
        if (table.pieces.find(face) == face) sum += least_face_count_of(table.of[face]);
    return uint64_t(sum);
}

}  // namespace overlook::caveclod
