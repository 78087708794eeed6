// The methods that can be measured, by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "formats/setting.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

struct MethodKind {
    std::string_view name, variant;  // "" = the default one
    std::span<const SettingKind> settings;
};
std::span<const MethodKind> method_kinds();         // the default variant of each method before its others
const MethodKind* kind_of(const MethodSpec& spec);  // null of none
std::string named(const MethodSpec& spec);          // "terrain:hard"

// Reads "NAME[:variant][@setting=value]...". Fails with Exit::bad_command:
//   "--method terain: there is no such method; did you mean terrain? (known: terrain, lod-sprite, caveclod, discrete, wang-ldi,
//   full)"
//   "--method terrain:soft: terrain has no such variant"
//   "--method terrain@eror-px=2: terrain has no setting eror-px; did you mean error-px?"
//   "--method terrain:hard@morph=1: terrain:hard has no setting morph"
//   "--method terrain@error-px=x: error-px takes a number from 0.01 to 1000"
//   "--method lod-sprite@keyframe=x: keyframe takes at-once, thread or sliced"
Result<MethodSpec> parse_method(std::string_view text);

// Multiplies the methods by sweeps, each "setting=value,value,...": of a method that has the setting and was not given it, one
// run a value. The order is the methods', then the values'; what comes out twice is kept once. Fails with Exit::bad_command:
//   "--sweep error-px: setting=value,value,... is wanted"
//   "--sweep speed=1,2: none of the methods has a setting speed to sweep"
Result<std::vector<MethodSpec>> specs_from(const std::vector<std::string>& methods, const std::vector<std::string>& sweeps);

// Full geometry at so many samples a pixel: what no method that draws geometry can be better than.
MethodSpec floor_spec(double samples);
bool is_floor(const MethodSpec& spec);

// How far a terrain's vertices morph (Refiner::cut_by_pixels): 0 of the variant "hard", whose vertices pop.
double morph_of(const MethodSpec& spec);

// Triangles that a frame may have, 0 = as many as its error takes.
double budget_of(const MethodSpec& spec);

bool draws_terrains(const MethodSpec& spec);
bool draws_meshes(const MethodSpec& spec);
bool draws_chains(const MethodSpec& spec);
bool draws_plantings(const MethodSpec& spec);
bool is_of_chains_alone(const MethodSpec& spec);  // discrete:fsi and its like
// Fails with Exit::impossible:
//   "--method caveclod: it draws meshes, and valley.json holds a terrain"
//   "--method discrete: search is of chains of levels, and duck.ovl holds a mesh"
// and as check_streams, of those that stream.
Result<void> check_draws(std::span<const MethodSpec> specs, const World& world);

// The spec must come from above and draw what the world holds; the world must outlive the method.
std::unique_ptr<Method> make_method(const MethodSpec& spec, World& world);

}  // namespace overlook::measure
