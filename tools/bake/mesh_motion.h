// What of a mesh moves: rigid parts, each with keys of where it is. Skins and morphs are no part of it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>
#include <vector>

namespace overlook::mesh {

struct Motion {
    // A place p at rest lies at pivot + turn (p - pivot) + move.
    struct Key {
        double at_s = 0;
        glm::dquat turn{1, 0, 0, 0};  // of length 1
        glm::dvec3 move_m{0};
    };
    struct Part {
        std::string name;
        glm::dvec3 pivot_m{0};
        std::vector<Key> keys;  // two at least, ascending from 0 to clip_s; turned and moved evenly between
    };

    double clip_s = 0;
    std::vector<Part> parts;  // part i + 1; part 0 is all that rests
    // Triangles of the file from `first` on belong to a part, up to the next range's first. Ascending.
    std::vector<std::pair<uint32_t, uint32_t>> ranges;

    bool is_empty() const { return parts.empty(); }
    // Of a triangle by its number in the file (Mesh::face_source).
    uint32_t part_of(uint32_t triangle) const;
};

// (x, y, z) becomes (x, -z, y), in all keys and pivots.
void stand_up(Motion& motion);
// All lengths times scale, > 0.
void scale(Motion& motion, double scale);

}  // namespace overlook::mesh
