#include <algorithm>
#include <array>
#include <cmath>

#include "formats/discrete_layout.h"

namespace overlook::discrete {
namespace {

constexpr std::array<std::string_view, 19> kRules{
    "The file's kind is DISC and it has the sections DINF, DLEV, DGEO, DSUR and DPRT.",
    "DINF is 128 bytes long.",
    "There are 1 to 32 levels, 1 to 1,024 parts, 1 to 65,536 surfaces, and visibility for each change of levels, or once, or not "
    "at all.",
    "Places, steps, radius, clip and finest error are finite and in their ranges.",
    "The attributes are known ones.",
    "DSUR decodes to exactly the surfaces stated, with printable names of at most 4,096 bytes.",
    "DLEV, uncompressed, has an entry of 40 bytes for each level, of a known rung, with a triangle at least and no more than its "
    "bytes can hold.",
    "DGEO is its levels, one after the other, the last ending with it.",
    "Level 0 has no error and has lost and added nothing; errors and shares are finite and not negative, lost shares at most 1, "
    "and neither errors nor lost shares fall from level to level.",
    "A level's vertices and triangles decode to exactly those stated.",
    "A vertex belongs to a part that is there, its normal to the octahedron.",
    "An index names a vertex that is there.",
    "Draws are of surfaces that are there, each of whole triangles, and hold all indices of their level.",
    "DPRT decodes to exactly the parts stated, with printable names of at most 4,096 bytes.",
    "Part 0 rests; the keys of any other, if it has some, ascend from 0 to the clip's end.",
    "A pose's turn is of length 1, its move and its part's pivot are at most 1e9 metres.",
    "What rests lies within the sphere.",
    "DVIS decodes to exactly the pictures and volumes stated, of 1 to 4,096 values a side and 2^24 in all, pictures 1 deep, with "
    "a period above 0.",
    "Pictures of billboards are the last of the surfaces, alpha-masked, each with a picture, and drawn by levels of billboards "
    "alone.",
};

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

}  // namespace

std::string_view rule_text(int rule) {
    return rule >= 1 && rule <= rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int rule_count() {
    return int(kRules.size());
}

Fault fault_of_places(const Chain& chain) {
    bool is_fine = true;
    for (int axis = 0; axis < 3; ++axis)
        is_fine = is_fine && is_between(chain.origin_m[axis], -1e12, 1e12) && is_between(chain.middle_m[axis], -1e12, 1e12);
    for (int axis = 0; axis < 2; ++axis) is_fine = is_fine && is_between(chain.uv_low[axis], -1e9, 1e9);
    is_fine = is_fine && is_between(chain.position_step_m, 1e-12, 1e9) && is_between(chain.uv_step, 0, 1e9) &&
              is_between(chain.radius_m, 0, 1e12) && is_between(chain.clip_s, 0, kMostClip_s) &&
              is_between(chain.finest_error_m, 0, 1e12);
    if (is_fine) return {};
    return {4, fmt::format("steps of {} m from ({}, {}, {}), of uv {}, a radius of {} m, a clip of {} s, an error of {} m",
                           chain.position_step_m, chain.origin_m.x, chain.origin_m.y, chain.origin_m.z, chain.uv_step,
                           chain.radius_m, chain.clip_s, chain.finest_error_m)};
}

Fault fault_of_errors(const Chain& chain) {
    float error_m = 0, lost = 0;
    for (size_t k = 0; k < chain.levels.size(); ++k) {
        const Level& level = chain.levels[k];
        bool is_in_order = level.error_m >= error_m && std::isfinite(level.error_m) && level.lost_area_share >= lost &&
                           level.lost_area_share <= 1 && level.added_area_share >= 0 && std::isfinite(level.added_area_share);
        bool is_whole = level.error_m == 0 && level.lost_area_share == 0 && level.added_area_share == 0;
        if (!is_in_order || (k == 0 && !is_whole))
            return {9, fmt::format("level {} has an error of {} m, has lost {} and added {}; the one before {} m and {}", k,
                                   level.error_m, level.lost_area_share, level.added_area_share, error_m, lost)};
        error_m = level.error_m, lost = level.lost_area_share;
    }
    return {};
}

Fault fault_of_level(const Level& level, uint32_t part_count) {
    for (size_t v = 0; v < level.vertices.size(); ++v) {
        const Vertex& vertex = level.vertices[v];
        if (vertex.part >= part_count)
            return {11, fmt::format("vertex {} belongs to part {}, there are {}", v, vertex.part, part_count)};
        if (vertex.normal[0] == -32768 || vertex.normal[1] == -32768)
            return {11, fmt::format("vertex {} has a normal of -32768", v)};
    }
    for (size_t i = 0; i < level.indices.size(); ++i)
        if (level.indices[i] >= level.vertices.size())
            return {12, fmt::format("index {} names vertex {}, there are {}", i, level.indices[i], level.vertices.size())};
    return {};
}

Fault fault_of_draws(const Level& level, uint32_t surface_count) {
    uint64_t next = 0;
    for (size_t d = 0; d < level.draws.size(); ++d) {
        const Draw& draw = level.draws[d];
        if (draw.surface >= surface_count)
            return {13, fmt::format("draw {} is of surface {}, there are {}", d, draw.surface, surface_count)};
        if (draw.first_index != next || draw.index_count == 0 || draw.index_count % 3 != 0)
            return {13,
                    fmt::format("draw {} has {} indices from {}; {} are before it", d, draw.index_count, draw.first_index, next)};
        next += draw.index_count;
    }
    if (next != level.indices.size()) return {13, fmt::format("its draws hold {} indices of {}", next, level.indices.size())};
    return {};
}

Fault fault_of_pictures(const Chain& chain) {
    if (chain.picture_count > chain.surfaces.size())
        return {19,
                fmt::format("{} pictures of billboards are stated, of {} surfaces", chain.picture_count, chain.surfaces.size())};
    size_t first = chain.surfaces.size() - chain.picture_count;
    for (size_t s = first; s < chain.surfaces.size(); ++s)
        if (!chain.surfaces[s].is_alpha_masked || chain.surfaces[s].texture_bytes.empty())
            return {19, fmt::format("surface {} is a picture of billboards without a mask or a picture", s)};
    for (size_t k = 0; k < chain.levels.size(); ++k)
        for (const Draw& draw : chain.levels[k].draws)
            if (draw.surface >= first && chain.levels[k].rung != Rung::billboards)
                return {19, fmt::format("level {} draws surface {}, a picture of billboards, and is of rung {}", k, draw.surface,
                                        uint32_t(chain.levels[k].rung))};
    return {};
}

Fault fault_of_part(const Part& part, double clip_s, bool rests) {
    auto is_near = [](const glm::vec3& v) { return std::abs(v.x) <= 1e9f && std::abs(v.y) <= 1e9f && std::abs(v.z) <= 1e9f; };
    if (rests && !part.at_s.empty()) return {15, "moves, and is the one that rests"};
    for (size_t key = 0; key < part.at_s.size(); ++key) {
        float at_s = part.at_s[key];
        bool is_in_order = key == 0 ? at_s == 0 : at_s > part.at_s[key - 1];
        bool is_whole = key + 1 < part.at_s.size() || at_s == float(clip_s);
        if (!is_in_order || !is_whole || !std::isfinite(at_s))
            return {15, fmt::format("has key {} at {} s, of a clip of {} s", key, at_s, clip_s)};
    }
    if (!is_near(part.pivot_m)) return {16, "has a pivot that is nowhere"};
    for (size_t key = 0; key < part.poses.size(); ++key) {
        const glm::quat& q = part.poses[key].turn;
        double length = std::sqrt(double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z);
        if (!(std::abs(length - 1) <= kTurnSlack) || !is_near(part.poses[key].move_m))
            return {16, fmt::format("has a pose at key {} whose turn is of length {}, or that moves too far", key, length)};
    }
    return {};
}

Fault fault_of_sphere(const Chain& chain) {
    double most_m = chain.radius_m * (1 + kSphereSlack) + kSphereSlack * chain.position_step_m;
    for (size_t k = 0; k < chain.levels.size(); ++k)
        for (size_t v = 0; v < chain.levels[k].vertices.size(); ++v) {
            const Vertex& vertex = chain.levels[k].vertices[v];
            double away_m = glm::distance(position_m(chain, vertex), chain.middle_m);
            if (chain.parts[vertex.part].at_s.empty() && !(away_m <= most_m))
                return {17, fmt::format("level {}: vertex {} is {} m from the middle, of a radius of {} m", k, v, away_m,
                                        chain.radius_m)};
        }
    return {};
}

Fault fault_of_visibility(const Visibility& v) {
    auto is_side = [](uint32_t side) { return side >= 1 && side <= kMostSide; };
    bool is_known = v.lookup == Visibility::Lookup::volume || (v.lookup == Visibility::Lookup::paper && v.depth == 1);
    bool is_sized =
        is_side(v.width) && is_side(v.height) && is_side(v.depth) && uint64_t(v.width) * v.height * v.depth <= kMostValues;
    if (is_known && is_sized && v.period_m > 0 && std::isfinite(v.period_m)) return {};
    return {18, fmt::format("is of kind {}, {} x {} x {}, with a period of {} m", uint32_t(v.lookup), v.width, v.height, v.depth,
                            v.period_m)};
}

}  // namespace overlook::discrete
