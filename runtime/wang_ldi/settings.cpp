#include "runtime/wang_ldi/settings.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

constexpr FrameOptions kDefaults;
constexpr SettingKind kErrorPx{"error-px", 0.001, 10000, kDefaults.error_px};
constexpr SettingKind kRadiusM{"radius-m", 0, 1e7, kDefaults.radius_m, false, true};
constexpr SettingKind kPipelined{"pipelined", 0, 1, 0, true, true, true};
constexpr SettingKind kSlopeSplats{"slope-splats", 0, 1, 1, true, true, true}, kFar{"far", 0, 1, 1, true, true, true},
    kDepth{"depth", 0, 1, 1, true, true, true}, kCuts{"cuts", 0, 1, 1, true, true, true};
constexpr SettingKind kRings{"rings", 0, 1, 0, true, true, true};
constexpr std::array<SettingKind, 15> kOwn = {kErrorPx,
                                              kRadiusM,
                                              SettingKind{"fade", 0, 0.5, kDefaults.fade, false, true},
                                              SettingKind{"direction-fade", 0, 0.5, kDefaults.direction_fade, false, true},
                                              SettingKind{"geometry", 0, 2, 2, true},
                                              SettingKind{"geometry-m", 0, 1e6, kDefaults.geometry_m, false, true},
                                              SettingKind{"warper", 0, 2, 0, true},
                                              SettingKind{"exact", 0, 1, 0, true, true, true},
                                              SettingKind{"fill", 0, 1, 1, true, true, true},
                                              kSlopeSplats,
                                              kFar,
                                              kDepth,
                                              kCuts,
                                              kPipelined,
                                              kRings};
constexpr std::array<SettingKind, 4> kPaper = {kErrorPx, kRadiusM, kPipelined, kRings};

}  // namespace

FrameOptions defaults_of(Variant variant) {
    FrameOptions options;
    options.variant = variant;
    return options;
}

std::span<const SettingKind> setting_kinds(Variant variant) {
    if (variant == Variant::paper) return kPaper;
    return kOwn;
}

void set(FrameOptions& options, std::string_view name, double value) {
    if (name == "error-px") {
        options.error_px = value;
    } else if (name == "radius-m") {
        options.radius_m = value;
    } else if (name == "fade") {
        options.fade = value;
    } else if (name == "direction-fade") {
        options.direction_fade = value;
    } else if (name == "geometry") {
        options.geometry = NearGeometry(int(value));
    } else if (name == "geometry-m") {
        options.geometry_m = value;
    } else if (name == "warper") {
        options.warper = Warper(int(value));
    } else if (name == "exact") {
        options.is_exact = value != 0;
    } else if (name == "fill") {
        options.fills_holes = value != 0;
    } else if (name == "slope-splats") {
        options.widens_splats = value != 0;
    } else if (name == "far") {
        options.has_far = value != 0;
    } else if (name == "depth") {
        options.is_by_depth = value != 0;
    } else if (name == "cuts") {
        options.cuts_tiles = value != 0;
    } else if (name == "pipelined") {
        options.is_pipelined = value != 0;
    } else {
        assert(name == "rings");
        options.shows_rings = value != 0;
    }
}

double geometry_to_m(const ImageSet& images, const FrameOptions& options) {
    if (options.variant == Variant::paper || options.geometry == NearGeometry::none) return 0;
    return options.geometry_m > 0 ? options.geometry_m : images.cell.nearest_m;
}

FieldOptions field_options_of(const ImageSet& images, const FrameOptions& options, double focal_px, uint32_t texture_side_px) {
    bool is_paper = options.variant == Variant::paper;
    FieldOptions made =
        is_paper ? paper_options(images) : options_to_horizon(images, focal_px, geometry_to_m(images, options), texture_side_px);
    if (!is_paper) {
        made.ladder.fade_share = options.fade, made.direction_fade_share = options.direction_fade;
        made.displacement_px = options.error_px, made.ladder.coarser = options.error_px;
        if (options.error_px > 1) made.ladder.texture_from_m /= options.error_px, made.ladder.texel_from_m /= options.error_px;
        made.widens_splats = options.widens_splats;
        if (!options.has_far) made.ladder.radius_m = made.ladder.texture_from_m;
        if (!options.cuts_tiles) made.displacement_px = INFINITY, made.most_pieces_log2 = 0, made.chooses_diagonals = false;
    }
    if (options.radius_m > 0) made.ladder.radius_m = std::min(made.ladder.radius_m, options.radius_m);
    if (is_paper && options.radius_m > 0) made.ladder.radius_m = options.radius_m;
    return made;
}

}  // namespace overlook::wang_ldi
