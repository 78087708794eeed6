#include "formats/caveclod_layout.h"
#include "tests/corrupt/discrete_fixtures.h"
#include "tests/corrupt/terrain_parts.h"

namespace overlook::discrete::fixtures {
namespace {

using container::fixtures::RawSection;

void put_u32(Bytes& bytes, size_t at, size_t value) {
    store_le<uint32_t>(bytes, at, uint32_t(value));
}

Vertex vertex_at(uint16_t x, uint16_t y, uint16_t z, uint16_t part = 0) {
    Vertex vertex;
    vertex.position = {x, y, z}, vertex.part = part, vertex.normal = {0, -32767};
    return vertex;
}

}  // namespace

Chain pyramid() {
    Chain chain;
    chain.origin_m = {-2, -2, 0}, chain.position_step_m = 1.0 / 1024, chain.uv_step = 1;
    chain.attributes.normals = true;
    chain.surfaces = {{"slate", {90, 96, 104, 255}, "", {}, false, 0.5f, false},
                      {"vane", {200, 40, 30, 255}, "", {}, false, 0.5f, true}};
    Level fine;
    fine.vertices = {vertex_at(0, 0, 0),
                     vertex_at(4096, 0, 0),
                     vertex_at(4096, 4096, 0),
                     vertex_at(0, 4096, 0),
                     vertex_at(2048, 2048, 4096),
                     vertex_at(1024, 2048, 4096, 1),
                     vertex_at(3072, 2048, 4096, 1),
                     vertex_at(2048, 2048, 4608, 1)};
    fine.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 5, 6, 7};
    fine.draws = {{0, 0, 12}, {1, 12, 3}};
    Level coarse;
    coarse.error_m = 4, coarse.lost_area_share = 0.25f, coarse.is_plain = true;
    coarse.vertices = {fine.vertices[0], fine.vertices[1], fine.vertices[4]};
    coarse.indices = {0, 1, 2};
    coarse.draws = {{0, 0, 3}};
    chain.levels = {fine, coarse};

    Part vane;
    vane.name = "vane", vane.pivot_m = {0, 0, 4};
    for (int quarter = 0; quarter < 5; ++quarter) {
        constexpr float kHalf = 0.70710678f;
        static constexpr float kTurns[5][2] = {{1, 0}, {kHalf, kHalf}, {0, 1}, {-kHalf, kHalf}, {-1, 0}};
        vane.at_s.push_back(float(quarter));
        vane.poses.push_back({glm::quat(kTurns[quarter][0], 0, 0, kTurns[quarter][1]), glm::vec3(0)});
    }
    chain.parts = {Part{}, vane};
    chain.clip_s = 4;
    chain.middle_m = {0, 0, 2}, chain.radius_m = 4;
    chain.visibility = {{Visibility::Lookup::paper, 2, 2, 1, 1.0f, {0, 64, 128, 192}}};
    return chain;
}

Chain boards() {
    Chain chain = pyramid();
    chain.surfaces.push_back({"billboards of level 1", {255, 255, 255, 255}, "billboards-1.png", {}, true, 0.5f, true});
    chain.surfaces.back().texture_bytes = {std::byte(1), std::byte(2)};
    chain.picture_count = 1;
    Level& level = chain.levels[1];
    level.rung = Rung::billboards, level.added_area_share = 0.5f, level.is_plain = false, level.draws[0].surface = 2;
    return chain;
}

void Pieces::lay_out(const std::vector<Level>& all) {
    levels.assign(40 * all.size(), std::byte(0));
    geometry.clear();
    for (size_t k = 0; k < all.size(); ++k) {
        LevelSize size;
        Bytes bytes = bytes_of_level(all[k], size);
        size_t at = 40 * k;
        put_u32(levels, at, size_t(all[k].rung)), put_u32(levels, at + 4, all[k].is_plain);
        store_f32(levels, at + 8, all[k].error_m), store_f32(levels, at + 12, all[k].lost_area_share);
        store_f32(levels, at + 36, all[k].added_area_share);
        put_u32(levels, at + 16, size.vertices), put_u32(levels, at + 20, size.indices), put_u32(levels, at + 24, size.draws);
        put_u32(levels, at + 28, size.vertex_bytes), put_u32(levels, at + 32, size.index_bytes);
        geometry.insert(geometry.end(), bytes.begin(), bytes.end());
    }
}

Pieces Pieces::of(const Chain& chain) {
    Pieces pieces;
    Bytes& info = pieces.info;
    info.resize(128);
    put_u32(info, 0, chain.levels.size()), put_u32(info, 4, chain.parts.size()), put_u32(info, 8, chain.surfaces.size());
    put_u32(info, 12, chain.visibility.size());
    put_u32(info, 16,
            size_t(chain.attributes.normals) | size_t(chain.attributes.uvs) << 1 | size_t(chain.attributes.colours) << 2);
    put_u32(info, 20, chain.picture_count);
    for (int axis = 0; axis < 3; ++axis) {
        store_f64(info, 24 + 8 * size_t(axis), chain.origin_m[axis]),
            store_f64(info, 80 + 8 * size_t(axis), chain.middle_m[axis]);
    }
    store_f64(info, 48, chain.position_step_m), store_f64(info, 56, chain.uv_low.x), store_f64(info, 64, chain.uv_low.y);
    store_f64(info, 72, chain.uv_step), store_f64(info, 104, chain.radius_m), store_f64(info, 112, chain.clip_s);
    store_f64(info, 120, chain.finest_error_m);
    pieces.lay_out(chain.levels);
    pieces.surfaces = caveclod::bytes_of_surfaces(chain.surfaces);
    pieces.parts = bytes_of_parts(chain.parts);
    pieces.visibility = bytes_of_visibility(chain.visibility);
    return pieces;
}

Bytes Pieces::file() const {
    std::vector<RawSection> sections;
    auto add = [&](std::string_view tag, uint32_t codec, const Bytes& raw) {
        if (tag == without) return;
        sections.push_back({tag, 1, codec, codec == 0 ? raw : terrain::fixtures::frame_of(raw), raw.size()});
    };
    add("DINF", 0, info), add("DLEV", levels_codec, levels), add("DGEO", 1, geometry), add("DSUR", 1, surfaces);
    add("DPRT", 1, parts);
    if (!visibility.empty()) add("DVIS", 1, visibility);
    Bytes file = container::fixtures::file_of(sections);
    store_le<uint32_t>(file, 32, kKind);
    container::fixtures::seal(file);
    return file;
}

}  // namespace overlook::discrete::fixtures
