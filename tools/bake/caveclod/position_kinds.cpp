#include "tools/bake/caveclod/position_kinds.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::caveclod {
namespace {

// [P] how many fans of faces, each joined over edges between two, meet at a position: 1 where the surface is one disc or half
// disc.
std::vector<uint32_t> fan_counts(Corners faces, const MeshEdges& edges, uint32_t position_count) {
    DisjointSets fans(edges.twin.size());
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge)
        if (edges.twin[edge] != kNoTwin) fans.unite(edge, next_corner(edges.twin[edge]));
    std::vector<uint32_t> counts(position_count, 0);
    for (uint32_t corner = 0; corner < edges.twin.size(); ++corner)
        if (fans.find(corner) == corner) ++counts[value_at(faces, corner)];
    return counts;
}

// [P] 1 where repair has cut a point of the source into several positions.
std::vector<uint8_t> are_linked(std::span<const uint32_t> link, uint32_t position_count) {
    std::vector<uint8_t> linked(position_count, 0);
    if (link.empty()) return linked;
    std::vector<uint32_t> order(position_count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return link[a] != link[b] ? link[a] < link[b] : a < b; });
    for (size_t i = 1; i < order.size(); ++i)
        if (link[order[i]] == link[order[i - 1]] && link[order[i]] != mesh::kNone) linked[order[i]] = linked[order[i - 1]] = 1;
    return linked;
}

bool is_before(const FeatureEdge& a, const FeatureEdge& b) {
    return a.a != b.a ? a.a < b.a : a.b < b.b;
}

std::vector<FeatureEdge> features_of(Corners faces, const MeshEdges& edges, std::span<const uint8_t> is_smooth,
                                     std::span<const uint32_t> face_group) {
    std::vector<FeatureEdge> features;
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge) {
        uint32_t twin = edges.twin[edge];
        if (is_smooth[edge] || (twin != kNoTwin && twin < edge)) continue;
        auto [a, b] = std::minmax({value_at(faces, edge), value_at(faces, next_corner(edge))});
        FeatureKind kind = twin == kNoTwin                                          ? FeatureKind::border
                           : face_group[face_of(edge)] == face_group[face_of(twin)] ? FeatureKind::seam
                                                                                    : FeatureKind::between;
        features.push_back({a, b, kind});
    }
    std::sort(features.begin(), features.end(), is_before);
    auto is_same = [](const FeatureEdge& a, const FeatureEdge& b) { return a.a == b.a && a.b == b.b; };
    features.erase(std::unique(features.begin(), features.end(), is_same), features.end());  // edges of more than two faces
    return features;
}

void lay_feature_rows(uint32_t position_count, Groups& groups) {
    groups.feature_begin.assign(size_t(position_count) + 1, 0);
    for (const FeatureEdge& feature : groups.features) {
        ++groups.feature_begin[feature.a + 1];
        ++groups.feature_begin[feature.b + 1];
    }
    std::partial_sum(groups.feature_begin.begin(), groups.feature_begin.end(), groups.feature_begin.begin());
    groups.feature_ends.resize(groups.features.size() * 2);
    std::vector<uint32_t> cursor(groups.feature_begin.begin(), groups.feature_begin.end() - 1);
    // In the order of (a, b) the lesser ends of a row come before its greater ones, both ascending.
    for (const FeatureEdge& feature : groups.features) groups.feature_ends[cursor[feature.b]++] = feature.a;
    for (const FeatureEdge& feature : groups.features) groups.feature_ends[cursor[feature.a]++] = feature.b;
}

}  // namespace

void classify_positions(Corners faces, const MeshEdges& edges, std::span<const uint8_t> is_smooth, std::span<const uint32_t> link,
                        uint32_t position_count, Groups& groups) {
    groups.features = features_of(faces, edges, is_smooth, groups.face_group);
    lay_feature_rows(position_count, groups);

    std::vector<uint32_t> fans = fan_counts(faces, edges, position_count);
    std::vector<uint8_t> must_stay = are_linked(link, position_count);
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge)
        if (edges.is_tangled[edge]) must_stay[value_at(faces, edge)] = must_stay[value_at(faces, next_corner(edge))] = 1;

    groups.kind.assign(position_count, PositionKind::rigid);
    groups.is_fixed.assign(position_count, 0);
    for (uint32_t position = 0; position < position_count; ++position) {
        uint32_t feature_count = groups.feature_begin[position + 1] - groups.feature_begin[position];
        groups.is_fixed[position] = must_stay[position] != 0 || fans[position] != 1;
        if (groups.is_fixed[position] != 0) continue;
        if (feature_count == 0) groups.kind[position] = PositionKind::free;
        if (feature_count == 2) groups.kind[position] = PositionKind::sharp;
    }
    groups.free_count = uint64_t(std::count(groups.kind.begin(), groups.kind.end(), PositionKind::free));
    groups.sharp_count = uint64_t(std::count(groups.kind.begin(), groups.kind.end(), PositionKind::sharp));
    groups.rigid_count = groups.kind.size() - groups.free_count - groups.sharp_count;
}

Groups with_borders_alone(const Groups& groups) {
    Groups alone;
    auto is_border = [](const FeatureEdge& feature) { return feature.kind == FeatureKind::border; };
    std::copy_if(groups.features.begin(), groups.features.end(), std::back_inserter(alone.features), is_border);
    lay_feature_rows(uint32_t(groups.kind.size()), alone);
    for (size_t p = 0; p < groups.kind.size(); ++p) {
        bool is_on_border = alone.feature_begin[p + 1] > alone.feature_begin[p];
        alone.kind.push_back(groups.is_fixed[p] != 0 ? PositionKind::rigid
                             : is_on_border          ? PositionKind::sharp
                                                     : PositionKind::free);
    }
    return alone;
}

}  // namespace overlook::caveclod
