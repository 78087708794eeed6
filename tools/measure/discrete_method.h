// Chains of levels as a method to measure: switch, blend, dither, late, fsi and fsi-paper.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "formats/setting.h"
#include "runtime/discrete/settings.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// "fsi-paper" and so on; the first is what "discrete" is without a variant.
struct DiscreteVariant {
    std::string_view name;
    discrete::Variant variant;
};
std::span<const DiscreteVariant> discrete_variants();

// What of its settings is also one of a mesh drawn by levels for the whole of it.
bool is_of_whole_meshes(std::string_view setting_name);

// The world must hold chains, be uploaded and outlive it.
std::unique_ptr<Method> make_chain_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
