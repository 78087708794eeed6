// The skins of plants: curves that grow, and sheets and stalks along them, with normals and texture coordinates at every corner.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <random>

#include "tools/bake/mesh.h"

namespace overlook::sample {

constexpr double kTurn_rad = 6.283185307179586;
constexpr double kGoldenAngle_rad = 2.399963229728653;  // a turn times (3 - sqrt 5) / 2

// Numbers as thrown, the same on every machine. One throw a statement: compilers differ in the order of arguments.
class Dice {
  public:
    explicit Dice(uint64_t seed) : random_(seed) {}
    double unit() { return double(random_() >> 11) * 0x1p-53; }  // in [0, 1)
    double between(double from, double to) { return from + (to - from) * unit(); }
    uint32_t below(uint32_t count) { return uint32_t(unit() * count); }

  private:
    std::mt19937_64 random_;
};

// A place on a curve. `along` and `face` have length 1 and stand at a right angle; a leaf's upper side looks to `face`.
struct Frame {
    glm::dvec3 at_m{0}, along{0, 0, 1}, face{0, -1, 0};
    glm::dvec3 side() const { return glm::cross(along, face); }
};

// `along` and `face` made of length 1, and `face` turned to stand at a right angle. They must not be parallel.
Frame frame_of(const glm::dvec3& at_m, const glm::dvec3& along, const glm::dvec3& face);
// Turned about its place by a rotation vector, in radians.
Frame turned(const Frame& frame, const glm::dvec3& rotation_rad);
// The rotation vector that turns `along` by an angle towards the ground, less the steeper it is.
glm::dvec3 droop(const Frame& frame, double angle_rad);

// A curve that grows from a frame in steps; turn says by which rotation vector it turns on its whole length, were it everywhere
// as it is at this share of it. Longer curves of the same turn are the same curve, larger.
class Spine {
  public:
    using Turn = std::function<glm::dvec3(double share, const Frame& frame)>;
    Spine(const Frame& from, double length_m, uint32_t steps, const Turn& turn);

    // Below 0 and above 1 it goes straight on.
    Frame at(double share) const;
    double length_m() const { return length_m_; }

  private:
    std::vector<Frame> frames_;
    double length_m_;
};

// Of a skin: where it lies, in metres and on its texture.
struct Place {
    glm::dvec3 at_m{0};
    glm::dvec2 uv{0};
};

// A strip along a spine. Widths must be above 0, so that no triangle is empty.
struct Blade {
    uint32_t rows = 8, columns = 2;
    std::function<double(double share)> half_width_m;
    std::function<double(double across, double share)> lift_m;  // towards the face; across is -1..1. None: flat
    glm::dvec2 uv_from{0, 0}, uv_to{1, 1};                      // at the foot's left corner and the tip's right one
};

// A round stalk along a spine, its texture's columns folded about it, so that they meet.
struct Stalk {
    uint32_t rings = 8, sides = 6;
    std::function<double(double share)> radius_m;
    glm::dvec2 uv_from{0, 0}, uv_to{1, 1};
    bool has_tip = false;  // closed by a fan at its end
};

class PlantMaker {
  public:
    using Places = std::function<Place(uint32_t row, uint32_t column)>;
    explicit PlantMaker(std::vector<mesh::Surface> surfaces) { mesh_.surfaces = std::move(surfaces); }

    // rows x columns squares; it faces where columns cross rows. Normals are smooth within it.
    void add_sheet(uint32_t surface, uint32_t rows, uint32_t columns, const Places& places);
    // rows x sides squares, closed round: columns run counter-clockwise seen from its last row.
    void add_round(uint32_t surface, uint32_t rows, uint32_t sides, const Places& places);
    // The same, and a fan from its last row to a tip.
    void add_round(uint32_t surface, uint32_t rows, uint32_t sides, const Places& places, const Place& tip);
    void add_blade(uint32_t surface, const Spine& spine, const Blade& blade);
    void add_stalk(uint32_t surface, const Spine& spine, const Stalk& stalk);

    size_t triangle_count() const { return mesh_.faces.size(); }
    const mesh::Mesh& mesh() const { return mesh_; }
    mesh::Mesh take() { return std::move(mesh_); }

  private:
    uint32_t add_grid(uint32_t surface, uint32_t rows, uint32_t columns, bool is_round, const Places& places);
    void add_face(uint32_t surface, uint32_t a, uint32_t b, uint32_t c);
    void add_corner(const Place& place, const glm::dvec3& normal);

    mesh::Mesh mesh_;
};

}  // namespace overlook::sample
