// Which level of a chain an instance wants, for a camera.
//
// Based on: T. Funkhouser, C. Sequin, Adaptive Display Algorithm for Interactive Frame Rates, 1993 (size, distance from the
// frame's middle); D. Luebke et al., Level of Detail for 3D Graphics, 2002 (hysteresis). Different here: the default is a bound
// of the displacement in pixels that holds anywhere in the frame.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/discrete.h"
#include "formats/scene.h"
#include "runtime/discrete/settings.h"
#include "runtime/discrete/split.h"
#include "runtime/view/camera.h"
#include "runtime/view/pixel_error.h"

namespace overlook::discrete {

struct LevelFacts {
    double error_m = 0;
    // Lost or added area as a displacement: of level 0's area A (each triangle once) and the greater share s, s A / 2 is seen on
    // the mean over all directions, which is what the outline of the sphere round the thing, of radius r, sweeps when it moves by
    // s A / (4 pi r).
    double area_error_m = 0;
    uint64_t triangle_count = 0;
    std::vector<Bunch> bunches;  // of all triangles
};

// What has to be known of a chain to choose by, in its own world.
struct ChainFacts {
    std::vector<LevelFacts> levels;
    glm::dvec3 middle_m{0};
    double radius_m = 0;
};
// O(triangles of level 0).
ChainFacts facts_of(const Chain& chain);

// A chain stood somewhere.
struct Placement {
    glm::dvec3 translation_m{0};
    double cosine = 1, sine = 0;  // of the turn about z
    double scale = 1;

    glm::dvec3 turned(const glm::dvec3& own_m) const {
        return {scale * (cosine * own_m.x - sine * own_m.y), scale * (sine * own_m.x + cosine * own_m.y), scale * own_m.z};
    }
    glm::dvec3 at(const glm::dvec3& own_m) const { return translation_m + turned(own_m); }
    bool operator==(const Placement&) const = default;
};
Placement placement_of(const scene::Transform& transform);
// Of each instance at that time of the flight, and all of them moved by `whole`; of no instances `whole` itself.
std::vector<Placement> placements_of(std::span<const scene::Instance> instances, const scene::Transform& whole,
                                     double time_s = 0);

// Where the near plane lies, metres before the eye, so near that nothing is cut off that can be seen of chains of such a radius
// (metres, of the chain) that stand there: 1e-5 of the least one's, half a metre at most. Depths are reversed floats, so this
// costs no precision. placements: at least one.
double near_plane_m(double radius_m, std::span<const Placement> placements);

// By these, levels do that are so many times as coarse: the error in pixels and the size are that many times as great, the
// distance that many times as small, so that all strains are divided by it. times > 0.
SelectSettings coarser(SelectSettings settings, double times);

// The level that an instance wants whose levels have these strains, divided by `times`: as Selector::wanted. now: one a level.
// ahead: as many, or none where nothing is known of what is ahead.
uint32_t wanted_level(const SelectSettings& settings, std::span<const double> now, std::span<const double> ahead,
                      std::optional<uint32_t> in_use, double times);

// Strains of levels, and who is in the frame, of one camera.
class Selector {
  public:
    // ahead: of the camera as it will be; what is wanted then is wanted now already. Null: nothing is known. Must outlive it.
    Selector(const ChainFacts& facts, const SelectSettings& settings, const view::Camera& camera,
             const Selector* ahead = nullptr);

    // False only if nothing of it can be in the picture.
    bool is_in_view(const Placement& placement) const;
    // True only if no side of the picture cuts it.
    bool is_within_sides(const Placement& placement) const;
    // Over 1: too coarse now. 0 of level 0.
    double strain(const Placement& placement, uint32_t level) const { return strain(sight_of(placement), level); }
    // The level that an instance wants which has `level`: the coarsest whose strain, now and ahead, allows it; with hysteresis,
    // which is ahead where that is known.
    uint32_t wanted(const Placement& placement, uint32_t level) const { return wanted_of(placement, level); }
    // The same without a level in use: the coarsest whose strain is at most refine_share.
    uint32_t wanted(const Placement& placement) const { return wanted_of(placement, std::nullopt); }
    // The strains of all its levels one after the other, now and, where that is known, ahead; each appended.
    void note_strains(const Placement& placement, std::vector<double>& now, std::vector<double>& ahead) const;
    bool knows_ahead() const { return ahead_ != nullptr; }
    // The displacement of what the level draws, in pixels, against level 0: a bound. 0 of level 0.
    double error_px(const Placement& placement, uint32_t level) const;
    // Metres at its middle that are a pixel.
    double pixel_m(const Placement& placement) const;

  private:
    // What all levels' strains of one instance have in common.
    struct Sight {
        double scale = 1, radius_m = 0;
        double share = 0;                     // of the criteria that know no error: level 1's strain
        view::SphereErrorBound::Place place;  // of the others
        double allowed_px = 1;
    };
    Sight sight_of(const Placement& placement) const;
    double strain(const Sight& sight, uint32_t level) const;
    uint32_t wanted_of(const Placement& placement, std::optional<uint32_t> in_use) const;

    const ChainFacts& facts_;
    const Selector* ahead_;
    SelectSettings settings_;
    view::Camera camera_;
    view::Axes axes_;
    view::SphereErrorBound bound_;
    double focal_px_, corner_tangent_;
    struct Side {
        glm::dvec3 inwards{0};
        double length = 0;
    };
    std::vector<Side> sides_;
};

}  // namespace overlook::discrete
