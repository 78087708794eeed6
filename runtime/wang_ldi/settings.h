// What is asked of planted ground, and how it is drawn.
#pragma once

#include <span>
#include <string_view>

#include "formats/setting.h"
#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

enum class Variant {
    own,    // to the horizon, levels and directions fade, by depth
    paper,  // as printed in 2002: 40 tiles far, no fades, tiles back to front
};

// Who warps: the graphics card's compute shaders unless the renderer is a processor, or as it is said.
enum class Warper { by_renderer, processor, card };

struct FrameOptions {
    Variant variant = Variant::own;
    // > 0; of the terrain and, of own, of all that is planted: wherever images were displaced by more, finer ones are drawn, or
    // what is planted itself.
    double error_px = 1;
    double radius_m = 0;          // nothing is planted beyond; 0: the variant's own
    double fade = 0.05;           // of own: LadderOptions::fade_share
    double direction_fade = 0.1;  // of own: FieldOptions::direction_fade_share
    bool has_geometry = true;   // of own: tiles, where there are models, that no image can show within the error, and near ones,
    double geometry_m = 0;      // up to here; 0: as near as images were sampled for
    double plant_fade = 0.2;    // of own: PlantAccuracy::fade
    bool is_exact = false;      // of own: warped as the paper's are, sample by sample, slowly
    bool fills_holes = true;    // of own, unless it is exact: small ones, as fill_holes
    bool widens_splats = true;  // of own: FieldOptions::widens_splats
    // Of own: what is warped has so many samples along each side of a pixel, of which each sample of the target takes the one
    // where it lies, so that splats cover a part of a pixel; 1..4, 0: 2 where `samples` are 4 or more, else 1. Into a target of
    // one sample, which lies in a pixel's middle, an even number is warped as the odd one below. Fewer of large pictures
    // (warped_finer).
    uint32_t splat_samples = 0;
    bool has_far = true;      // of own: textures and colours beyond the images; false: nothing is drawn there
    bool is_by_depth = true;  // of own: each pixel shows what is nearest; false: what is drawn last, as the paper's
    bool cuts_tiles = true;   // of own: tiles in pieces and along the better diagonal; false: in the paper's two halves
    // Of own: what the ground hides, as it is drawn within the error, is left out before. The same picture, but that small holes
    // are filled beside which it would have been warped.
    bool ground_hides = true;
    Warper warper = Warper::by_renderer;  // of own, unless it is exact
    // Who draws triangles of plants; by the renderer: the processor's own hand where that is the renderer and pictures have one
    // sample a pixel. The processor's only beside what the processor warps by depth, exactly or not, and of plants that keep
    // still; else OpenGL's.
    Warper geometry_by = Warper::by_renderer;
    uint32_t samples = 1;       // a pixel of what is drawn into
    bool is_pipelined = false;  // the warp of the next frame overlaps drawing this one, which is shown a frame late
    bool shows_rings = false;   // levels and directions by colours (the paper's figure 7)

    bool operator==(const FrameOptions&) const = default;
};
FrameOptions defaults_of(Variant variant);

// What people may set of a variant.
std::span<const SettingKind> setting_kinds(Variant variant);
// name and value must be of one of them.
void set(FrameOptions& options, std::string_view name, double value);

// Up to where all tiles are drawn as geometry; 0: none.
double geometry_to_m(const ImageSet& images, const FrameOptions& options);

// How many samples along each side of a pixel are warped for a camera's picture, and the camera with as many pixels; of large
// pictures fewer than asked, so that they have at most 8192 a side and 2^24 in all (128 MiB for each thread that warps), or the
// picture's own.
uint32_t warped_finer(const FrameOptions& options, const view::Camera& camera);
view::Camera warped_camera(const FrameOptions& options, view::Camera camera);

// Of a camera's pictures, and textures of so many pixels a side.
FieldOptions field_options_of(const ImageSet& images, const FrameOptions& options, const view::Camera& camera,
                              uint32_t texture_side_px);

}  // namespace overlook::wang_ldi
