// Baked chains of discrete levels of detail: a few whole representations of one thing, finest first, each with a bound of how far
// it lies from the finest, drawn by the thousand (runtime/discrete).
//
// Based on: J. Clark, Hierarchical Geometric Models for Visible Surface Algorithms, 1976; D. Scherzer, M. Wimmer, Frame
// Sequential Interpolation for Discrete Level-of-Detail Rendering, 2008 (visibility textures).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/result.h"

namespace overlook::discrete {

constexpr container::Tag kKind = container::tag("DISC");
constexpr uint32_t kMostLevels = 32;
constexpr uint32_t kMostParts = 1024;

// As it is stored and as it lies on the graphics card.
struct Vertex {
    std::array<uint16_t, 3> position{0, 0, 0};          // steps of Chain::position_step_m from origin_m, at rest
    uint16_t part = 0;                                  // moves with parts[part]
    std::array<int16_t, 2> normal{0, 0};                // octahedral, -32767..32767
    std::array<uint16_t, 2> uv{0, 0};                   // steps of uv_step from uv_low
    std::array<uint8_t, 4> colour{255, 255, 255, 255};  // sRGB-encoded, alpha linear; multiplies the surface's

    bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 20);

// Triangles of one surface; those of a level stand one after the other.
struct Draw {
    uint32_t surface = 0, first_index = 0, index_count = 0;

    bool operator==(const Draw&) const = default;
};

enum class Rung : uint32_t {
    mesh = 0,        // triangles of the thing itself, or made by hand
    billboards = 1,  // flat cards with pictures of it
    impostor = 2,    // one card for each of several directions, turned to the viewer
};

struct Level {
    Rung rung = Rung::mesh;
    // Bounds the two-sided distance between what is drawn and level 0, whatever the clip's time; 0 of level 0. Never less than
    // the finer level's.
    float error_m = 0;
    // Of level 0's area, what is lost beyond that (leaves that are gone as a whole): 0..1. Never less than the finer level's.
    float lost_area_share = 0;
    // Of level 0's area, what a level of billboards covers more of the view than level 0 does; as lost_area_share, >= 0.
    float added_area_share = 0;
    bool is_plain = false;  // drawn without texture and with one normal a face: a cheaper shader
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;  // three a triangle, in the order of draws, counter-clockwise seen from outside
    std::vector<Draw> draws;

    uint64_t triangle_count() const { return indices.size() / 3; }
    bool operator==(const Level&) const = default;
};

// Where a part is at a time: first turned about the world's origin (in Part::poses: about its pivot), then moved, relative to
// where it is at rest.
struct Pose {
    glm::quat turn{1, 0, 0, 0};  // of length 1
    glm::vec3 move_m{0};

    bool operator==(const Pose&) const = default;
};

// What moves as one. Part 0 is there always and rests.
struct Part {
    std::string name;         // UTF-8
    std::vector<float> at_s;  // keys, ascending from 0 to the clip's end; none: it rests
    std::vector<Pose> poses;  // [at_s]; between two, turned along the shorter arc and moved evenly (slerp, lerp)
    glm::vec3 pivot_m{0};     // what its poses turn about, in the chain's own world

    bool operator==(const Part&) const = default;
};
// About the world's origin, whatever the part's pivot: place = turn * place at rest + move_m. The clip repeats. at_s: any finite
// time.
Pose pose_at(const Part& part, double clip_s, double at_s);

// Which parts of a thing come first when a level fades in: a number 0..255 for each place of the thing at rest.
struct Visibility {
    enum class Lookup : uint32_t {
        paper = 0,   // of a picture: (x + z, y + z) / period_m, repeated (Scherzer and Wimmer 2008, 3.3)
        volume = 1,  // of a volume over the box from origin_m on, period_m on each side, beyond it as at its border
    };
    Lookup lookup = Lookup::paper;
    uint32_t width = 0, height = 0, depth = 0;  // depth 1 of a picture; 1..4096 each, 2^24 in all at most
    float period_m = 1;                         // > 0
    std::vector<uint8_t> values;                // [depth, height, width]

    bool operator==(const Visibility&) const = default;
};

struct Chain {
    glm::dvec3 origin_m{0};
    double position_step_m = 0;  // > 0
    glm::dvec2 uv_low{0};
    double uv_step = 0;
    caveclod::Attributes attributes;
    std::vector<caveclod::Surface> surfaces;  // of all levels
    // The last so many surfaces are pictures of billboards: alpha-masked, seen from both sides, drawn by such levels alone.
    uint32_t picture_count = 0;
    std::vector<Level> levels;  // 1..kMostLevels, finest first
    std::vector<Part> parts{Part{}};
    double clip_s = 0;  // how long it is; 0: nothing moves
    // Bounds the two-sided distance between level 0 and what it was baked from.
    double finest_error_m = 0;
    // All that is ever drawn, of any level at any time, lies within radius_m of middle_m (metres in the chain's own world).
    glm::dvec3 middle_m{0};
    double radius_m = 0;
    // [levels - 1] of the change between level k and k + 1, or one for all of them, or none.
    std::vector<Visibility> visibility;
};

// Where a vertex rests, in the chain's own world.
inline glm::dvec3 position_m(const Chain& chain, const Vertex& vertex) {
    return chain.origin_m + chain.position_step_m * glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]);
}

// Adds the chain's sections to a baked file. Vertices and indices go through meshoptimizer's codecs; a triangle may come back
// with its corners turned round (b, c, a). Same chain, same bytes. Exit::our_bug if it breaks a rule of its own: "a chain to
// write has ...".
Result<void> write(container::Writer& writer, const Chain& chain);

// The file may be hostile; every failure is Exit::bad_input and names file, rule and place: "tree.ovl: D7: level 2: vertex 9
// belongs to part 4, there are 3". Exit::impossible if there is not so much memory.
Result<Chain> read(const std::string& path);
Result<Chain> read(const container::Reader& file);

// What each rule of these sections says, as container::rule_text.
std::string_view rule_text(int rule);
int rule_count();

}  // namespace overlook::discrete
