#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "runtime/view/box_error.h"
#include "runtime/view/pixel_error.h"
#include "runtime/wang_ldi/field_walk.h"
#include "runtime/wang_ldi/list_parts.h"
#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {

// Lists what a walk found.
class FieldLister {
  public:
    FieldLister(const Field& field, const view::Camera& camera, FieldList& list)
        : field_(field),
          images_(*field.parts_.images),
          placement_(*field.parts_.placement),
          list_(list),
          bound_(camera),
          eye_m_(camera.position_m),
          near_m_(camera.near_m),
          focal_px_(view::focal_px(camera)),
          secant_(view::corner_secant(camera)) {}

    void add(const Found& found) { found.log2 == 0 ? list_tile(found) : list_block(found); }

  private:
    void list_tile(const Found& found) {
        auto [i, j, log2, coverage, near_m] = found;
        Rect rect = placement_.rect_of(i, j);
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
        size_t shown_before = list_.shown.size(), halves_before = list_.halves.size();
        FieldCounts counts_before = list_.counts;
        if (!show(item, rect, range, above_m)) return;
        if (is_hidden(item, rect, range)) {
            list_.shown.resize(shown_before), list_.halves.resize(halves_before), list_.counts = counts_before;
            ++list_.counts.hidden;
            return;
        }
        ++list_.counts.tiles_listed;
        list_.items.push_back(item);
    }

    void list_block(const Found& found) {
        auto [i, j, log2, coverage, near_m] = found;
        Rect rect = placement_.rect_of(i, j, int64_t(1) << log2);
        GroundRange bound = placement_.ground().bound(rect);
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
        if (is_hidden(item, rect, bound)) return void(++list_.counts.hidden);
        list_.counts.texels += uint64_t(item.texels_px) * item.texels_px;
        ++list_.counts.blocks_listed;
        list_.items.push_back(item);
    }

    // Geometry reaches over its tile's edges, images do not.
    bool is_hidden(const Item& item, Rect rect, const GroundRange& ground) const {
        if (!list_.horizon) return false;
        rect.low_m -= field_.overhang_m_, rect.high_m += field_.overhang_m_;
        return field_.is_hidden(list_, rect, ground.high_m, widest_splat_m(field_, list_, item));
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

    // How far samples may stand from their surfaces, in metres. Where tiles are cut, an even part is kept back of what their
    // ground may stand off, so that nothing changes at once where one is cut in more pieces.
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
    glm::dvec3 eye_m_;
    double near_m_, focal_px_, secant_;
};

void FieldCounts::add(const FieldCounts& other) {
    for (auto of :
         {&FieldCounts::blocks_tested, &FieldCounts::tiles_tested, &FieldCounts::blocks_listed, &FieldCounts::tiles_listed,
          &FieldCounts::hidden, &FieldCounts::bare_tiles, &FieldCounts::cut_tiles, &FieldCounts::pieces,
          &FieldCounts::displaced_tiles, &FieldCounts::outside_cell, &FieldCounts::samples, &FieldCounts::texels})
        this->*of += other.*of;
    for (size_t v = 0; v < kVerdicts; ++v) tiles_by_verdict[v] += other.tiles_by_verdict[v];
    samples_shown += other.samples_shown, displacement_px = std::max(displacement_px, other.displacement_px);
}

void FieldList::append(const FieldList& other) {
    auto shown_before = uint32_t(shown.size()), halves_before = uint32_t(halves.size());
    for (Item item : other.items) {
        item.first_shown += shown_before, item.first_half += halves_before;
        items.push_back(item);
    }
    shown.insert(shown.end(), other.shown.begin(), other.shown.end());
    halves.insert(halves.end(), other.halves.begin(), other.halves.end());
    counts.add(other.counts);
}

// A list that was of the same camera keeps its horizon.
void Field::begin(const view::Camera& camera, FieldList& list) const {
    std::shared_ptr<const Horizon> last = std::move(list.horizon);
    list.clear();
    if (!std::isfinite(options_.ground_error_px)) return;
    const Ground& ground = parts_.placement->ground();
    list.horizon = last && last->is_of(ground, camera) ? last : std::make_shared<Horizon>(ground, camera);
}

void Field::list(const view::Camera& camera, FieldList& list) const {
    begin(camera, list);
    FieldLister lister(*this, camera, list);
    FieldWalk(*this, camera).run(list.counts, [&](const Found& found) { lister.add(found); });
}

void Field::list(const view::Camera& camera, FieldList& list, FieldScratch& scratch) const {
    constexpr size_t kAtOnce = 32;
    begin(camera, list), scratch.found.clear();
    FieldWalk(*this, camera).run(list.counts, [&](const Found& found) { scratch.found.push_back(found); });
    size_t parts = (scratch.found.size() + kAtOnce - 1) / kAtOnce;
    if (scratch.parts.size() < parts) scratch.parts.resize(parts);
    parallel_ranges(scratch.found.size(), kAtOnce, [&](size_t begin, size_t end) {
        FieldList& part = scratch.parts[begin / kAtOnce];
        part.clear();
        part.horizon = list.horizon;
        FieldLister lister(*this, camera, part);
        for (size_t f = begin; f < end; ++f) lister.add(scratch.found[f]);
    });
    for (size_t part = 0; part < parts; ++part) list.append(scratch.parts[part]);
}

}  // namespace overlook::wang_ldi
