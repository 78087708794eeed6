#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/numbers.h"
#include "formats/terrain.h"
#include "tools/baked/info_discrete.h"
#include "tools/baked/info_ground.h"
#include "tools/baked/info_images.h"
#include "tools/baked/info_scene.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

ordered_json sections_json(const container::Reader& file) {
    ordered_json sections = ordered_json::array();
    for (const container::Section& section : file.sections())
        sections.push_back({{"tag", container::tag_text(section.tag)},
                            {"offset", section.offset},
                            {"stored_bytes", section.stored_bytes},
                            {"raw_bytes", section.raw_bytes},
                            {"codec", section.codec == container::Codec::zstd ? "zstd" : "none"},
                            {"must_understand", (section.flags & container::kMustUnderstand) != 0}});
    return sections;
}

ordered_json provenance_json(const container::Provenance& provenance) {
    ordered_json json{{"program", provenance.program},
                      {"version", provenance.version},
                      {"options", ordered_json::object()},
                      {"inputs", ordered_json::array()}};
    for (const auto& [name, value] : provenance.options) json["options"][name] = value;
    for (const container::InputIdentity& input : provenance.inputs)
        json["inputs"].push_back({{"name", input.name}, {"xxh3_128", input.hash}});
    return json;
}

ordered_json terrain_json(const terrain::Terrain& terrain, uint64_t terrain_bytes) {
    const terrain::Frame& frame = terrain.frame;
    uint64_t samples = terrain.heights.size(), voids = 0;
    int32_t low = terrain::kVoid, high = terrain::kVoid;
    for (int32_t height : terrain.heights) {
        if (height == terrain::kVoid) {
            ++voids;
            continue;
        }
        if (low == terrain::kVoid || height < low) low = height;
        if (high == terrain::kVoid || height > high) high = height;
    }
    auto metres = [&](int32_t steps) { return terrain.height_offset_m + terrain.height_step_m * steps; };
    ordered_json json{{"columns", terrain.shape.width},
                      {"rows", terrain.shape.height},
                      {"metres_per_column", frame.metres_per_column},
                      {"metres_per_row", frame.metres_per_row},
                      {"lowest_m", low == terrain::kVoid ? ordered_json() : ordered_json(metres(low))},
                      {"highest_m", high == terrain::kVoid ? ordered_json() : ordered_json(metres(high))},
                      {"voids", voids},
                      {"height_step_m", terrain.height_step_m},
                      {"finest_error_m", terrain.finest_error_m},
                      {"coarsest_error_m", terrain.error_m[terrain::kMustSplit - 1]},
                      {"bytes_per_sample", double(terrain_bytes) / double(samples)},
                      {"texture_px", {terrain.texture.width, terrain.texture.height}}};
    if (frame.is_georeferenced)
        json["place"] = {{"crs", frame.crs},
                         {"centre_latitude_deg", frame.centre_latitude_deg},
                         {"centre_longitude_deg", frame.centre_longitude_deg},
                         {"convergence_deg", frame.convergence_deg},
                         {"scale_distortion", frame.scale_distortion}};
    return json;
}

ordered_json mesh_json(const caveclod::Hierarchy& h, uint64_t file_bytes) {
    float coarsest_m = h.finest_error_m;
    for (float error_m : h.error_m) coarsest_m = std::max(coarsest_m, error_m);
    uint16_t packed = 0;
    for (uint16_t id : h.group_packed) packed = std::max(packed, id);
    ordered_json surfaces = ordered_json::array();
    for (const caveclod::Surface& surface : h.surfaces)
        surfaces.push_back(
            {{"name", surface.name}, {"texture", surface.texture}, {"texture_bytes", surface.texture_bytes.size()}});
    return {{"triangles", h.face_positions.size()},
            {"triangles_coarsest", h.base_face_count},
            {"positions", h.positions_m.size()},
            {"render_vertices", h.vertices.size()},
            {"splits", h.split_count()},
            {"needs", h.needs.size()},
            {"surface_groups", h.group_surface.size()},
            {"packed_ids", h.group_packed.empty() ? 0 : packed + 1},
            {"surfaces", surfaces},
            {"finest_error_m", double(h.finest_error_m)},
            {"coarsest_error_m", double(coarsest_m)},
            {"bits_per_triangle", 8.0 * double(file_bytes) / double(std::max<size_t>(1, h.face_positions.size()))}};
}

void print_mesh(const ordered_json& m) {
    fmt::print("mesh: {} triangles, {} at the coarsest; {} positions, {} render vertices\n",
               with_commas(m["triangles"].get<uint64_t>()), with_commas(m["triangles_coarsest"].get<uint64_t>()),
               with_commas(m["positions"].get<uint64_t>()), with_commas(m["render_vertices"].get<uint64_t>()));
    fmt::print("surfaces: {}, in {} groups with {} ids\n", m["surfaces"].size(), m["surface_groups"].get<uint64_t>(),
               m["packed_ids"].get<uint64_t>());
    fmt::print("promise: any error from {:.4g} m (finest) to {:.4g} m (coarsest), two-sided, against the source\n",
               m["finest_error_m"].get<double>(), m["coarsest_error_m"].get<double>());
    fmt::print("size: {:.1f} bits a triangle\n", m["bits_per_triangle"].get<double>());
}

// What a file of Wang tiles has; nothing where it is of another kind.
struct Planted {
    std::optional<wang_ldi::PlantedTiles> ground;
    std::optional<wang_ldi::ImageReader> images;
    std::optional<wang_ldi::TextureSet> textures;
    std::optional<wang_ldi::Scene> scene;
};
// Adds what it says of itself to `json`.
Result<Planted> read_planted(const container::Reader& file, ordered_json& json) {
    Planted planted;
    if (file.kind() != wang_ldi::kKind) return planted;
    auto ground = wang_ldi::read(file);
    if (!ground) return tl::unexpected(ground.error());
    json["ground"] = ordered_json::parse(ground_json(*ground));
    planted.ground = std::move(*ground);
    if (file.find(container::tag("WLDI"))) {
        auto opened = wang_ldi::ImageReader::open(file);
        if (!opened) return tl::unexpected(opened.error());
        json["images"] = ordered_json::parse(images_json(*opened));
        auto far = wang_ldi::has_textures(file) ? wang_ldi::read_textures(file, opened->set()) : wang_ldi::TextureSet();
        if (!far) return tl::unexpected(far.error());
        planted.images = std::move(*opened);
        if (far->texture_count() > 0)
            json["textures"] = ordered_json::parse(textures_json(*far)), planted.textures = std::move(*far);
    }
    if (wang_ldi::has_scene(file)) {
        auto scene = wang_ldi::read_scene(file, uint32_t(planted.ground->set.tiles.size()));
        if (!scene) return tl::unexpected(scene.error());
        json["scene"] = ordered_json::parse(scene_json(file, *scene));
        planted.scene = std::move(*scene);
    }
    return planted;
}

void print_text(const ordered_json& json, const std::optional<discrete::Chain>& chain, const container::Reader& file,
                const Planted& planted) {
    fmt::print("{}: {}, {} bytes, format {}.{}\n", json["file"].get<std::string>(), json["kind"].get<std::string>(),
               json["bytes"].get<uint64_t>(), container::kMajor, container::kMinor);
    for (const ordered_json& section : json["sections"])
        fmt::print("  {}  {:>10} bytes at {:>10}, {:>10} raw, {}\n", section["tag"].get<std::string>(),
                   section["stored_bytes"].get<uint64_t>(), section["offset"].get<uint64_t>(),
                   section["raw_bytes"].get<uint64_t>(), section["codec"].get<std::string>());
    if (json.contains("terrain")) {
        const ordered_json& t = json["terrain"];
        fmt::print("terrain: {} x {} samples, cells {:.4g} x {:.4g} m, {:.4g} x {:.4g} km\n", t["columns"].get<uint32_t>(),
                   t["rows"].get<uint32_t>(), t["metres_per_column"].get<double>(), t["metres_per_row"].get<double>(),
                   (t["columns"].get<uint32_t>() - 1) * t["metres_per_column"].get<double>() / 1000,
                   (t["rows"].get<uint32_t>() - 1) * t["metres_per_row"].get<double>() / 1000);
        if (!t["lowest_m"].is_null())
            fmt::print("heights: {:.6g} .. {:.6g} m in steps of {:.4g} m, {} voids\n", t["lowest_m"].get<double>(),
                       t["highest_m"].get<double>(), t["height_step_m"].get<double>(), t["voids"].get<uint64_t>());
        fmt::print("promise: any error from {:.4g} m (finest) to {:.4g} m (coarsest), against every sample\n",
                   t["finest_error_m"].get<double>(), t["coarsest_error_m"].get<double>());
        fmt::print("size: {:.2f} bytes a sample without the texture ({} x {} px)\n", t["bytes_per_sample"].get<double>(),
                   t["texture_px"][0].get<uint32_t>(), t["texture_px"][1].get<uint32_t>());
        if (t.contains("place"))
            fmt::print("place: {} about latitude {:.6f}, longitude {:.6f}; cells true to {:.3f} %\n",
                       t["place"]["crs"].get<std::string>(), t["place"]["centre_latitude_deg"].get<double>(),
                       t["place"]["centre_longitude_deg"].get<double>(), 100 * t["place"]["scale_distortion"].get<double>());
    }
    if (json.contains("mesh")) print_mesh(json["mesh"]);
    if (chain) print_chain(*chain);
    if (planted.ground) print_ground(*planted.ground);
    if (planted.images) print_images(*planted.images);
    if (planted.textures) print_textures(*planted.textures);
    if (planted.scene) print_scene(file, *planted.scene);
    const ordered_json& p = json["provenance"];
    fmt::print("baked by: {} {}", p["program"].get<std::string>(), p["version"].get<std::string>());
    for (const auto& [name, value] : p["options"].items()) fmt::print(" --{} {}", name, value.get<std::string>());
    fmt::print("\n");
    for (const ordered_json& input : p["inputs"])
        fmt::print("from: {} (xxh3-128 {})\n", input["name"].get<std::string>(), input["xxh3_128"].get<std::string>());
}

// What sections of these tags are stored in, or all others.
uint64_t bytes_of_sections(const container::Reader& file, std::initializer_list<container::Tag> tags, bool is_others = false) {
    uint64_t bytes = 0;
    for (const container::Section& section : file.sections()) {
        bool is_named = std::find(tags.begin(), tags.end(), section.tag) != tags.end();
        if (is_named != is_others) bytes += section.stored_bytes;
    }
    return bytes;
}

// What a terrain or a mesh says of itself.
Result<void> add_surface(const container::Reader& file, ordered_json& json) {
    if (file.kind() == terrain::kKind) {
        auto read = terrain::read(file);
        if (!read) return tl::unexpected(read.error());
        json["terrain"] = terrain_json(
            *read, bytes_of_sections(file, {container::tag("TBLK"), container::tag("TDIR"), container::tag("TINF")}));
    }
    if (file.kind() == caveclod::kKind) {
        auto read = caveclod::read(file);
        if (!read) return tl::unexpected(read.error());
        json["mesh"] = mesh_json(*read, bytes_of_sections(file, {container::tag("MSUR")}, true));  // without textures
    }
    return {};
}

Error no_sheet(const std::string& file) {
    return {Exit::bad_command, fmt::format("{}: there is a sheet of ground of Wang tiles only; leave --sheet out", file)};
}

}  // namespace

int info(const InfoArgs& args, const command::Common& common) {
    auto file = container::Reader::open(args.file);
    if (!file) return command::fail("baked info", file.error());
    auto provenance = file->provenance();
    if (!provenance) return command::fail("baked info", provenance.error());
    ordered_json json{{"file", args.file},
                      {"kind", container::tag_text(file->kind())},
                      {"bytes", file->file_bytes()},
                      {"sections", sections_json(*file)}};
    if (auto added = add_surface(*file, json); !added) return command::fail("baked info", added.error());
    std::optional<discrete::Chain> chain;
    if (file->kind() == discrete::kKind) {
        auto read = discrete::read(*file);
        if (!read) return command::fail("baked info", read.error());
        json["chain"] = ordered_json::parse(chain_json(*read));
        if (!common.json) chain = std::move(*read);
    }
    auto planted = read_planted(*file, json);
    if (!planted) return command::fail("baked info", planted.error());
    if (!args.sheet.empty()) {
        if (!planted->ground) return command::fail("baked info", no_sheet(args.file));
        auto written = write_sheet(args.file, *planted->ground, planted->images ? &*planted->images : nullptr,
                                   planted->textures ? &*planted->textures : nullptr, args.sheet);
        if (!written) return command::fail("baked info", written.error());
    }
    json["provenance"] = provenance_json(*provenance);
    if (common.json)
        fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    else
        print_text(json, chain, *file, *planted);
    return int(Exit::done);
}

}  // namespace overlook::baked
