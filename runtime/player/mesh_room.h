// What the player does alike with a mesh that is there and one that is read in parts.
#pragma once

#include "runtime/caveclod/draw_frames.h"
#include "runtime/player/subject.h"

namespace overlook::player {

// The room round a mesh. Meshes are flown through and round; nothing of them is ground.
class MeshRoom : public Subject {
  public:
    view::Camera overview(uint32_t width_px, uint32_t height_px) const override;
    Thing thing() const override { return Thing::mesh; }
    double near_m() const override;
    std::optional<double> height_m(double, double) const override { return std::nullopt; }
    double distance_m(const glm::dvec3& place_m) const override;
    double step_m() const override { return radius_m() / 16; }
    double least_speed_m_s() const override;

  protected:
    virtual const caveclod::Mesh& mesh() const = 0;

  private:
    double radius_m() const;
};

caveclod::DrawOptions look_of(const FrameStyle& style, const LayerMethod& layer);
// What a frame took, into its record.
void take_counts(const caveclod::FrameCounts& counts, FrameRecord& record);

}  // namespace overlook::player
