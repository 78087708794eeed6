// The methods that the player draws with, and what of a command line and a scene goes to which.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/scene.h"
#include "runtime/caveclod/settings.h"
#include "runtime/discrete/settings.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/lod_sprite/draw_paper_frames.h"
#include "runtime/wang_ldi/settings.h"

namespace overlook::player {

enum class Thing { terrain, mesh, chain, planting };

// Of terrains; lod-sprite draws meshes too; of meshes from caveclod on; of chains of levels from discrete on, which of a mesh
// draws levels for the whole of it and of a chain the same as discrete:fsi; of planted ground wang-ldi.
enum class Method {
    terrain,
    lod_sprite,
    lod_sprite_paper,
    caveclod,
    caveclod_paper,
    caveclod_shared,
    discrete,
    discrete_fsi,
    discrete_fsi_paper,
    discrete_switch,
    discrete_blend,
    discrete_dither,
    discrete_late,
    wang_ldi,
    wang_ldi_paper
};

// As typed: "terrain", "lod-sprite", "lod-sprite:paper", "caveclod" ...
std::string_view name_of(Method method);
bool draws(Method method, Thing thing);
std::string_view name_of(Thing thing);      // "terrain", "mesh", "chain of levels", "planting"
std::string_view things_of(Method method);  // what it draws: "terrains", "meshes", "chains of levels"
Method default_method(Thing thing);
bool takes_budgets(Method method);  // of triangles or milliseconds
// Which of them it keeps by itself (FrameStyle::most_triangles, most_ms); the others are kept by the error asked for.
bool keeps_triangles(Method method, Thing thing);
bool keeps_ms(Method method, Thing thing);
bool has_wireframe(Method method);
caveclod::Variant variant_of(Method method);           // of one of caveclod's
discrete::Variant discrete_variant_of(Method method);  // of one of discrete's
wang_ldi::Variant planting_variant_of(Method method);  // of one of wang-ldi's
bool shows_sources(Method method);                     // when asked to
// The one that M goes on to, of those that draw the thing; the last is followed by the first.
Method next(Method method, Thing thing);

// Fails with Exit::bad_command:
//   "--method lod-sprit: there is no such method; did you mean lod-sprite? (known: terrain, lod-sprite, ...)"
Result<Method> parse_method(std::string_view text);

// Method and settings of a scene's layer, whose other layers do not matter; its error_px, if it has one, becomes the scene's.
// Fails with Exit::bad_input
//   "a.json: /layers/0/method: terrain has no variant paper"
//   "a.json: /layers/0/settings/eror_px: terrain has no such setting; did you mean error_px?"
//   "a.json: /layers/0/settings/error_px: a number from 0.001 to 10000 is wanted"
//   "a.json: /layers/0/settings/key_scale: a whole number from 1 to 4 is wanted"
//   "a.json: /layers/0/settings/near: true or false is wanted"
//   "a.json: /layers/0/settings/keyframe: at-once, thread or sliced is wanted"
//   "a.json: /layers/0/settings/low_error_px: 0.5 is less than the error_px of 1"
struct LayerMethod {
    Method method = Method::terrain;
    // Both with the scene's error_px; what it does not say of their other promises keeps its default ratio to it.
    lod_sprite::FrameOptions sprite;
    lod_sprite::paper::FrameOptions paper;
    caveclod::FrameOptions mesh;
    discrete::FrameOptions chain;  // of `method`'s variant
    bool sets_chain = false;       // something that only chains have
    wang_ldi::FrameOptions planting;
};
Result<LayerMethod> layer_method_of(const std::string& path, scene::Scene& described, size_t place = 0);

// The same with error_px; what is promised elsewhere keeps its ratio to it.
lod_sprite::FrameOptions with_error(lod_sprite::FrameOptions options, double error_px);
lod_sprite::paper::FrameOptions with_error(lod_sprite::paper::FrameOptions options, double error_px);
caveclod::FrameOptions with_error(caveclod::FrameOptions options, double error_px);
// Of discrete:late, whose own error is a share of a pixel, that share of it.
discrete::FrameOptions with_error(discrete::FrameOptions options, double error_px);

}  // namespace overlook::player
