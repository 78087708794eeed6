// Textures of ground seen from an aeroplane, that can be laid side by side.
#pragma once

#include <cstdint>
#include <string_view>

#include "formats/image.h"

namespace overlook::sample {

enum class GroundKind { deep_water, clear_water, moor_water, sand, meadow, forest, heath, rock, snow, scree, fields };

// "deep-water", "meadow": the texture's file and material.
std::string_view name_of(GroundKind kind);

// A square of side_px pixels (a power of two, 16..4096) of even light, whose left edge goes on at its right one and its top at
// its bottom. Meant for some 10 km. The same for the same seed.
ImageRgb8 ground_texture(GroundKind kind, uint32_t side_px, uint64_t seed);

}  // namespace overlook::sample
