#include "tools/bake/caveclod/mesh_edges.h"

#include <algorithm>

#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

// An edge at the lesser of its two positions.
struct Incident {
    uint32_t far_end = 0, edge = 0;
    bool operator<(const Incident& other) const { return far_end != other.far_end ? far_end < other.far_end : edge < other.edge; }
};

struct Rows {
    std::vector<uint32_t> begin;  // [P + 1]
    std::vector<Incident> incidents;
};

Rows rows_by_lesser_end(Corners faces, uint32_t position_count) {
    uint32_t edge_count = uint32_t(faces.size() * 3);
    Rows rows{std::vector<uint32_t>(size_t(position_count) + 1, 0), std::vector<Incident>(edge_count)};
    auto ends = [&](uint32_t edge) { return std::minmax({value_at(faces, edge), value_at(faces, next_corner(edge))}); };

    for (uint32_t edge = 0; edge < edge_count; ++edge) ++rows.begin[ends(edge).first + 1];
    for (uint32_t position = 0; position < position_count; ++position) rows.begin[position + 1] += rows.begin[position];
    std::vector<uint32_t> cursor(rows.begin.begin(), rows.begin.end() - 1);
    for (uint32_t edge = 0; edge < edge_count; ++edge) {
        auto [lesser, greater] = ends(edge);
        rows.incidents[cursor[lesser]++] = {greater, edge};
    }
    return rows;
}

// All edges between two positions: two that run opposite ways are twins.
void match(std::span<const Incident> same, Corners faces, MeshEdges& edges) {
    bool is_pair = same.size() == 2 && value_at(faces, same[0].edge) != value_at(faces, same[1].edge);
    if (is_pair) {
        edges.twin[same[0].edge] = same[1].edge;
        edges.twin[same[1].edge] = same[0].edge;
    } else if (same.size() > 1) {
        for (const Incident& incident : same) edges.is_tangled[incident.edge] = 1;
    }
}

}  // namespace

MeshEdges edges_of(Corners faces, uint32_t position_count) {
    Rows rows = rows_by_lesser_end(faces, position_count);
    MeshEdges edges{std::vector<uint32_t>(faces.size() * 3, kNoTwin), std::vector<uint8_t>(faces.size() * 3, 0)};
    parallel_ranges(position_count, 1 << 14, [&](size_t first, size_t last) {
        for (size_t position = first; position < last; ++position) {
            auto row = std::span(rows.incidents).subspan(rows.begin[position], rows.begin[position + 1] - rows.begin[position]);
            std::sort(row.begin(), row.end());
            for (size_t begin = 0, end = 0; begin < row.size(); begin = end) {
                while (end < row.size() && row[end].far_end == row[begin].far_end) ++end;
                match(row.subspan(begin, end - begin), faces, edges);
            }
        }
    });
    return edges;
}

}  // namespace overlook::caveclod
