// Names of PLY properties, as the Stanford repository, MeshLab, VCGLIB and Blender write them.

#include "tools/bake/mesh/ply_scalars.h"

#include "tools/bake/mesh/soup.h"

namespace overlook::mesh {
namespace {

Slot slot_of(const std::string& name) {
    struct Name {
        std::string_view name;
        Slot slot;
    };
    static constexpr Name kNames[] = {
        {"x", kX},
        {"y", kY},
        {"z", kZ},
        {"nx", kNormalX},
        {"ny", kNormalY},
        {"nz", kNormalZ},
        {"red", kRed},
        {"green", kGreen},
        {"blue", kBlue},
        {"alpha", kAlpha},
        {"r", kRed},
        {"g", kGreen},
        {"b", kBlue},
        {"a", kAlpha},
        {"diffuse_red", kRed},
        {"diffuse_green", kGreen},
        {"diffuse_blue", kBlue},
        {"u", kU},
        {"v", kV},
        {"s", kU},
        {"t", kV},
        {"texture_u", kU},
        {"texture_v", kV},
        {"texnumber", kTexture},
    };
    for (const Name& known : kNames)
        if (known.name == name) return known.slot;
    return kIgnored;
}

// Colours are whole numbers of their type's range, or floats of 0..1.
double greatest_of(PlyType type) {
    static constexpr double kGreatest[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 1, 1};
    return kGreatest[size_t(type)];
}

}  // namespace

Scalars::Scalars(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
        const Slot slot = property.is_list ? kIgnored : slot_of(property.name);
        slots.push_back(slot);
        has[slot] = true;
        greatest[slot] = greatest_of(property.type);
    }
}

std::array<uint8_t, 4> Scalars::colour() const {
    const auto byte = [&](Slot slot) { return byte_from_unit(value[slot] / greatest[slot]); };
    return {byte(kRed), byte(kGreen), byte(kBlue), has[kAlpha] ? byte(kAlpha) : uint8_t(255)};
}

}  // namespace overlook::mesh
