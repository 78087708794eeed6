// Planted ground as a method to measure: the terrain by OpenGL, layered depth images warped over it.
#pragma once

#include <memory>
#include <vector>

#include "formats/setting.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/settings.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// What a variant has, and "memory-mib" of images and "samples".
std::vector<SettingKind> planting_settings(wang_ldi::Variant variant);

// Of a method that is wang-ldi.
wang_ldi::FrameOptions planting_options(const MethodSpec& spec);
// How its images come: waited for, within memory-mib.
wang_ldi::ImageStreaming streaming_of(const MethodSpec& spec);

// Tiles in both lists, of the same field, of which at least half the places are shown by other means in the second: what changes
// at once, and not by fading.
uint64_t exchanged_tiles(const wang_ldi::FieldList& before, const wang_ldi::FieldList& now);

// Whether its memory has room for what it keeps of the images. Fails as ImageStore::open.
Result<void> check_planting(const MethodSpec& spec, const World& world);

// Every frame waits for the images that its memory has room for. The world must hold planted ground, be uploaded and outlive it.
std::unique_ptr<Method> make_planting_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
