// Section 6: a scene's planted ground, and the ways that are walked and driven over it.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/world.h"

namespace overlook::measure::paper::wang {

// A scene of a folder of plants: "hills" (planting.json) or "valley" (valley.json).
struct Land {
    std::string name, path;
    World world;

    const wang_ldi::PlantedField& planted() const { return world.planted->planted(); }
    const wang_ldi::ImageSet& images() const { return planted().images().set(); }
};
// Those of the folder's scenes that are there; none if neither is. Fails as read_world, and with Exit::bad_input if a scene
// plants nothing: "a/valley.json: plants nothing".
Result<std::vector<Land>> read_lands(const std::string& folder);

struct Walk {
    std::string name;
    std::vector<view::Camera> cameras;
};

// Where walks over a land begin: on level ground, planted for a way ahead and to both sides of it, hills behind that and the sun
// behind the eye. The same land, the same place.
class Guide {
  public:
    explicit Guide(const Land& land);

    // So far on from there, the eye above the ground by as much as images were sampled for, and by up_m more.
    view::Camera camera(double ahead_m, double up_m, double turned_deg, double pitch_deg, uint32_t width_px,
                        uint32_t height_px) const;

    // The camera within a tile from there, above planted ground and as high above it, where the nearest plant before the eye is
    // farthest away; the camera itself if there is none such.
    view::Camera cleared(const view::Camera& camera) const;

    // Walking and driving at head height, rising, turning, looking down: `frames` of each, evenly over it.
    std::vector<Walk> walks(uint32_t frames, uint32_t width_px, uint32_t height_px) const;
    // So many frames of the walk at its own step.
    std::vector<view::Camera> steps(uint32_t frames, uint32_t width_px, uint32_t height_px) const;

  private:
    bool is_planted(const glm::dvec2& at_m) const;
    double planted_share(const glm::dvec2& at_m, double heading_deg) const;
    double slope_ahead(const glm::dvec2& at_m, double heading_deg) const;
    double horizon(const glm::dvec2& at_m, double heading_deg) const;
    double worth(const glm::dvec2& at_m, double heading_deg, double best) const;

    const Land& land_;
    glm::dvec2 start_m_{0};
    double heading_deg_ = 0, eye_m_ = 0;
};

constexpr double kWalkStep_s = 1.0 / 32, kWalkSpeed_m_s = 1.5, kDriveSpeed_m_s = 15;

}  // namespace overlook::measure::paper::wang
