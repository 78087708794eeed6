// CAVECLOD as printed: nodes, active lists, arrays of pointers, and Hoppe's legality, over the same hierarchy.
//
// B. Kram, C. Shaw, Multiple Camera Considerations in a View-Dependent Continuous Level of Detail Algorithm, 2002, sections 3.2
// and 3.4 to 3.6; what it takes from there: H. Hoppe, View-Dependent Refinement of Progressive Meshes, 1997 (legality,
// force_vsplit, the order of the traversal); D. Luebke, C. Erikson, View-Dependent Simplification of Arbitrary Polygonal
// Environments, 1997 (size on the screen). Pointers are 32-bit handles, as the paper's machine had them, so that its figures of
// memory can be held beside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "runtime/caveclod/settings.h"
#include "runtime/view/camera.h"
#include "runtime/view/pixel_error.h"

namespace overlook::caveclod::paper {

constexpr uint32_t kNone = ~0u;

// 44 bytes, as equation 1 counts them.
struct Node {
    uint32_t parent = kNone;
    uint32_t stationary = kNone, floating = kNone;  // its children; none of a leaf
    uint32_t position = 0;
    std::array<uint32_t, 2> polygons{kNone, kNone};  // left and right of the new edge, that its split adds
    // Of the left polygon across its edges from the stationary and to the floating child, then the same of the right one.
    std::array<uint32_t, 4> neighbours{kNone, kNone, kNone, kNone};
    uint32_t split = kNone;  // of the hierarchy, for its bounds
};
static_assert(sizeof(Node) == 44);

// Equation 1, term by term, in bytes.
struct Equation1 {
    uint64_t nodes = 0, polygons = 0, vertices = 0, index_array = 0;  // 44n, 12p, 32d, 2se
    uint64_t active_nodes = 0, active_polygons = 0, cameras = 0;      // 12 n_a, 36 p_a, c (4n + 4p + 16)
    uint64_t static_bytes() const { return nodes + polygons + vertices + index_array; }
    uint64_t all() const { return static_bytes() + active_nodes + active_polygons + cameras; }
};
// n nodes, p polygons, d vertices, s packed surface groups, e positions; active nodes and polygons of all cameras; c cameras.
Equation1 equation1(uint64_t n, uint64_t p, uint64_t d, uint64_t s, uint64_t e, uint64_t active_nodes, uint64_t active_polygons,
                    uint64_t cameras);

// What all cameras share. The hierarchy must outlive it.
class Mesh {
  public:
    explicit Mesh(const Hierarchy& hierarchy);

    std::span<const Node> nodes() const { return nodes_; }
    const Hierarchy& hierarchy() const { return hierarchy_; }
    // The node whose split adds a polygon; kNone for the coarsest ones.
    uint32_t creator(uint32_t polygon) const { return creator_[polygon]; }
    // The dense array's entry of a packed surface group and a position, kNone where it is empty. Where a group has several
    // vertices at a position the last one is all that the array can hold.
    uint32_t vertex(uint16_t packed, uint32_t position) const;
    uint64_t populated_count() const { return entries_.size(); }
    uint32_t packed_count() const { return packed_count_; }

  private:
    struct Entry {
        uint32_t position = 0;
        uint16_t packed = 0;
        uint32_t vertex = 0;
    };
    void enter(uint32_t face, uint32_t position, uint32_t wedge);
    void sort_entries();

    const Hierarchy& hierarchy_;
    std::vector<Node> nodes_;
    std::vector<uint32_t> creator_;
    std::vector<Entry> entries_;
    std::vector<uint32_t> entry_begin_;
    uint32_t packed_count_ = 0;
};

// What decides that a node is refined.
enum class Criterion {
    pixel_error,       // the same bound and thresholds as Refinement, so that both draw at equal error
    projected_extent,  // Luebke's: the diameter of what hangs below it, as a share of the picture's width
};
// "A 7 % error tolerance is used" (4.1): our reading is a share of the picture's width, for the projected extent.
constexpr double kPrintedTolerance = 0.07;

struct Options {
    Criterion criterion = Criterion::pixel_error;
    Settings settings;                     // of pixel_error: error_px alone; every operation is made at once
    double tolerance = kPrintedTolerance;  // of projected_extent
};

// A camera refinement data structure (3.4).
class CameraRefinement {
  public:
    explicit CameraRefinement(const Mesh& mesh);

    // Traverses the active nodes once (3.6): splits, forced where needed, and collapses where legal.
    FrameReport refine(const view::Camera& camera, const Options& options);

    uint64_t active_node_count() const { return active_node_count_; }
    uint64_t active_polygon_count() const { return active_polygon_count_; }
    // By traversing the active polygons (3.5): three vertices each, by surface identifier. A corner that the index array has
    // nothing for is counted in wrong_corner_count and takes its position's first vertex.
    void collect(std::vector<std::vector<uint32_t>>& by_surface, uint64_t& wrong_corner_count) const;
    // Does every edge belong to one polygon on either side, by the neighbours that the polygons know?
    bool is_consistent() const;

  private:
    struct ActiveNode {  // 12 bytes
        uint32_t previous = kNone, next = kNone, node = 0;
    };
    struct ActivePolygon {  // 36 bytes
        uint32_t previous = kNone, next = kNone, polygon = 0;
        std::array<uint32_t, 3> nodes{}, neighbours{};  // neighbours[k]: across the edge from corner k to the one after
    };
    static_assert(sizeof(ActiveNode) == 12 && sizeof(ActivePolygon) == 36);

    bool is_active(uint32_t polygon) const { return polygon_at_[polygon] != kNone; }
    ActivePolygon& active(uint32_t polygon) { return polygons_[polygon_at_[polygon]]; }
    const ActivePolygon& active(uint32_t polygon) const { return polygons_[polygon_at_[polygon]]; }
    static uint32_t corner_of(const ActivePolygon& polygon, uint32_t node);

    void add_node(uint32_t node);
    void remove_node(uint32_t node);
    void add_polygon(uint32_t polygon, const std::array<uint32_t, 3>& nodes, const std::array<uint32_t, 3>& neighbours);
    void remove_polygon(uint32_t polygon);
    void link_base();

    bool wants(const Options& options, const view::SphereErrorBound& bound, const view::Camera& camera, uint32_t node) const;
    bool may_split(uint32_t node) const;
    bool may_collapse(uint32_t parent) const;
    void split(uint32_t node);
    void collapse(uint32_t parent);
    void force(uint32_t node, FrameReport& report);
    void ring(uint32_t node, uint32_t polygon, std::vector<uint32_t>& polygons) const;
    uint32_t third_of(uint32_t node, bool is_right) const;
    void join(uint32_t polygon, uint32_t across, uint32_t from, uint32_t to);

    const Mesh& mesh_;
    std::vector<uint32_t> node_at_, polygon_at_;  // [n], [p]: where in the pools; kNone is a null pointer
    std::vector<ActiveNode> nodes_;
    std::vector<ActivePolygon> polygons_;
    std::vector<uint32_t> free_nodes_, free_polygons_;
    uint32_t first_node_ = kNone, first_polygon_ = kNone;
    uint64_t active_node_count_ = 0, active_polygon_count_ = 0;
    std::vector<uint32_t> ring_, moved_;
};

}  // namespace overlook::caveclod::paper
