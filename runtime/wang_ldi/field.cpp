#include "runtime/wang_ldi/field.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/wang_ldi/list_parts.h"
#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kPaperRadius_tiles = 40;
constexpr uint32_t kMostPieces_log2 = 4;
constexpr uint32_t kMostTextureSide_px = 4096;

bool is_share(double value) {
    return value >= 0 && value <= 0.5;
}

Result<void> check(const FieldOptions& options) {
    if (!is_share(options.ladder.fade_share) || !is_share(options.direction_fade_share))
        return bad_command("a field's fades of {} and {}: shares from 0 to 0.5 are needed", options.ladder.fade_share,
                           options.direction_fade_share);
    if (!(options.block_share > 0 && options.block_share <= 0.5))
        return bad_command("a field's blocks of {} of their distance: above 0 and up to 0.5 is needed", options.block_share);
    if (options.most_pieces_log2 > kMostPieces_log2)
        return bad_command("tiles in 2^{} pieces a side: 2^{} at most", options.most_pieces_log2, kMostPieces_log2);
    if (!std::has_single_bit(options.texture_side_px) || options.texture_side_px > kMostTextureSide_px)
        return bad_command("textures of {} pixels a side: a power of two up to {} is needed", options.texture_side_px,
                           kMostTextureSide_px);
    if (options.ladder.texture_levels != uint32_t(std::bit_width(options.texture_side_px)))
        return bad_command("textures of {} pixels a side with {} levels", options.texture_side_px, options.ladder.texture_levels);
    if (!(options.ladder.coarser > 0 && std::isfinite(options.ladder.coarser)))
        return bad_command("a field's levels {} times nearer: above 0 is needed", options.ladder.coarser);
    if (!(options.displacement_px > 0)) return bad_command("a displacement of {} px: above 0 is needed", options.displacement_px);
    const LadderOptions& ladder = options.ladder;
    if (!(options.ground_error_px >= 0))
        return bad_command("a ground within {} px: 0 is needed at least", options.ground_error_px);
    if (!(options.error_px > 0)) return bad_command("a field within {} px: above 0 is needed", options.error_px);
    if (!(ladder.radius_m > 0 && ladder.geometry_to_m >= 0 && ladder.texture_from_m >= 0 && ladder.texel_from_m > 0))
        return bad_command(
            "a field with geometry to {} m, textures from {} m, their texels a pixel at {} m, {} m wide: a distance is wrong",
            ladder.geometry_to_m, ladder.texture_from_m, ladder.texel_from_m, ladder.radius_m);
    return {};
}

}  // namespace

FieldOptions paper_options(const ImageSet& set) {
    FieldOptions options;
    options.ladder.radius_m = kPaperRadius_tiles * set.tile_m, options.ladder.fade_share = 0;
    options.direction_fade_share = 0;
    options.ladder.texture_levels = uint32_t(std::bit_width(options.texture_side_px));
    options.displacement_px = INFINITY, options.most_pieces_log2 = 0, options.chooses_diagonals = false;
    return options;
}

FieldOptions options_to_horizon(const ImageSet& set, double focal_px, double geometry_to_m, uint32_t texture_side_px) {
    FieldOptions options;
    options.texture_side_px = texture_side_px;
    options.ladder.texture_levels = uint32_t(std::bit_width(texture_side_px));
    options.ladder.geometry_to_m = geometry_to_m;
    options.ladder.texel_from_m = kDiagonal * focal_px * set.tile_m / texture_side_px;
    options.ladder.texture_from_m = std::max(set.cell.farthest_m, options.ladder.texel_from_m);
    return options;
}

Result<Field> Field::of(const FieldParts& parts, const FieldOptions& options) {
    if (auto checked = check(options); !checked) return tl::unexpected(checked.error());
    const ImageSet& images = *parts.images;
    if (images.tile_m != parts.placement->tile_m())
        return bad_command("a field of tiles of {} m with images of {} m", parts.placement->tile_m(), images.tile_m);
    if (images.tile_count != parts.set->tiles.size() || images.levels.empty() || images.direction_count == 0)
        return bad_command("a field of {} tiles with images of {} tiles, {} levels, {} directions", parts.set->tiles.size(),
                           images.tile_count, images.levels.size(), images.direction_count);
    if (!(parts.overhang_m >= 0 && std::isfinite(parts.overhang_m)))
        return bad_command("a field whose plants reach {} m over their tiles' edges", parts.overhang_m);
    if (parts.sample_counts.size() != images.ldi_count())
        return bad_command("a field of {} images with {} counts of samples", images.ldi_count(), parts.sample_counts.size());
    Field made;
    made.parts_ = parts, made.options_ = options, made.ladder_ = ladder_of(images, options.ladder);
    made.blocks_from_m_ = made.reach_m_ = made.images_to_m_ = INFINITY;
    const std::vector<Rung>& rungs = made.ladder_.rungs;
    made.highest_m_ = std::max(images.high_m + highest_step_m(images), parts.plants_high_m);
    made.has_geometry_ = rungs.front().stage == Stage::geometry;
    made.overhang_m_ = made.has_geometry_ ? parts.overhang_m : 0;
    for (const Rung& rung : rungs) {
        if (rung.stage > Stage::ldi) made.images_to_m_ = std::min(made.images_to_m_, rung.fade_from_m);
        if (rung.stage >= Stage::texture) made.blocks_from_m_ = std::min(made.blocks_from_m_, rung.fade_to_m);
        if (rung.stage == Stage::bare) made.reach_m_ = rung.fade_to_m;
    }
    return made;
}

uint64_t Field::image_of(const Item& item, const Shown& shown) const {
    return index_of(*parts_.images, {item.context, item.tile, ladder_.rungs[shown.rung].level, shown.direction});
}

Chosen Field::chosen(const glm::dvec2& eye_from_middle_m, double eye_above_ground_m) const {
    double distance = distance_m(eye_from_middle_m, eye_above_ground_m);
    return {distance, rungs_at(ladder_, distance),
            directions_at(*parts_.images, eye_from_middle_m, options_.direction_fade_share)};
}

double Field::farthest_within_m(double error_m, double slope) const {
    double at_m = 0, within_m = 0, last_to_m = 0;
    for (const Rung& rung : ladder_.rungs) {
        if (rung.stage == Stage::geometry) continue;
        if (rung.stage != Stage::ldi) break;
        double own_m = sample_error_m(*parts_.images, rung.level, slope);
        if (error_m < own_m) return at_m + (rung.fade_from_m - at_m) * std::max(0.0, error_m - within_m) / (own_m - within_m);
        at_m = rung.fade_from_m, within_m = own_m, last_to_m = rung.fade_to_m;
    }
    if (!(at_m > 0) || error_m >= within_m * last_to_m / at_m) return INFINITY;
    return at_m + (error_m / within_m - 1) * at_m;
}

double Field::texels_of(const Rung& rung) const {
    return rung.stage == Stage::colour ? std::exp2(-double(rung.level)) : double(options_.texture_side_px >> rung.level);
}

double Field::distance_m(const glm::dvec2& ground_m, double eye_above_ground_m) const {
    double above = std::max(0.0, eye_above_ground_m - parts_.images->cell.eye_high_m);
    return std::sqrt(glm::dot(ground_m, ground_m) + above * above);
}

}  // namespace overlook::wang_ldi
