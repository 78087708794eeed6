#include <algorithm>

#include "formats/caveclod_layout.h"
#include "formats/discrete_layout.h"

namespace overlook::discrete {
namespace {

using container::Codec;
using container::kMustUnderstand;

tl::unexpected<Error> refused(const std::string& text) {
    return tl::unexpected(Error{Exit::our_bug, fmt::format("a chain to write has {}", text)});
}

// What no reader would take; empty if there is nothing.
std::string fault_of_counts(const Chain& chain) {
    size_t changes = chain.levels.empty() ? 0 : chain.levels.size() - 1, visibilities = chain.visibility.size();
    if (chain.levels.empty() || chain.levels.size() > kMostLevels) return "no levels or too many";
    if (chain.parts.empty() || chain.parts.size() > kMostParts) return "no parts or too many";
    if (chain.surfaces.empty() || chain.surfaces.size() > kSurfacesMax) return "no surfaces or too many";
    if (visibilities > 1 && visibilities != changes) return "visibility for some of its changes only";
    for (const Level& level : chain.levels) {
        bool fits = !level.indices.empty() && level.indices.size() % 3 == 0 &&
                    std::max(level.indices.size(), level.vertices.size()) <= kCountMax;
        if (!fits) return "a level of too few or too many triangles";
    }
    for (const Part& part : chain.parts)
        if (part.poses.size() != part.at_s.size() || part.name.size() > kNameBytesMax)
            return "a part whose rows do not fit each other";
    for (const Visibility& v : chain.visibility)
        if (v.values.size() != uint64_t(v.width) * v.height * v.depth) return "visibility that does not fit its size";
    return "";
}

Fault fault_of(const Chain& chain) {
    if (Fault fault = fault_of_places(chain)) return fault;
    if (Fault fault = fault_of_errors(chain)) return fault;
    for (const Level& level : chain.levels) {
        if (Fault fault = fault_of_level(level, uint32_t(chain.parts.size()))) return fault;
        if (Fault fault = fault_of_draws(level, uint32_t(chain.surfaces.size()))) return fault;
    }
    if (Fault fault = fault_of_pictures(chain)) return fault;
    for (size_t p = 0; p < chain.parts.size(); ++p)
        if (Fault fault = fault_of_part(chain.parts[p], chain.clip_s, p == 0)) return fault;
    for (const Visibility& v : chain.visibility)
        if (Fault fault = fault_of_visibility(v)) return fault;
    return fault_of_sphere(chain);
}

std::vector<std::byte> info_bytes(const Chain& chain) {
    std::vector<std::byte> bytes(info_at::bytes, std::byte(0));
    auto put = [&](size_t at, size_t value) { store_le<uint32_t>(bytes, at, uint32_t(value)); };
    put(info_at::levels, chain.levels.size()), put(info_at::parts, chain.parts.size());
    put(info_at::surfaces, chain.surfaces.size()), put(info_at::visibilities, chain.visibility.size());
    put(info_at::attributes, (chain.attributes.normals ? kHasNormals : 0) | (chain.attributes.uvs ? kHasUvs : 0) |
                                 (chain.attributes.colours ? kHasColours : 0));
    put(info_at::pictures, chain.picture_count);
    for (int axis = 0; axis < 3; ++axis) {
        store_f64(bytes, info_at::origin_m + 8 * size_t(axis), chain.origin_m[axis]);
        store_f64(bytes, info_at::middle_m + 8 * size_t(axis), chain.middle_m[axis]);
    }
    for (int axis = 0; axis < 2; ++axis) store_f64(bytes, info_at::uv_low + 8 * size_t(axis), chain.uv_low[axis]);
    store_f64(bytes, info_at::position_step_m, chain.position_step_m), store_f64(bytes, info_at::uv_step, chain.uv_step);
    store_f64(bytes, info_at::radius_m, chain.radius_m), store_f64(bytes, info_at::clip_s, chain.clip_s);
    store_f64(bytes, info_at::finest_error_m, chain.finest_error_m);
    return bytes;
}

void store_entry(std::span<std::byte> entry, const Level& level, const LevelSize& size) {
    store_le<uint32_t>(entry, level_at::rung, uint32_t(level.rung));
    store_le<uint32_t>(entry, level_at::flags, level.is_plain ? kIsPlain : 0);
    store_f32(entry, level_at::error_m, level.error_m);
    store_f32(entry, level_at::lost_area_share, level.lost_area_share);
    store_f32(entry, level_at::added_area_share, level.added_area_share);
    store_le<uint32_t>(entry, level_at::vertices, size.vertices), store_le<uint32_t>(entry, level_at::indices, size.indices);
    store_le<uint32_t>(entry, level_at::draws, size.draws), store_le<uint32_t>(entry, level_at::vertex_bytes, size.vertex_bytes);
    store_le<uint32_t>(entry, level_at::index_bytes, size.index_bytes);
}

}  // namespace

Result<void> write(container::Writer& writer, const Chain& chain) {
    if (std::string text = fault_of_counts(chain); !text.empty()) return refused(text);
    if (Fault fault = fault_of(chain)) return refused(fmt::format("what breaks D{}: {}", fault.rule, fault.text));
    std::vector<std::byte> geometry, directory(chain.levels.size() * level_at::entry_bytes);
    for (size_t k = 0; k < chain.levels.size(); ++k) {
        LevelSize size;
        std::vector<std::byte> bytes = bytes_of_level(chain.levels[k], size);
        store_entry(std::span(directory).subspan(k * level_at::entry_bytes, level_at::entry_bytes), chain.levels[k], size);
        geometry.insert(geometry.end(), bytes.begin(), bytes.end());
    }
    if (geometry.size() > kGeometryBytesMax) return impossible("a chain of {} bytes is more than a file holds", geometry.size());
    auto add = [&](container::Tag tag, Codec codec, std::span<const std::byte> raw) {
        return writer.add(tag, kMustUnderstand, codec, raw);
    };
    if (auto added = add(kInfoTag, Codec::none, info_bytes(chain)); !added) return added;
    if (auto added = add(kLevelsTag, Codec::none, directory); !added) return added;
    if (auto added = add(kGeometryTag, Codec::zstd, geometry); !added) return added;
    if (auto added = add(kSurfacesTag, Codec::zstd, caveclod::bytes_of_surfaces(chain.surfaces)); !added) return added;
    if (auto added = add(kPartsTag, Codec::zstd, bytes_of_parts(chain.parts)); !added) return added;
    if (chain.visibility.empty()) return {};
    return add(kVisibilityTag, Codec::zstd, bytes_of_visibility(chain.visibility));
}

}  // namespace overlook::discrete
