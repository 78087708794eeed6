// Flights over a generated landscape: places are shares of its extent and heights above its ground, so that they fit any of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/scene.h"
#include "tools/make_sample/landscape.h"

namespace overlook::sample {

constexpr double kLeastClearance_m = 50;

// The scene that make-sample writes beside dem.tif: sample.ovl, to be baked from it.
scene::Scene sample_scene();

// 600 frames: a slow start over the foothills, over the lake, along the main valley and into the range. Every frame is at least
// kLeastClearance_m over the highest of the samples round about.
scene::Flight overview_flight(const Landscape& landscape, double cell_size_m);

// The flights of the stability suite, by name: s01 .. s18 (those of its cases that another's flight serves have none, and S11
// flies elsewhere). At least kLeastClearance_m over the ground, but 30 m in s07 (grazing), and in s06 (skimming) 0.6 m over a row
// of samples, which is 1.2 times the player's near plane.
std::vector<std::pair<std::string, scene::Flight>> suite_flights(const Landscape& landscape, double cell_size_m);

// Height of the ground at x, y: the highest of the four samples round about, of the nearest ones outside.
double ground_m(const Landscape& landscape, double cell_size_m, double x_m, double y_m);

// The least height of a flight's frames above the ground.
double least_clearance_m(const scene::Flight& flight, const Landscape& landscape, double cell_size_m);

}  // namespace overlook::sample
