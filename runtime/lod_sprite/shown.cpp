#include "runtime/lod_sprite/shown.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/lod_sprite/projector.h"

namespace overlook::lod_sprite {
namespace {

constexpr uint32_t kColumns = 96;
constexpr double kTorn_px = 1.5;
constexpr double kMostGrown = 4;  // times in area, beyond what coming nearer explains: a slope that has turned to the camera
constexpr double kOnAxis = 1e-9;

enum State : uint8_t { kNothing, kSky, kShown, kTorn, kBehind };

// A corner of a cell: pixels times depth, and depth; what is infinitely far only has a direction.
struct Corner {
    glm::dvec3 at{0};
    double key_depth_m = 0;
    bool is_finite = false;
    glm::dvec2 seen_px() const { return {at.x / at.z, at.y / at.z}; }
};

class Canvas {
  public:
    Canvas(const view::Camera& camera)
        : columns(kColumns),
          rows(std::max(1u, uint32_t(std::lround(double(kColumns) * camera.height_px / camera.width_px)))),
          width_px_(camera.width_px),
          height_px_(camera.height_px),
          states(size_t(columns) * rows),
          inverse_depths(states.size(), -1) {}

    void draw(const Corner& a, const Corner& b, const Corner& c, State front) {
        double determinant = glm::dot(a.at, glm::cross(b.at, c.at));
        if (determinant == 0 || std::max({a.at.z, b.at.z, c.at.z}) <= 0) return;
        State state = determinant > 0 ? front : kBehind;
        // Not divided by the determinant: what two triangles share has opposite signs in them, and no sample falls in between.
        double side = determinant > 0 ? 1 : -1;
        std::array<glm::dvec3, 3> edges = {side * glm::cross(b.at, c.at), side * glm::cross(c.at, a.at),
                                           side * glm::cross(a.at, b.at)};
        glm::dvec3 inverse = (double(a.is_finite) * edges[0] + double(b.is_finite) * edges[1] + double(c.is_finite) * edges[2]) /
                             std::abs(determinant);
        Range x{0, columns}, y{0, rows};
        if (std::min({a.at.z, b.at.z, c.at.z}) > kOnAxis) {
            glm::dvec2 pa = a.seen_px(), pb = b.seen_px(), pc = c.seen_px();
            auto [left, right] = std::minmax({pa.x, pb.x, pc.x});
            auto [low, high] = std::minmax({pa.y, pb.y, pc.y});
            x = range_of(left / width_px_ + 0.5, right / width_px_ + 0.5, columns);
            y = range_of(0.5 - high / height_px_, 0.5 - low / height_px_, rows);
        }
        for (uint32_t j = y.begin; j < y.end; ++j)
            for (uint32_t i = x.begin; i < x.end; ++i) {
                glm::dvec3 sample{((i + 0.5) / columns - 0.5) * width_px_, (0.5 - (j + 0.5) / rows) * height_px_, 1};
                if (glm::dot(edges[0], sample) < 0 || glm::dot(edges[1], sample) < 0 || glm::dot(edges[2], sample) < 0) continue;
                double inverse_depth = std::max(glm::dot(inverse, sample), 0.0);
                size_t at = size_t(j) * columns + i;
                if (inverse_depth <= inverse_depths[at]) continue;
                inverse_depths[at] = inverse_depth;
                states[at] = state == kShown && inverse_depth == 0 ? kSky : state;
            }
    }

    const uint32_t columns, rows;

  private:
    struct Range {
        uint32_t begin, end;
    };
    // The samples between two shares of the picture.
    static Range range_of(double from, double to, uint32_t count) {
        auto at = [&](double share) { return uint32_t(std::clamp(share * count, 0.0, double(count))); };
        return {at(from - 0.5 / count), std::min(count, at(to + 0.5 / count) + 1)};
    }
    double width_px_, height_px_;

  public:
    std::vector<uint8_t> states;
    std::vector<double> inverse_depths;  // 1/m; of nothing less than 0
};

// What a cell of the key's grid shows from its own side.
class Judge {
  public:
    Judge(const Key& key, const Projector& project, double most_texel_px)
        : project_(project),
          key_area_(double(key.camera.width_px) * key.camera.height_px),
          most_growth_(most_texel_px * key.scale * view::focal_px(key.camera) / project.focal_px()) {}

    // Corners from the top left, row by row; from, to: where in the key the first and the last are.
    State operator()(const std::array<Corner, 4>& corners, const glm::dvec2& from, const glm::dvec2& to) const {
        auto nearer = [](const Corner& a, const Corner& b) { return a.key_depth_m < b.key_depth_m; };
        auto [nearest, farthest] = std::minmax_element(corners.begin(), corners.end(), nearer);
        if (!nearest->is_finite) return kShown;  // sky
        bool is_step = !(farthest->key_depth_m <= kSteepest * nearest->key_depth_m);
        bool is_before = std::all_of(corners.begin(), corners.end(), [](const Corner& each) { return each.at.z > kOnAxis; });
        if (!is_before) return is_step ? kTorn : kShown;
        double growth = nearest->key_depth_m / nearest->at.z;
        if (growth > most_growth_) return kTorn;
        glm::dvec2 a = corners[0].seen_px(), b = corners[1].seen_px(), c = corners[2].seen_px(), d = corners[3].seen_px();
        double area = ((d.x - a.x) * (b.y - c.y) - (d.y - a.y) * (b.x - c.x)) / 2;
        glm::dvec2 middle = (from + to) / 2.0, size = to - from;
        double stretch = project_.stretch(middle.x, middle.y, nearest->seen_px());
        double expected = growth * growth * stretch * size.x * size.y * key_area_;
        bool is_wider = area > expected + kTorn_px * std::sqrt(expected);
        return is_wider && (is_step || area > kMostGrown * expected) ? kTorn : kShown;
    }

  private:
    const Projector& project_;
    double key_area_, most_growth_;
};

}  // namespace

Shown shown_by(const Key& key, const view::Camera& camera, double most_texel_px) {
    const DepthGrid& grid = key.depths;
    Projector project(key, camera);
    // The outermost points stand for the key's border.
    auto share_of = [](uint32_t at, uint32_t count) { return at == 0 ? 0.0 : at + 1 == count ? 1.0 : (at + 0.5) / count; };
    std::vector<Corner> corners;
    corners.reserve(grid.depth_m.size());
    for (uint32_t y = 0; y < grid.height; ++y)
        for (uint32_t x = 0; x < grid.width; ++x) {
            double depth_m = double(grid.depth_m[size_t(y) * grid.width + x]);
            glm::dvec3 at = project(share_of(x, grid.width), share_of(y, grid.height), depth_m);
            corners.push_back({{project.focal_px() * at.x, project.focal_px() * at.y, at.z}, depth_m, std::isfinite(depth_m)});
        }

    Canvas canvas(camera);
    Judge judge(key, project, most_texel_px);
    for (uint32_t y = 0; y + 1 < grid.height; ++y)
        for (uint32_t x = 0; x + 1 < grid.width; ++x) {
            const Corner* upper = &corners[size_t(y) * grid.width + x];
            const Corner* lower = upper + grid.width;
            State front = judge({upper[0], upper[1], lower[0], lower[1]}, {share_of(x, grid.width), share_of(y, grid.height)},
                                {share_of(x + 1, grid.width), share_of(y + 1, grid.height)});
            canvas.draw(upper[0], lower[0], upper[1], front);
            canvas.draw(upper[1], lower[0], lower[1], front);
        }

    Shown shown{canvas.columns, canvas.rows, {}, std::move(canvas.inverse_depths)};
    size_t surface = 0, behind = 0, nothing = 0;
    for (uint8_t state : canvas.states) {
        shown.is_open.push_back(state != kShown && state != kSky);
        surface += state == kShown;
        behind += state == kBehind;
        nothing += state == kNothing;
    }
    shown.surface_share = double(surface) / double(canvas.states.size());
    shown.behind_share = double(behind) / double(canvas.states.size());
    shown.nothing_share = double(nothing) / double(canvas.states.size());
    return shown;
}

std::vector<uint8_t> open_beside_nearer(const Shown& shown, double depth_m) {
    std::vector<uint8_t> is_open = shown.is_open;
    auto is_nearer = [&](int64_t column, int64_t row) {
        bool is_inside = column >= 0 && row >= 0 && column < shown.columns && row < shown.rows;
        return is_inside && shown.inverse_depths_per_m[size_t(row) * shown.columns + size_t(column)] * depth_m > 1;
    };
    for (int64_t row = 0; row < shown.rows; ++row)
        for (int64_t column = 0; column < shown.columns; ++column) {
            if (is_nearer(column, row)) continue;
            bool is_beside = false;
            for (int64_t i = 0; i < 9; ++i) is_beside = is_beside || is_nearer(column + i % 3 - 1, row + i / 3 - 1);
            if (is_beside) is_open[size_t(row) * shown.columns + size_t(column)] = 1;
        }
    return is_open;
}

}  // namespace overlook::lod_sprite
