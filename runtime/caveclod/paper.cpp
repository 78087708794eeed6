#include "runtime/caveclod/paper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace overlook::caveclod::paper {

uint32_t CameraRefinement::corner_of(const ActivePolygon& polygon, uint32_t node) {
    for (uint32_t c = 0; c < 3; ++c)
        if (polygon.nodes[c] == node) return c;
    return kNone;
}

void CameraRefinement::add_node(uint32_t node) {
    uint32_t place = uint32_t(nodes_.size());
    if (free_nodes_.empty())
        nodes_.emplace_back();
    else
        place = free_nodes_.back(), free_nodes_.pop_back();
    nodes_[place] = {kNone, first_node_, node};
    if (first_node_ != kNone) nodes_[first_node_].previous = place;
    first_node_ = node_at_[node] = place;
    ++active_node_count_;
}

void CameraRefinement::remove_node(uint32_t node) {
    uint32_t place = node_at_[node];
    const ActiveNode& at = nodes_[place];
    (at.previous == kNone ? first_node_ : nodes_[at.previous].next) = at.next;
    if (at.next != kNone) nodes_[at.next].previous = at.previous;
    free_nodes_.push_back(place);
    node_at_[node] = kNone;
    --active_node_count_;
}

void CameraRefinement::add_polygon(uint32_t polygon, const std::array<uint32_t, 3>& nodes,
                                   const std::array<uint32_t, 3>& neighbours) {
    uint32_t place = uint32_t(polygons_.size());
    if (free_polygons_.empty())
        polygons_.emplace_back();
    else
        place = free_polygons_.back(), free_polygons_.pop_back();
    polygons_[place] = {kNone, first_polygon_, polygon, nodes, neighbours};
    if (first_polygon_ != kNone) polygons_[first_polygon_].previous = place;
    first_polygon_ = polygon_at_[polygon] = place;
    ++active_polygon_count_;
}

void CameraRefinement::remove_polygon(uint32_t polygon) {
    uint32_t place = polygon_at_[polygon];
    const ActivePolygon& at = polygons_[place];
    (at.previous == kNone ? first_polygon_ : polygons_[at.previous].next) = at.next;
    if (at.next != kNone) polygons_[at.next].previous = at.previous;
    free_polygons_.push_back(place);
    polygon_at_[polygon] = kNone;
    --active_polygon_count_;
}

CameraRefinement::CameraRefinement(const Mesh& mesh)
    : mesh_(mesh), node_at_(mesh.nodes().size(), kNone), polygon_at_(mesh.hierarchy().face_positions.size(), kNone) {
    for (uint32_t node = 0; node < mesh.hierarchy().base_position_count; ++node) add_node(node);
    link_base();
}

void CameraRefinement::link_base() {
    const Hierarchy& h = mesh_.hierarchy();
    std::unordered_map<uint64_t, uint32_t> edges;
    auto key = [](uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; };
    for (uint32_t face = 0; face < h.base_face_count; ++face)
        for (size_t c = 0; c < 3; ++c) edges.emplace(key(h.face_positions[face][c], h.face_positions[face][(c + 1) % 3]), face);
    for (uint32_t face = 0; face < h.base_face_count; ++face) {
        std::array<uint32_t, 3> neighbours{};
        for (size_t c = 0; c < 3; ++c) {
            auto found = edges.find(key(h.face_positions[face][(c + 1) % 3], h.face_positions[face][c]));
            neighbours[c] = found == edges.end() ? kNone : found->second;
        }
        add_polygon(face, h.face_positions[face], neighbours);
    }
}

// The sphere of a node's split in view, and its error or extent above the tolerance.
bool CameraRefinement::wants(const Options& options, const view::SphereErrorBound& bound, const view::Camera& camera,
                             uint32_t node) const {
    const Hierarchy& h = mesh_.hierarchy();
    uint32_t i = mesh_.nodes()[node].split;
    if (i == kNone) return false;
    double radius_m = h.radius_m[i];
    glm::dvec3 from_eye = h.origin_m + glm::dvec3(h.positions_m[h.owner[i]]) - camera.position_m;
    view::SphereErrorBound::Place place = bound.place_of(from_eye);
    double half_y = camera.fov_y_deg * std::numbers::pi / 360;
    double half_x = std::atan(std::tan(half_y) * camera.width_px / camera.height_px);
    if (std::abs(place.right) * std::cos(half_x) - place.forward * std::sin(half_x) > radius_m) return false;
    if (std::abs(place.up) * std::cos(half_y) - place.forward * std::sin(half_y) > radius_m) return false;
    if (options.criterion == Criterion::pixel_error) return bound(place, radius_m, h.error_m[i]) > options.settings.error_px;
    double distance_m = glm::length(from_eye) - radius_m;
    return distance_m <= camera.near_m ||
           2 * radius_m * view::focal_px(camera) > options.tolerance * camera.width_px * distance_m;
}

// The node at the third corner of the polygon that a split of `node` adds on a side; kNone if the neighbours do not agree on one.
uint32_t CameraRefinement::third_of(uint32_t node, bool is_right) const {
    const Node& at = mesh_.nodes()[node];
    uint32_t third = kNone;
    for (uint32_t k = 0; k < 2; ++k) {
        uint32_t neighbour = at.neighbours[k + (is_right ? 2 : 0)];
        if (neighbour == kNone) continue;
        const ActivePolygon& polygon = active(neighbour);
        uint32_t corner = corner_of(polygon, node);
        if (corner == kNone) return kNone;
        // The left polygon's first neighbour goes from the node to the third, its second back; the right one's the other way.
        uint32_t found = polygon.nodes[(corner + ((k == 0) != is_right ? 1 : 2)) % 3];
        if (third != kNone && third != found) return kNone;
        third = found;
    }
    return third;
}

bool CameraRefinement::may_split(uint32_t node) const {
    const Node& at = mesh_.nodes()[node];
    if (at.split == kNone || node_at_[node] == kNone || (at.polygons[0] == kNone && at.polygons[1] == kNone)) return false;
    for (uint32_t neighbour : at.neighbours)
        if (neighbour != kNone && !is_active(neighbour)) return false;
    for (bool is_right : {false, true})
        if (at.polygons[is_right ? 1 : 0] != kNone && third_of(node, is_right) == kNone) return false;
    return true;
}

// All polygons round a node, from one of them.
void CameraRefinement::ring(uint32_t node, uint32_t polygon, std::vector<uint32_t>& polygons) const {
    polygons.clear();
    uint32_t at = polygon;
    do {  // counter-clockwise: across the edge that comes to the node
        polygons.push_back(at);
        at = active(at).neighbours[(corner_of(active(at), node) + 2) % 3];
    } while (at != kNone && at != polygon);
    if (at == polygon) return;
    for (at = active(polygon).neighbours[corner_of(active(polygon), node)]; at != kNone;
         at = active(at).neighbours[corner_of(active(at), node)])
        polygons.push_back(at);
}

// `across` becomes the neighbour of a polygon over its edge between two nodes.
void CameraRefinement::join(uint32_t polygon, uint32_t across, uint32_t from, uint32_t to) {
    if (polygon == kNone) return;
    ActivePolygon& at = active(polygon);
    for (size_t c = 0; c < 3; ++c)
        if (at.nodes[c] == from && at.nodes[(c + 1) % 3] == to) at.neighbours[c] = across;
}

void CameraRefinement::split(uint32_t node) {
    const Node& at = mesh_.nodes()[node];
    auto [left, right] = at.polygons;
    uint32_t vt = at.stationary, vu = at.floating;
    uint32_t vl = left != kNone ? third_of(node, false) : kNone, vr = right != kNone ? third_of(node, true) : kNone;
    uint32_t any = *std::find_if(at.neighbours.begin(), at.neighbours.end(), [](uint32_t n) { return n != kNone; });
    ring(node, any, ring_);
    // Those between the second neighbours go to the floating child: counter-clockwise from the right one to the left one.
    moved_.clear();
    uint32_t begin = at.neighbours[3], end = at.neighbours[1];
    if (begin != kNone) {
        for (uint32_t p = begin; p != kNone; p = active(p).neighbours[(corner_of(active(p), node) + 2) % 3]) {
            moved_.push_back(p);
            if (p == end) break;
        }
    } else if (end != kNone) {
        for (uint32_t p = end; p != kNone; p = active(p).neighbours[corner_of(active(p), node)]) moved_.push_back(p);
    }
    for (uint32_t p : ring_) active(p).nodes[corner_of(active(p), node)] = vt;
    for (uint32_t p : moved_) active(p).nodes[corner_of(active(p), vt)] = vu;
    if (left != kNone) {
        add_polygon(left, {vt, vu, vl}, {right, at.neighbours[1], at.neighbours[0]});
        join(at.neighbours[0], left, vt, vl), join(at.neighbours[1], left, vl, vu);
    }
    if (right != kNone) {
        add_polygon(right, {vt, vr, vu}, {at.neighbours[2], at.neighbours[3], left});
        join(at.neighbours[2], right, vr, vt), join(at.neighbours[3], right, vu, vr);
    }
    remove_node(node);
    add_node(vt), add_node(vu);
}

bool CameraRefinement::may_collapse(uint32_t parent) const {
    const Node& at = mesh_.nodes()[parent];
    if (node_at_[at.stationary] == kNone || node_at_[at.floating] == kNone) return false;
    for (uint32_t side = 0; side < 2; ++side) {
        uint32_t polygon = at.polygons[side];
        if (polygon == kNone) continue;
        if (!is_active(polygon)) return false;
        const ActivePolygon& own = active(polygon);
        uint32_t corner = corner_of(own, at.stationary);
        if (corner == kNone || corner_of(own, at.floating) == kNone) return false;
        // As split() made them: the left polygon's edges come to the stationary child last, the right one's first.
        uint32_t first = own.neighbours[(corner + (side == 0 ? 2 : 0)) % 3], second = own.neighbours[(corner + 1) % 3];
        if (first != at.neighbours[2 * side] || second != at.neighbours[2 * side + 1]) return false;
    }
    return at.polygons[0] != kNone || at.polygons[1] != kNone;
}

void CameraRefinement::collapse(uint32_t parent) {
    const Node& at = mesh_.nodes()[parent];
    uint32_t vt = at.stationary, vu = at.floating, any = at.polygons[0] != kNone ? at.polygons[0] : at.polygons[1];
    ring(vt, any, ring_);
    ring(vu, any, moved_);
    for (uint32_t p : ring_) active(p).nodes[corner_of(active(p), vt)] = parent;
    for (uint32_t p : moved_)
        if (uint32_t corner = corner_of(active(p), vu); corner != kNone) active(p).nodes[corner] = parent;
    for (uint32_t side = 0; side < 2; ++side) {
        if (at.polygons[side] == kNone) continue;
        for (uint32_t k = 0; k < 2; ++k) {
            uint32_t neighbour = at.neighbours[2 * side + k], other = at.neighbours[2 * side + 1 - k];
            if (neighbour == kNone) continue;
            for (uint32_t& across : active(neighbour).neighbours)
                if (across == at.polygons[side]) across = other;
        }
        remove_polygon(at.polygons[side]);
    }
    remove_node(vt), remove_node(vu);
    add_node(parent);
}

// Hoppe's force_vsplit. A node whose neighbours have come to disagree is left.
void CameraRefinement::force(uint32_t node, FrameReport& report) {
    std::vector<uint32_t> stack{node};
    uint64_t steps_left = 64 + 16 * uint64_t(mesh_.nodes().size());
    while (!stack.empty() && steps_left-- > 0) {
        uint32_t v = stack.back();
        const Node& at = mesh_.nodes()[v];
        bool is_split = at.split != kNone && (at.polygons[0] == kNone || is_active(at.polygons[0])) &&
                        (at.polygons[1] == kNone || is_active(at.polygons[1])) && node_at_[v] == kNone;
        if (is_split || at.split == kNone) {
            stack.pop_back();
        } else if (node_at_[v] == kNone) {
            if (at.parent == kNone) return;
            stack.push_back(at.parent);
        } else if (may_split(v)) {
            stack.pop_back();
            split(v);
            ++report.split_count;
            report.forced_count += v != node;
        } else {
            size_t size = stack.size();
            for (uint32_t neighbour : at.neighbours)
                if (neighbour != kNone && !is_active(neighbour)) stack.push_back(mesh_.creator(neighbour));
            if (stack.size() == size || stack.back() == kNone) return;
        }
    }
}

FrameReport CameraRefinement::refine(const view::Camera& camera, const Options& options) {
    FrameReport report;
    view::SphereErrorBound bound(camera);
    // Nodes that come into the list while it is traversed stand at its head: they are looked at in the next frame, as printed.
    std::vector<uint32_t> traversed;
    for (uint32_t place = first_node_; place != kNone; place = nodes_[place].next) traversed.push_back(nodes_[place].node);
    for (uint32_t node : traversed) {
        if (node_at_[node] == kNone) continue;
        ++report.evaluated_count;
        uint32_t parent = mesh_.nodes()[node].parent;
        if (wants(options, bound, camera, node)) {
            force(node, report);
        } else if (parent != kNone && may_collapse(parent) && !wants(options, bound, camera, parent)) {
            collapse(parent);
            ++report.collapse_count;
        }
    }
    report.triangle_count = active_polygon_count_;
    report.is_settled = report.split_count + report.collapse_count == 0;
    return report;
}

void CameraRefinement::collect(std::vector<std::vector<uint32_t>>& by_surface, uint64_t& wrong_corner_count) const {
    const Hierarchy& h = mesh_.hierarchy();
    by_surface.assign(h.surfaces.size(), {});
    wrong_corner_count = 0;
    for (uint32_t place = first_polygon_; place != kNone; place = polygons_[place].next) {
        const ActivePolygon& polygon = polygons_[place];
        uint32_t group = h.face_group[polygon.polygon];
        std::vector<uint32_t>& indices = by_surface[h.group_surface[group]];
        for (uint32_t node : polygon.nodes) {
            uint32_t position = mesh_.nodes()[node].position, vertex = mesh_.vertex(h.group_packed[group], position);
            if (vertex == kNone) ++wrong_corner_count, vertex = h.vertex_begin[position];
            indices.push_back(vertex);
        }
    }
}

bool CameraRefinement::is_consistent() const {
    for (uint32_t place = first_polygon_; place != kNone; place = polygons_[place].next) {
        const ActivePolygon& own = polygons_[place];
        for (uint32_t c = 0; c < 3; ++c) {
            if (node_at_[own.nodes[c]] == kNone) return false;
            uint32_t across = own.neighbours[c];
            if (across == kNone) continue;
            if (!is_active(across)) return false;
            const ActivePolygon& other = active(across);
            uint32_t at = corner_of(other, own.nodes[(c + 1) % 3]);
            if (at == kNone || other.nodes[(at + 1) % 3] != own.nodes[c] || other.neighbours[at] != own.polygon) return false;
        }
    }
    return true;
}

}  // namespace overlook::caveclod::paper
