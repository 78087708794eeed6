#include "runtime/wang_ldi/plant_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "formats/caveclod_octahedral.h"
#include "formats/srgb.h"
#include "runtime/discrete/poses.h"

namespace overlook::wang_ldi {
namespace {

float linear_of(uint8_t encoded) {
    return float(linear_from_srgb_code(encoded));
}

uint16_t stored(float share) {
    return uint16_t(std::lround(65535 * std::clamp(share, 0.0f, 1.0f)));
}

// Red, green, blue, opacity.
using Light = std::array<float, 4>;

// at(x, y): its Light.
template <class At>
Skin::Level level_of(uint32_t width, uint32_t height, const At& at) {
    Skin::Level level{width, height, {}};
    level.texels.reserve(size_t(width) * height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            Light of = at(x, y);
            level.texels.push_back({stored(of[0]), stored(of[1]), stored(of[2]), stored(of[3])});
        }
    return level;
}

// What a texel at `at` of half of `from`, rounded down, covers of it, and how much of each.
struct Cover {
    uint32_t first = 0, count = 1;
    std::array<float, 3> shares{1, 0, 0};
};
Cover cover_of(uint32_t at, uint32_t from) {
    if (from == 1) return {};
    if (from % 2 == 0) return {2 * at, 2, {0.5f, 0.5f, 0}};
    auto all = float(from), half = float(from / 2);
    return {2 * at, 3, {(half - float(at)) / all, half / all, (float(at) + 1) / all}};
}

template <class At>
Skin::Level half_of(uint32_t width, uint32_t height, const At& at) {
    return level_of(std::max(width / 2, 1u), std::max(height / 2, 1u), [&](uint32_t x, uint32_t y) {
        Cover right = cover_of(x, width), down = cover_of(y, height);
        Light sum{};
        for (uint32_t j = 0; j < down.count; ++j)
            for (uint32_t i = 0; i < right.count; ++i) {
                Light of = at(right.first + i, down.first + j);
                for (size_t c = 0; c < 4; ++c) sum[c] += right.shares[i] * down.shares[j] * of[c];
            }
        return sum;
    });
}

Skin::Level half_of(const Skin::Level& level) {
    return half_of(level.width, level.height, [&](uint32_t x, uint32_t y) {
        const auto& of = level.texels[size_t(y) * level.width + x];
        return Light{float(of[0]) / 65535, float(of[1]) / 65535, float(of[2]) / 65535, float(of[3]) / 65535};
    });
}

void add_vertex(const discrete::Chain& chain, const discrete::Vertex& vertex, bool has_normals, ShapeLevel& level) {
    glm::dvec3 at = discrete::position_m(chain, vertex);
    level.x_m.push_back(float(at.x)), level.y_m.push_back(float(at.y)), level.z_m.push_back(float(at.z));
    if (has_normals) {
        glm::vec3 normal(caveclod::vector_of_octahedral(glm::dvec2(vertex.normal[0], vertex.normal[1]) / 32767.0));
        level.normals.push_back({normal.x, normal.y, normal.z});
    }
    const auto& c = vertex.colour;
    level.tints.push_back({linear_of(c[0]), linear_of(c[1]), linear_of(c[2]), float(c[3]) / 255});
    level.uvs.push_back(
        {float(chain.uv_low.x + vertex.uv[0] * chain.uv_step), float(chain.uv_low.y + vertex.uv[1] * chain.uv_step)});
}

CornerSides sides_of(const ShapeLevel& level, const ShapeBunch& bunch, const uint16_t* corners) {
    auto vertex = [&](int c) { return bunch.first_vertex + corners[c]; };
    auto at = [&](int c) { return glm::vec3(level.x_m[vertex(c)], level.y_m[vertex(c)], level.z_m[vertex(c)]); };
    glm::vec3 face = glm::cross(at(1) - at(0), at(2) - at(0));
    CornerSides sides = 0;
    for (int c = 0; c < 3; ++c) {
        const auto& n = level.normals[vertex(c)];
        sides = CornerSides(sides | (glm::dot(face, glm::vec3(n[0], n[1], n[2])) >= 0) << c);
    }
    return sides;
}

void find_box(const ShapeLevel& level, ShapeBunch& bunch) {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (uint32_t v = bunch.first_vertex; v < bunch.first_vertex + bunch.vertex_count; ++v) {
        glm::vec3 at(level.x_m[v], level.y_m[v], level.z_m[v]);
        low = glm::min(low, at), high = glm::max(high, at);
    }
    if (bunch.vertex_count > 0) bunch.middle_m = (low + high) / 2.0f, bunch.half_m = (high - low) / 2.0f;
}

// Triangles [begin, end) of all indices, which are of one skin.
void add_bunch(const discrete::Chain& chain, const discrete::Level& from, uint32_t begin, uint32_t end, uint32_t skin,
               ShapeLevel& level) {
    bool has_normals = chain.attributes.normals && !from.is_plain;
    ShapeBunch bunch;
    bunch.skin = skin;
    bunch.first_vertex = uint32_t(level.x_m.size()), bunch.first_index = uint32_t(level.indices.size());
    std::map<uint32_t, uint16_t> own;
    for (uint32_t i = begin; i < end; ++i) {
        auto [at, is_new] = own.try_emplace(from.indices[i], uint16_t(own.size()));
        if (is_new) add_vertex(chain, from.vertices[from.indices[i]], has_normals, level);
        level.indices.push_back(at->second);
    }
    bunch.vertex_count = uint32_t(own.size()), bunch.index_count = end - begin;
    find_box(level, bunch);
    for (uint32_t i = 0; has_normals && i < bunch.index_count; i += 3)
        level.sides.push_back(sides_of(level, bunch, &level.indices[bunch.first_index + i]));
    level.bunches.push_back(bunch);
}

}  // namespace

void Skin::add_level(uint32_t width, uint32_t height, std::span<const uint8_t> rgba, const caveclod::Surface& surface) {
    auto at = [&](uint32_t x, uint32_t y) {
        const uint8_t* of = rgba.data() + 4 * (size_t(y) * width + x);
        auto colour = [&](size_t c) { return linear_of(of[c]) * linear_of(surface.colour[c]); };
        return Light{colour(0), colour(1), colour(2), float(of[3]) / 255 * float(surface.colour[3]) / 255};
    };
    bool fits = size_t(width) * height <= kMostTexels;
    levels.push_back(fits ? level_of(width, height, at) : half_of(width, height, at));
    while (size_t(levels.back().width) * levels.back().height > kMostTexels) levels.back() = half_of(levels.back());
    alpha_cutoff = surface.is_alpha_masked ? surface.alpha_cutoff : 0, is_two_sided = surface.is_two_sided;
}

void Skin::add_halves() {
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(half_of(levels.back()));
}

Skin plain_skin(const caveclod::Surface& surface) {
    const std::array<uint8_t, 4> white{255, 255, 255, 255};
    Skin skin;
    skin.add_level(1, 1, white, surface);
    return skin;
}

bool can_be_shaped(const discrete::Chain& chain) {
    return !discrete::is_animated(chain) && chain.picture_count == 0;
}

PlantShape shape_of(const discrete::Chain& chain, std::vector<Skin> skins) {
    PlantShape shape;
    auto surfaces = uint32_t(skins.size());
    shape.skins = std::move(skins);
    for (const caveclod::Surface& surface : chain.surfaces) shape.skins.push_back(plain_skin(surface));
    for (const discrete::Level& from : chain.levels) {
        ShapeLevel& level = shape.levels.emplace_back();
        for (const discrete::Draw& draw : from.draws)
            for (uint32_t i = 0; i < draw.index_count; i += 3 * kMostInBunch)
                add_bunch(chain, from, draw.first_index + i, draw.first_index + std::min(i + 3 * kMostInBunch, draw.index_count),
                          draw.surface + (from.is_plain ? surfaces : 0), level);
        level.all.vertex_count = uint32_t(level.x_m.size());
        find_box(level, level.all);
    }
    return shape;
}

}  // namespace overlook::wang_ldi
