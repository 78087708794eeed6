#include <algorithm>
#include <cmath>

#include "runtime/view/box_error.h"
#include "runtime/view/pixel_error.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

// The quarters of a square cut in its middle, from the one farthest behind the two cuts to the one the eye is over: 0 or 1
// east and north.
std::array<std::pair<int, int>, 4> quarters_towards(const glm::dvec2& eye, const glm::dvec2& middle) {
    int near_x = eye.x >= middle.x, near_y = eye.y >= middle.y;
    return {{{1 - near_x, 1 - near_y}, {1 - near_x, near_y}, {near_x, 1 - near_y}, {near_x, near_y}}};
}

// 0 inside.
double distance_to(const Rect& rect, const glm::dvec2& at_m) {
    return glm::length(at_m - glm::clamp(at_m, rect.low_m, rect.high_m));
}

int64_t tile_below(double at_tiles) {
    return int64_t(std::floor(at_tiles));
}

}  // namespace

// Through the tree of blocks, whose cuts are vertical: all that is behind a cut is drawn before all that is before it.
class FieldWalk {
  public:
    FieldWalk(const Field& field, const view::Camera& camera, FieldList& list)
        : field_(field),
          images_(*field.parts_.images),
          placement_(*field.parts_.placement),
          list_(list),
          bound_(camera),
          sides_(view::sides_of(camera)),
          forward_(view::axes_of(camera).forward),
          eye_m_(camera.position_m),
          near_m_(camera.near_m),
          focal_px_(view::focal_px(camera)),
          secant_(view::corner_secant(camera)) {}

    void run() {
        double tile_m = images_.tile_m;
        const Rect& extent = placement_.ground().extent();
        glm::dvec2 eye(eye_m_), low = glm::max(extent.low_m, eye - field_.reach_m_) / tile_m;
        glm::dvec2 high = glm::min(extent.high_m, eye + field_.reach_m_) / tile_m;
        if (!(low.x < high.x && low.y < high.y)) return;
        int64_t left = tile_below(low.x), right = tile_below(high.x), bottom = tile_below(low.y), top = tile_below(high.y);
        uint8_t log2 = 0;
        while ((int64_t(1) << log2) <= std::max(right - left, top - bottom)) ++log2;
        // So that there are two roots each way at most.
        glm::dvec2 cut = placement_.rect_of((right >> log2) << log2, (top >> log2) << log2).low_m;
        for (auto [x, y] : quarters_towards(eye, cut)) {
            int64_t i = (right >> log2) - 1 + x, j = (top >> log2) - 1 + y;
            if (i >= left >> log2 && j >= bottom >> log2) visit(i * (int64_t(1) << log2), j * (int64_t(1) << log2), log2);
        }
    }

  private:
    void visit(int64_t i, int64_t j, uint8_t log2) {
        int64_t tiles = int64_t(1) << log2;
        Rect rect = placement_.rect_of(i, j, tiles);
        (log2 == 0 ? list_.counts.tiles_tested : list_.counts.blocks_tested)++;
        double ground_m = distance_to(rect, glm::dvec2(eye_m_));
        if (ground_m >= field_.reach_m_) return;
        GroundRange bound = placement_.ground().bound(rect);
        if (bound.is_empty() || !is_in_sight(rect, bound)) return;
        Placement::Coverage coverage = placement_.coverage(rect);
        if (log2 == 0) return visit_tile(i, j, rect, coverage);
        if (coverage == Placement::Coverage::none) return;
        double near_m = field_.distance_m({ground_m, 0}, eye_m_.z - bound.high_m);
        if (near_m >= field_.blocks_from_m_ && double(tiles) * images_.tile_m <= field_.options_.block_share * near_m)
            return list_block(i, j, log2, rect, bound, coverage, near_m);
        int64_t half = tiles / 2;
        for (auto [x, y] : quarters_towards(glm::dvec2(eye_m_), (rect.low_m + rect.high_m) / 2.0))
            visit(i + x * half, j + y * half, uint8_t(log2 - 1));
    }

    // Whether some of a rectangle with what is planted on it may be: a box behind one of the sides is not. Geometry reaches over
    // its edges, images do not.
    bool is_in_sight(const Rect& rect, const GroundRange& ground) const {
        double over_m = field_.has_geometry_ ? field_.parts_.overhang_m : 0;
        glm::dvec3 low = glm::dvec3(rect.low_m - over_m, ground.low_m + images_.low_m) - eye_m_;
        glm::dvec3 high = glm::dvec3(rect.high_m + over_m, ground.high_m + images_.high_m) - eye_m_;
        auto farthest = [&](const glm::dvec3& along) {
            return std::max(along.x * low.x, along.x * high.x) + std::max(along.y * low.y, along.y * high.y) +
                   std::max(along.z * low.z, along.z * high.z);
        };
        for (const glm::dvec3& side : sides_)
            if (farthest(side) < 0) return false;
        return farthest(forward_) >= near_m_;
    }

    void visit_tile(int64_t i, int64_t j, const Rect& rect, Placement::Coverage coverage) {
        Verdict verdict = coverage == Placement::Coverage::all ? Verdict::planted : placement_.verdict(i, j);
        ++list_.counts.tiles_by_verdict[size_t(verdict)];
        if (verdict != Verdict::planted) return;
        Item item;
        item.i = i, item.j = j, item.tile = field_.parts_.tiling->at(i, j);
        const TileSet& set = *field_.parts_.set;
        auto corners = corners_of(set, set.tiles[item.tile]);
        if (std::all_of(corners.begin(), corners.end(), [&](uint8_t c) { return set.corner_density[c] == 0; })) {
            ++list_.counts.bare_tiles;
            return;
        }
        GroundRange range = placement_.ground().range(rect);
        double above_m = eye_m_.z - placement_.ground().height_m((rect.low_m + rect.high_m) / 2.0);
        item.context = images_.context_count == 2 && placement_.is_at_edge(i, j);
        if (!show(item, rect, range, above_m)) return;
        ++list_.counts.tiles_listed;
        list_.items.push_back(item);
    }

    void list_block(int64_t i, int64_t j, uint8_t log2, const Rect& rect, const GroundRange& bound, Placement::Coverage coverage,
                    double near_m) {
        Item item;
        item.i = i, item.j = j, item.tiles_log2 = log2;
        item.is_planted_throughout = coverage == Placement::Coverage::all;
        item.low_m = bound.low_m + images_.low_m, item.high_m = bound.high_m + images_.high_m;
        glm::dvec2 eye(eye_m_), middle = (rect.low_m + rect.high_m) / 2.0;
        item.distance_m = field_.distance_m(eye - middle, eye_m_.z - bound.high_m);
        glm::dvec2 farthest = glm::max(glm::abs(rect.low_m - eye), glm::abs(rect.high_m - eye));
        uint32_t first = rungs_at(field_.ladder_, near_m).first;
        item.last_rung = rungs_at(field_.ladder_, field_.distance_m(farthest, eye_m_.z - bound.low_m)).second;
        if (field_.ladder_.rungs[item.last_rung].stage == Stage::bare) --item.last_rung;
        const Rung& finest = field_.ladder_.rungs[first];
        if (finest.stage == Stage::bare) return;
        item.texels_px = uint32_t(std::max(1.0, std::ldexp(field_.texels_of(finest), log2)));
        list_.counts.texels += uint64_t(item.texels_px) * item.texels_px;
        ++list_.counts.blocks_listed;
        list_.items.push_back(item);
    }

    // Chooses rungs and directions by the tile's middle; whether anything is shown.
    bool show(Item& item, const Rect& rect, const GroundRange& range, double eye_above_m) {
        glm::dvec2 eye_from_middle = glm::dvec2(eye_m_) - (rect.low_m + rect.high_m) / 2.0;
        Chosen chosen = field_.chosen(eye_from_middle, eye_above_m);
        item.distance_m = chosen.distance_m;
        item.low_m = range.low_m + images_.low_m, item.high_m = range.high_m + images_.high_m;
        bool is_upright = field_.ladder_.rungs[chosen.rungs.first].stage <= Stage::ldi;  // not textures alone
        if (is_upright) shear(item, rect);
        if (item.distance_m < field_.images_to_m_) {
            double within_m = field_.farthest_within_m(permitted_m(item, rect), steepest(list_.halves_of(item)));
            chosen.rungs = rungs_at(field_.ladder_, std::min(item.distance_m, within_m));
        }
        item.first_shown = uint32_t(list_.shown.size());
        const Mix &rungs = chosen.rungs, &directions = chosen.directions;
        auto [by_first, by_second] = thresholds_of(rungs);
        show_rung(item, rungs.first, by_first, directions);
        if (rungs.second != rungs.first) show_rung(item, rungs.second, by_second, directions);
        item.shown_count = uint32_t(list_.shown.size()) - item.first_shown;
        if (is_upright) judge(item, rect);
        return item.shown_count > 0;
    }

    // Geometry gives way only to images that are whole already, since what is left out of it and what is not yet of them are not
    // the same places.
    std::pair<Thresholds, Thresholds> thresholds_of(const Mix& rungs) const {
        bool is_of_geometry = field_.ladder_.rungs[rungs.first].stage == Stage::geometry;
        if (!is_of_geometry || rungs.second == rungs.first) return {first_of(rungs), second_of(rungs)};
        uint32_t image = std::min(kWhole, 2 * rungs.second_share), geometry = std::min(kWhole, 2 * (kWhole - rungs.second_share));
        return {{0, geometry}, {kWhole - image, kWhole}};
    }

    // How far samples may stand from their surfaces, in metres. Where tiles are cut, an even part is kept back of what their ground
    // may stand off, so that nothing changes at once where one is cut in more pieces.
    double permitted_m(const Item& item, const Rect& rect) const {
        const FieldOptions& options = field_.options_;
        if (std::isinf(options.error_px)) return INFINITY;
        double all_m = bound_.metres(bound_.of({rect.low_m, item.low_m}, {rect.high_m, item.high_m}), options.error_px);
        bool is_cut = item.displacement_m > 0 && std::isfinite(options.displacement_px);
        double kept_m = is_cut ? all_m * std::min(1.0, options.displacement_px / options.error_px) : 0;
        return all_m - std::max(item.displacement_m, kept_m);
    }

    void show_rung(Item& item, uint32_t index, Thresholds by_rung, const Mix& directions) {
        const Rung& rung = field_.ladder_.rungs[index];
        if (rung.stage == Stage::bare) return;
        if (rung.stage == Stage::geometry) return list_.shown.push_back({index, 0, by_rung, {}});
        add_shown(item, {index, directions.first, by_rung, first_of(directions)});
        if (directions.second != directions.first) add_shown(item, {index, directions.second, by_rung, second_of(directions)});
        if (rung.stage == Stage::ldi) item.coarser_px = images_.levels[rung.level].side_px;
    }

    // Whether images are drawn for an eye that they were not sampled for. A tile sheared onto a slope looks as it does on flat
    // ground to an eye as high above the slope, which goes on to below the eye.
    void judge(Item& item, const Rect& rect) {
        glm::dvec2 from_middle = glm::dvec2(eye_m_) - (rect.low_m + rect.high_m) / 2.0;
        for (const Shown& shown : list_.shown_of(item)) {
            const Rung& rung = field_.ladder_.rungs[shown.rung];
            if (rung.stage != Stage::ldi) continue;
            for (const Half& half : list_.halves_of(item)) {
                double above_m = eye_m_.z - half.plane.height_m - glm::dot(half.plane.slope, glm::dvec2(eye_m_) - rect.low_m);
                item.is_outside_cell |= !is_sampled_for(images_, rung.level, shown.direction, from_middle, above_m);
            }
        }
        list_.counts.outside_cell += item.is_outside_cell;
    }

    void add_shown(Item& item, const Shown& shown) {
        list_.shown.push_back(shown);
        if (field_.ladder_.rungs[shown.rung].stage == Stage::ldi) {
            uint32_t samples = field_.parts_.sample_counts[field_.image_of(item, shown)];
            list_.counts.samples += samples;
            list_.counts.samples_shown +=
                samples * (shown.by_rung.share() * shown.by_direction.share() / double(kWhole * kWhole));
        } else {
            auto side = uint32_t(std::max(1.0, field_.texels_of(field_.ladder_.rungs[shown.rung])));
            item.texels_px = std::max(item.texels_px, side);
            item.coarser_px = item.coarser_px > 0 ? std::min(item.coarser_px, side) : side;
            list_.counts.texels += uint64_t(side) * side;
        }
    }

    // In as few pieces as keep it so near the ground as is asked, or in the most.
    void shear(Item& item, const Rect& rect) {
        glm::dvec3 box_low(rect.low_m, item.low_m), box_high(rect.high_m, item.high_m);
        double distance = glm::length(eye_m_ - glm::clamp(eye_m_, box_low, box_high));
        double depth_m = std::max(distance / secant_, near_m_);
        auto pixels = [&](double m) { return view::error_px_bound(focal_px_, m, depth_m, secant_); };
        const FieldOptions& options = field_.options_;
        item.first_half = uint32_t(list_.halves.size());
        while (true) {
            item.displacement_m = 0;
            add_pieces(item, rect, 0, 0, uint32_t(1) << item.pieces_log2);
            if (pixels(item.displacement_m) <= options.displacement_px || item.pieces_log2 >= options.most_pieces_log2) break;
            ++item.pieces_log2, list_.halves.resize(item.first_half);
        }
        item.half_count = uint32_t(list_.halves.size()) - item.first_half;
        FieldCounts& counts = list_.counts;
        counts.cut_tiles += item.pieces_log2 > 0, counts.pieces += uint64_t(1) << (2 * item.pieces_log2);
        counts.displaced_tiles += !(pixels(item.displacement_m) <= options.displacement_px);
        counts.displacement_px = std::max(counts.displacement_px, pixels(item.displacement_m));
    }

    // Of the square of `pieces` pieces from this column and row on.
    void add_pieces(Item& item, const Rect& tile, uint32_t column, uint32_t row, uint32_t pieces) {
        double piece_m = images_.tile_m / double(1u << item.pieces_log2);
        Rect rect{tile.low_m + glm::dvec2(column, row) * piece_m,
                  tile.low_m + glm::dvec2(column + pieces, row + pieces) * piece_m};
        glm::dvec2 eye(eye_m_);
        if (pieces > 1) {
            uint32_t half = pieces / 2;
            for (auto [x, y] : quarters_towards(eye, (rect.low_m + rect.high_m) / 2.0))
                add_pieces(item, tile, column + uint32_t(x) * half, row + uint32_t(y) * half, half);
            return;
        }
        if (item.pieces_log2 == 0) rect = tile;
        rect.high_m = glm::min(rect.high_m, tile.high_m);  // rounding leaves it inside the ground
        const Ground& ground = placement_.ground();
        Sheared sheared = field_.options_.chooses_diagonals ? ground.sheared(rect) : ground.sheared(rect, Diagonal::rising);
        item.displacement_m = std::max(item.displacement_m, sheared.displacement_m);
        glm::dvec2 share = (eye - rect.low_m) / (rect.high_m - rect.low_m);
        uint32_t first = farther_half(sheared.diagonal, share.x, share.y);
        for (uint32_t half : {first, 1 - first}) {
            Plane plane = sheared.halves[half];
            plane.height_m -= glm::dot(plane.slope, rect.low_m - tile.low_m);
            list_.halves.push_back({uint8_t(column), uint8_t(row), uint8_t(half), sheared.diagonal, plane});
        }
    }

    const Field& field_;
    const ImageSet& images_;
    const Placement& placement_;
    FieldList& list_;
    view::BoxErrorBound bound_;
    std::array<glm::dvec3, 4> sides_;
    glm::dvec3 forward_, eye_m_;
    double near_m_, focal_px_, secant_;
};

void Field::list(const view::Camera& camera, FieldList& list) const {
    list.items.clear(), list.shown.clear(), list.halves.clear(), list.counts = {};
    FieldWalk(*this, camera, list).run();
}

}  // namespace overlook::wang_ldi
