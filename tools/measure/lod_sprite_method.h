// LOD-sprite as a method to be measured.
#pragma once

#include <memory>

#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// Overlook's own form; spec: its settings, as methods.cpp lists them.
std::unique_ptr<Method> make_lod_sprite_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
