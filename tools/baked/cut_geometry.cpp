#include "tools/baked/cut_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace overlook::terrain {
namespace {

constexpr size_t kWorstKept = 10;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Beyond what double arithmetic on heights up to 10,000 km can round away.
constexpr double kRounding_m = 1e-7;

// Twice the signed area of a, b, c.
int64_t turn(RasterPoint a, RasterPoint b, RasterPoint c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Calls visit(point) for the samples in a triangle's bounding box.
template <class Visit>
void visit_box(const std::array<RasterPoint, 3>& p, const Visit& visit) {
    auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int64_t y = low_y; y <= high_y; ++y)
        for (int64_t x = low_x; x <= high_x; ++x) visit(RasterPoint{x, y});
}

// Does the triangle cover the point, borders shared so that of two triangles on an edge exactly one does?
bool covers_half_open(const std::array<RasterPoint, 3>& p, RasterPoint q) {
    int64_t sign = turn(p[0], p[1], p[2]) > 0 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
        RasterPoint a = p[size_t(i)], b = p[size_t((i + 1) % 3)];
        if (sign < 0) std::swap(a, b);
        int64_t side = turn(a, b, q);
        bool owns_border = b.y > a.y || (b.y == a.y && b.x < a.x);
        if (side < 0 || (side == 0 && !owns_border)) return false;
    }
    return true;
}

// How often each finest cell triangle is covered, by its centroid. Cell (i, j) is cut from north-west to south-east if i + j is
// even, else from south-west to north-east; triangle 0 is the one on the north side.
class CellCover {
  public:
    explicit CellCover(const Terrain& terrain)
        : terrain_(terrain), columns_(terrain.shape.width - 1), counts_(size_t(columns_) * (terrain.shape.height - 1) * 2) {}

    // Scaled by 3 the centroids are whole: of cell (i, j) at (3i + 1 or 2, 3j + 1 or 2).
    void add(const std::array<RasterPoint, 3>& p) {
        std::array<RasterPoint, 3> scaled;
        for (size_t k = 0; k < 3; ++k) scaled[k] = {3 * p[k].x, 3 * p[k].y};
        auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
        auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
        for (int64_t j = low_y; j < high_y; ++j)
            for (int64_t i = low_x; i < high_x; ++i)
                for (int side = 0; side < 2; ++side)
                    if (covers_half_open(scaled, centroid(i, j, side))) ++counts_[index(i, j, side)];
    }

    uint64_t wrong_count() const {
        uint64_t wrong = 0;
        for (int64_t j = 0; j + 1 < int64_t(terrain_.shape.height); ++j)
            for (int64_t i = 0; i < int64_t(columns_); ++i)
                for (int side = 0; side < 2; ++side) wrong += counts_[index(i, j, side)] != (is_valid(i, j, side) ? 1 : 0);
        return wrong;
    }

    // The corners of a finest cell triangle.
    static std::array<RasterPoint, 3> corners(int64_t i, int64_t j, int side) {
        RasterPoint nw{i, j}, ne{i + 1, j}, sw{i, j + 1}, se{i + 1, j + 1};
        if (((i + j) & 1) == 0) return side == 0 ? std::array{nw, ne, se} : std::array{nw, se, sw};
        return side == 0 ? std::array{nw, ne, sw} : std::array{ne, se, sw};
    }

    bool is_valid(int64_t i, int64_t j, int side) const {
        for (RasterPoint p : corners(i, j, side))
            if (terrain_.is_void(uint32_t(p.x), uint32_t(p.y))) return false;
        return true;
    }

  private:
    static RasterPoint centroid(int64_t i, int64_t j, int side) {
        std::array<RasterPoint, 3> p = corners(i, j, side);
        return {p[0].x + p[1].x + p[2].x, p[0].y + p[1].y + p[2].y};
    }
    size_t index(int64_t i, int64_t j, int side) const { return (size_t(j) * columns_ + size_t(i)) * 2 + size_t(side); }

    const Terrain& terrain_;
    uint32_t columns_;
    std::vector<uint8_t> counts_;
};

// Edges as sortable numbers: from the lower to the higher sample; the last bit tells on which side its triangle lies.
struct Edge {
    uint64_t ends;
    bool is_forward;
};

bool is_on_border(const Terrain& terrain, RasterPoint a, RasterPoint b) {
    int64_t last_x = terrain.shape.width - 1, last_y = terrain.shape.height - 1;
    return (a.x == b.x && (a.x == 0 || a.x == last_x)) || (a.y == b.y && (a.y == 0 || a.y == last_y));
}

// Is the edge a side of a finest cell triangle that has a void corner?
bool is_on_void_rim(const Terrain& terrain, const CellCover& cells, RasterPoint a, RasterPoint b) {
    auto [low_x, high_x] = std::minmax(a.x, b.x);
    auto [low_y, high_y] = std::minmax(a.y, b.y);
    if (high_x - low_x > 1 || high_y - low_y > 1) return false;
    auto is_corner = [](const std::array<RasterPoint, 3>& p, RasterPoint q) {
        return std::any_of(p.begin(), p.end(), [&](RasterPoint r) { return r.x == q.x && r.y == q.y; });
    };
    for (int64_t j = std::max<int64_t>(0, low_y - 1); j <= std::min<int64_t>(high_y, int64_t(terrain.shape.height) - 2); ++j)
        for (int64_t i = std::max<int64_t>(0, low_x - 1); i <= std::min<int64_t>(high_x, int64_t(terrain.shape.width) - 2); ++i)
            for (int side = 0; side < 2; ++side) {
                std::array<RasterPoint, 3> p = CellCover::corners(i, j, side);
                if (is_corner(p, a) && is_corner(p, b) && !cells.is_valid(i, j, side)) return true;
            }
    return false;
}

void check_edges(const Terrain& terrain, const CellCover& cells, std::span<const uint32_t> indices, CutReport& report) {
    std::vector<Edge> edges;
    edges.reserve(indices.size());
    for (size_t i = 0; i < indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            uint32_t a = indices[i + k], b = indices[i + (k + 1) % 3];
            edges.push_back({uint64_t(std::min(a, b)) << 32 | std::max(a, b), a < b});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
    auto point = [&](uint64_t index) {
        return RasterPoint{int64_t(index % terrain.shape.width), int64_t(index / terrain.shape.width)};
    };
    for (size_t i = 0; i < edges.size();) {
        size_t end = i, forward = 0;
        for (; end < edges.size() && edges[end].ends == edges[i].ends; ++end) forward += edges[end].is_forward;
        RasterPoint a = point(edges[i].ends >> 32), b = point(edges[i].ends & 0xffffffffu);
        if (end - i > 2 || (end - i == 2 && forward != 1)) ++report.overused_edges;
        if (end - i == 1 && !is_on_border(terrain, a, b) && !is_on_void_rim(terrain, cells, a, b)) ++report.open_interior_edges;
        i = end;
    }
}

}  // namespace

void Places::add(Place place) {
    ++count_;
    auto excess = [](const Place& p) { return p.measured_m - p.promised_m; };
    auto at = std::find_if(worst_.begin(), worst_.end(), [&](const Place& p) { return excess(p) < excess(place); });
    worst_.insert(at, std::move(place));
    if (worst_.size() > kWorstKept) worst_.pop_back();
}

void Places::join(const Places& other) {
    uint64_t others_not_kept = other.count_ - other.worst_.size();
    for (const Place& place : other.worst_) add(place);
    count_ += others_not_kept;
}

Place triangle_deviation(const Source& source, const RasterPoint corners[3], const double heights_m[3]) {
    std::array<RasterPoint, 3> p{corners[0], corners[1], corners[2]};
    int64_t area = turn(p[0], p[1], p[2]);
    int64_t sign = area > 0 ? 1 : -1;
    Place worst;
    worst.measured_m = -1;
    visit_box(p, [&](RasterPoint q) {
        int64_t a = sign * turn(p[1], p[2], q), b = sign * turn(p[2], p[0], q), c = sign * turn(p[0], p[1], q);
        if (a < 0 || b < 0 || c < 0) return;
        double z = (double(a) * heights_m[0] + double(b) * heights_m[1] + double(c) * heights_m[2]) / double(sign * area);
        double there = source.at(uint32_t(q.x), uint32_t(q.y)), deviation = std::isnan(there) ? kInfinite : std::abs(z - there);
        if (deviation > worst.measured_m)
            worst = {uint32_t(q.x), uint32_t(q.y), deviation, 0, std::isnan(there) ? "covers a void" : "is too far"};
    });
    return worst;
}

CutReport check_cut(const Terrain& terrain, const Source& source, std::span<const uint32_t> indices, double tolerance_m) {
    CutReport report;
    report.triangle_count = indices.size() / 3;
    uint32_t width = terrain.shape.width;
    std::vector<uint8_t> is_covered(source.heights_m.size(), 0);
    CellCover cells(terrain);
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::array<RasterPoint, 3> p;
        double heights_m[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = {indices[i + k] % width, indices[i + k] / width};
            heights_m[k] = terrain.height_m(uint32_t(p[k].x), uint32_t(p[k].y));
        }
        Place worst = triangle_deviation(source, p.data(), heights_m);
        report.greatest_deviation_m = std::max(report.greatest_deviation_m, worst.measured_m);
        worst.promised_m = std::max(tolerance_m, terrain.finest_error_m);
        if (worst.measured_m > worst.promised_m + kRounding_m) report.places.add(worst);
        int64_t sign = turn(p[0], p[1], p[2]) > 0 ? 1 : -1;
        visit_box(p, [&](RasterPoint q) {
            if (sign * turn(p[0], p[1], q) >= 0 && sign * turn(p[1], p[2], q) >= 0 && sign * turn(p[2], p[0], q) >= 0)
                is_covered[size_t(q.y) * width + size_t(q.x)] = 1;
        });
        cells.add(p);
    }
    for (size_t i = 0; i < is_covered.size(); ++i) {
        report.covered_samples += is_covered[i];
        report.uncovered_valid_samples += !is_covered[i] && !std::isnan(source.heights_m[i]);
    }
    report.wrongly_covered_cells = cells.wrong_count();
    check_edges(terrain, cells, indices, report);
    return report;
}

}  // namespace overlook::terrain
