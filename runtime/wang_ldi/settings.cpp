#include "runtime/wang_ldi/settings.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

constexpr FrameOptions kDefaults;
constexpr uint32_t kWidestFine_px = 8192;             // pictures of more are not warped finer than they are: memory, of
constexpr uint64_t kMostFine_px = uint64_t(1) << 24;  // which each thread that warps takes 8 bytes a pixel
constexpr double kOfGround = 1.0 / 8;                 // of the error, that tiles may stand off their ground
constexpr SettingKind kErrorPx{"error-px", 0.001, 10000, kDefaults.error_px};
constexpr SettingKind kRadiusM{"radius-m", 0, 1e7, kDefaults.radius_m, false, true};
constexpr SettingKind kPipelined{"pipelined", 0, 1, 0, true, true, true};
constexpr SettingKind kSlopeSplats{"slope-splats", 0, 1, 1, true, true, true}, kFar{"far", 0, 1, 1, true, true, true},
    kDepth{"depth", 0, 1, 1, true, true, true}, kCuts{"cuts", 0, 1, 1, true, true, true};
constexpr SettingKind kRings{"rings", 0, 1, 0, true, true, true};
constexpr std::array<SettingKind, 19> kOwn = {kErrorPx,
                                              kRadiusM,
                                              SettingKind{"fade", 0, 0.5, kDefaults.fade, false, true},
                                              SettingKind{"direction-fade", 0, 0.5, kDefaults.direction_fade, false, true},
                                              SettingKind{"geometry", 0, 1, 1, true, true, true},
                                              SettingKind{"geometry-m", 0, 1e6, kDefaults.geometry_m, false, true},
                                              SettingKind{"plant-fade", 0, 0.9, kDefaults.plant_fade, false, true},
                                              SettingKind{"warper", 0, 2, 0, true},
                                              SettingKind{"geometry-by", 0, 2, 0, true},
                                              SettingKind{"exact", 0, 1, 0, true, true, true},
                                              SettingKind{"fill", 0, 1, 1, true, true, true},
                                              kSlopeSplats,
                                              SettingKind{"splat-samples", 0, 4, kDefaults.splat_samples, true, true},
                                              kFar,
                                              kDepth,
                                              kCuts,
                                              SettingKind{"ground-hides", 0, 1, 1, true, true, true},
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
        options.has_geometry = value != 0;
    } else if (name == "geometry-m") {
        options.geometry_m = value;
    } else if (name == "plant-fade") {
        options.plant_fade = value;
    } else if (name == "warper") {
        options.warper = Warper(int(value));
    } else if (name == "geometry-by") {
        options.geometry_by = Warper(int(value));
    } else if (name == "exact") {
        options.is_exact = value != 0;
    } else if (name == "fill") {
        options.fills_holes = value != 0;
    } else if (name == "slope-splats") {
        options.widens_splats = value != 0;
    } else if (name == "splat-samples") {
        options.splat_samples = uint32_t(value);
    } else if (name == "far") {
        options.has_far = value != 0;
    } else if (name == "depth") {
        options.is_by_depth = value != 0;
    } else if (name == "cuts") {
        options.cuts_tiles = value != 0;
    } else if (name == "ground-hides") {
        options.ground_hides = value != 0;
    } else if (name == "pipelined") {
        options.is_pipelined = value != 0;
    } else {
        assert(name == "rings");
        options.shows_rings = value != 0;
    }
}

double geometry_to_m(const ImageSet& images, const FrameOptions& options) {
    if (options.variant == Variant::paper || !options.has_geometry) return 0;
    return options.geometry_m > 0 ? options.geometry_m : images.cell.nearest_m;
}

uint32_t warped_finer(const FrameOptions& options, const view::Camera& camera) {
    if (options.variant == Variant::paper) return 1;
    bool needs_middle = options.samples <= 1;
    uint32_t by_target = options.samples >= 4 ? 2 : 1, side = options.splat_samples > 0 ? options.splat_samples : by_target;
    auto is_too_large = [&] {
        bool is_wide = std::max(camera.width_px, camera.height_px) * side > kWidestFine_px;
        return is_wide || uint64_t(camera.width_px) * camera.height_px * side * side > kMostFine_px;
    };
    while (side > 1 && is_too_large()) --side;
    return needs_middle && side % 2 == 0 ? side - 1 : side;
}

view::Camera warped_camera(const FrameOptions& options, view::Camera camera) {
    uint32_t finer = warped_finer(options, camera);
    camera.width_px *= finer, camera.height_px *= finer;
    return camera;
}

FieldOptions field_options_of(const ImageSet& images, const FrameOptions& options, const view::Camera& camera,
                              uint32_t texture_side_px) {
    bool is_paper = options.variant == Variant::paper;
    FieldOptions made = is_paper
                            ? paper_options(images)
                            : options_to_horizon(images, view::focal_px(camera), geometry_to_m(images, options), texture_side_px);
    if (!is_paper) {
        LadderOptions& ladder = made.ladder;
        ladder.fade_share = options.fade, made.direction_fade_share = options.direction_fade;
        made.error_px = options.error_px, made.displacement_px = options.error_px * kOfGround, ladder.coarser = options.error_px;
        double rim_m = std::sqrt(0.5) * images.tile_m / (1 - options.fade);
        ladder.texel_from_m = images.tile_m / texture_side_px * texels_from(camera, options.error_px, options.fade) + rim_m;
        ladder.texture_from_m = std::max(images.cell.farthest_m / std::max(1.0, options.error_px), ladder.texel_from_m);
        ladder.samples_from = samples_from(camera, options.error_px * (1 - kOfGround), options.fade);
        made.widens_splats = options.widens_splats;
        if (options.ground_hides) made.ground_error_px = options.error_px;
        if (!options.has_far) ladder.radius_m = ladder.texture_from_m;
        if (!options.cuts_tiles) made.displacement_px = INFINITY, made.most_pieces_log2 = 0, made.chooses_diagonals = false;
    }
    if (options.radius_m > 0) made.ladder.radius_m = std::min(made.ladder.radius_m, options.radius_m);
    if (is_paper && options.radius_m > 0) made.ladder.radius_m = options.radius_m;
    return made;
}

}  // namespace overlook::wang_ldi
