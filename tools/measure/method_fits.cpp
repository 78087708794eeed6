// Which methods draw which things.
#include "tools/measure/discrete_method.h"
#include "tools/measure/methods.h"
#include "tools/measure/planting_method.h"
#include "tools/measure/streamed_method.h"

namespace overlook::measure {

bool draws_plantings(const MethodSpec& spec) {
    return spec.name == "wang-ldi" || is_floor(spec);
}

bool draws_meshes(const MethodSpec& spec) {
    if (spec.name == "wang-ldi") return false;
    if (spec.name == "discrete") return spec.variant.empty();
    return !draws_terrains(spec) || is_floor(spec) || (spec.name == "lod-sprite" && spec.variant.empty());
}

bool draws_terrains(const MethodSpec& spec) {
    return spec.name != "caveclod" && spec.name != "discrete" && spec.name != "wang-ldi";
}

bool draws_chains(const MethodSpec& spec) {
    return spec.name == "discrete" || is_floor(spec);
}

bool is_of_chains_alone(const MethodSpec& spec) {
    return draws_chains(spec) && !draws_meshes(spec);
}

Result<void> check_draws(std::span<const MethodSpec> specs, const World& world) {
    for (const MethodSpec& spec : specs) {
        bool draws = world.is_planted() ? draws_plantings(spec)
                     : world.is_chain() ? draws_chains(spec)
                     : world.is_mesh()  ? draws_meshes(spec)
                                        : draws_terrains(spec);
        if (!draws) {
            std::string_view drawn = spec.name == "wang-ldi"                          ? "plantings"
                                     : draws_terrains(spec) && !is_floor(spec)        ? "terrains"
                                     : spec.name == "discrete" && !draws_meshes(spec) ? "chains of levels"
                                                                                      : "meshes";
            return impossible("--method {}: it draws {}, and {} holds a {}", named(spec), drawn, world.name, world.thing());
        }
        if (is_streamed(spec)) {
            if (Result<void> streams = check_streams(spec, world); !streams) return streams;
        }
        if (spec.name == "wang-ldi") {
            if (Result<void> holds = check_planting(spec, world); !holds) return holds;
        }
        if (spec.name != "discrete" || !world.is_mesh()) continue;
        for (const SettingKind& kind : kind_of(spec)->settings) {
            if (is_of_whole_meshes(kind.name) || setting(spec, std::string(kind.name)) == kind.otherwise) continue;
            return impossible("--method {}: {} is of chains of levels, and {} holds a mesh", named(spec), kind.name, world.name);
        }
    }
    return {};
}

}  // namespace overlook::measure
