#include "tools/bake/discrete/drawn_texels.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/images.h"

namespace overlook::discrete {
namespace {

// A rectangle of opaque texels, [left, right) x [top, bottom).
struct Block {
    int64_t left = 0, top = 0, right = 0, bottom = 0;
};

// Opaque texels within a window as few rectangles: each as wide as it can be, then as high.
std::vector<Block> blocks_of(const Mask& mask, const Block& window) {
    std::vector<Block> blocks;
    auto width = size_t(window.right - window.left);
    std::vector<uint8_t> is_taken(width * size_t(window.bottom - window.top), 0);
    auto is_free = [&](int64_t x, int64_t y) {
        return mask.at(x, y) && is_taken[size_t(y - window.top) * width + size_t(x - window.left)] == 0;
    };
    for (int64_t y = window.top; y < window.bottom; ++y)
        for (int64_t x = window.left; x < window.right; ++x) {
            if (!is_free(x, y)) continue;
            Block block{x, y, x + 1, y + 1};
            while (block.right < window.right && is_free(block.right, y)) ++block.right;
            auto is_free_row = [&](int64_t row) {
                for (int64_t at = block.left; at < block.right; ++at)
                    if (!is_free(at, row)) return false;
                return true;
            };
            while (block.bottom < window.bottom && is_free_row(block.bottom)) ++block.bottom;
            for (int64_t row = block.top; row < block.bottom; ++row)
                for (int64_t at = block.left; at < block.right; ++at)
                    is_taken[size_t(row - window.top) * width + size_t(at - window.left)] = 1;
            blocks.push_back(block);
        }
    return blocks;
}

using Polygon = std::vector<glm::dvec2>;

// What of a polygon lies left of a to b (I. Sutherland, G. Hodgman, Reentrant Polygon Clipping, 1974).
Polygon left_of(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b) {
    Polygon kept;
    auto side = [&](const glm::dvec2& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        double at_p = side(p), at_q = side(q);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p >= 0) != (at_q >= 0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return kept;
}

class Texels {
  public:
    explicit Texels(const Mask& mask, const DrawnTriangle& triangle) : triangle_(triangle) {
        for (size_t c = 0; c < 3; ++c) corners_[c] = triangle.uv[c] * glm::dvec2(mask.width, mask.height);
        glm::dvec2 u = corners_[1] - corners_[0], v = corners_[2] - corners_[0];
        twice_area_ = u.x * v.y - u.y * v.x;
    }
    bool is_flat() const { return twice_area_ == 0; }
    // Where a texel of the far border is mixed in, or the picture is repeated.
    bool is_beyond(const Mask& mask) const {
        return std::any_of(corners_.begin(), corners_.end(), [&](const glm::dvec2& at) {
            return at.x < 0.5 || at.y < 0.5 || at.x > double(mask.width) - 0.5 || at.y > double(mask.height) - 0.5;
        });
    }
    Block window() const {
        glm::dvec2 low = glm::min(glm::min(corners_[0], corners_[1]), corners_[2]),
                   high = glm::max(glm::max(corners_[0], corners_[1]), corners_[2]);
        return {int64_t(std::floor(low.x)) - 2, int64_t(std::floor(low.y)) - 2, int64_t(std::ceil(high.x)) + 2,
                int64_t(std::ceil(high.y)) + 2};
    }
    void add(const glm::dvec2& low, const glm::dvec2& high, std::vector<caveclod::Triangle>& to) const {
        Polygon polygon{low, {high.x, low.y}, high, {low.x, high.y}};
        for (size_t c = 0; c < 3 && !polygon.empty(); ++c) {
            const glm::dvec2 &a = corners_[c], &b = corners_[(c + 1) % 3];
            polygon = twice_area_ > 0 ? left_of(polygon, a, b) : left_of(polygon, b, a);
        }
        if (polygon.empty()) return;
        if (polygon.size() < 3) polygon.resize(3, polygon.back());
        for (size_t i = 1; i + 1 < polygon.size(); ++i) to.push_back({at_m(polygon[0]), at_m(polygon[i]), at_m(polygon[i + 1])});
    }

  private:
    glm::dvec3 at_m(const glm::dvec2& texel) const {
        glm::dvec2 u = corners_[1] - corners_[0], v = corners_[2] - corners_[0], p = texel - corners_[0];
        double second = (p.x * v.y - p.y * v.x) / twice_area_, third = (u.x * p.y - u.y * p.x) / twice_area_;
        return triangle_.at_m[0] + second * (triangle_.at_m[1] - triangle_.at_m[0]) +
               third * (triangle_.at_m[2] - triangle_.at_m[0]);
    }

    const DrawnTriangle& triangle_;
    std::array<glm::dvec2, 3> corners_{};  // in texels
    double twice_area_ = 0;
};

bool is_translucent(const Level& level, uint32_t first_index) {
    for (uint32_t i = first_index; i < first_index + 3; ++i)
        if (level.vertices[level.indices[i]].colour[3] != 255) return true;
    return false;
}

}  // namespace

void add_drawn(const Mask& mask, const DrawnTriangle& triangle, DrawnSets& sets) {
    double reach = mask.is_all_or_nothing ? std::sqrt(0.5) + 0.01 : 1.01;
    if (triangle.uv[0] == triangle.uv[1] && triangle.uv[0] == triangle.uv[2]) {
        glm::dvec2 at = triangle.uv[0] * glm::dvec2(mask.width, mask.height) - 0.5;
        auto x = int64_t(std::floor(at.x)), y = int64_t(std::floor(at.y));
        int opaque = mask.at(x, y) + mask.at(x + 1, y) + mask.at(x, y + 1) + mask.at(x + 1, y + 1);
        if (opaque == 4) sets.least.push_back(triangle.at_m);
        if (opaque > 0) sets.most.push_back(triangle.at_m);
        return;
    }
    Texels texels(mask, triangle);
    if (texels.is_flat() || texels.is_beyond(mask)) {
        sets.most.push_back(triangle.at_m);
        return;
    }
    Block within = texels.window();
    within = {std::max<int64_t>(within.left, 0), std::max<int64_t>(within.top, 0), std::min<int64_t>(within.right, mask.width),
              std::min<int64_t>(within.bottom, mask.height)};
    if (within.left >= within.right || within.top >= within.bottom) return;
    for (const Block& block : blocks_of(mask, within)) {
        glm::dvec2 first(double(block.left) + 0.5, double(block.top) + 0.5),
            last(double(block.right) - 0.5, double(block.bottom) - 0.5);
        texels.add(first, last, sets.least);
        texels.add(first - reach, last + reach, sets.most);
    }
}

caveclod::Distance distance_to_drawn(const std::vector<caveclod::Triangle>& thing, const DrawnSets& drawn, double gap,
                                     double floor_m, uint64_t most_steps, double enough_m) {
    using caveclod::TriangleTree;
    TriangleTree own(thing), least(drawn.least), most(drawn.most);
    auto way = [&](const TriangleTree& from, const TriangleTree& to) {
        return caveclod::one_sided_distance(from, to, gap, floor_m, most_steps, enough_m);
    };
    // What is more lies nearer: from above by the set that is less where distances are to it, by the one that is more where they
    // are from it; from below the other way round.
    return {std::max(way(own, most).least_m, way(least, own).least_m), std::max(way(own, least).most_m, way(most, own).most_m)};
}

double most_distance_to_drawn(const std::vector<caveclod::Triangle>& thing, const DrawnSets& drawn, double gap, double floor_m,
                              uint64_t most_steps) {
    caveclod::TriangleTree own(thing), least(drawn.least), most(drawn.most);
    return std::max(caveclod::one_sided_distance(own, least, gap, floor_m, most_steps).most_m,
                    caveclod::one_sided_distance(most, own, gap, floor_m, most_steps).most_m);
}

Result<std::vector<Mask>> masks_of(const Chain& chain) {
    std::vector<Mask> masks;
    for (size_t s = chain.surfaces.size() - chain.picture_count; s < chain.surfaces.size(); ++s) {
        const caveclod::Surface& surface = chain.surfaces[s];
        auto picture = picture_rgba8(surface.texture, surface.texture_bytes);
        if (!picture) return tl::unexpected(picture.error());
        Mask mask{picture->width, picture->height, {}, surface.alpha_cutoff == 0.5f};
        for (size_t i = 0; i < picture->pixels.size() / 4; ++i) {
            double opacity = picture->pixels[4 * i + 3] / 255.0 * surface.colour[3] / 255.0;
            mask.is_opaque.push_back(opacity >= double(surface.alpha_cutoff));
            mask.is_all_or_nothing = mask.is_all_or_nothing && (opacity == 0 || opacity == 1);
        }
        masks.push_back(std::move(mask));
    }
    return masks;
}

DrawnSets drawn_sets(const Chain& chain, const Level& level, uint32_t part, const std::vector<Mask>& masks) {
    DrawnSets sets;
    size_t first_picture = chain.surfaces.size() - chain.picture_count;
    for (const Draw& draw : level.draws)
        for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
            DrawnTriangle triangle;
            for (size_t c = 0; c < 3; ++c) {
                const Vertex& v = level.vertices[level.indices[i + c]];
                triangle.at_m[c] = position_m(chain, v);
                triangle.uv[c] = chain.uv_low + chain.uv_step * glm::dvec2(v.uv[0], v.uv[1]);
            }
            if (level.vertices[level.indices[i]].part != part) continue;
            if (draw.surface < first_picture) {
                sets.least.push_back(triangle.at_m), sets.most.push_back(triangle.at_m);
                continue;
            }
            size_t drawn_for_certain = sets.least.size();
            add_drawn(masks[draw.surface - first_picture], triangle, sets);
            if (is_translucent(level, i)) sets.least.resize(drawn_for_certain);
        }
    return sets;
}

}  // namespace overlook::discrete
