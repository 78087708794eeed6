// A mesh drawn from frame to frame: refined for one or several cameras by one of the variants, and drawn for the first.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/caveclod/draw.h"
#include "runtime/caveclod/mesh_stream.h"
#include "runtime/caveclod/paper.h"
#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/settings.h"

namespace overlook::caveclod {

// What one frame of all cameras took.
struct FrameCounts {
    uint64_t split_count = 0, collapse_count = 0, forced_count = 0, evaluated_count = 0;  // of all cameras
    uint64_t refined_triangle_count = 0;                                                  // of all cameras
    uint64_t triangle_count = 0, draw_call_count = 0;                                     // of the one that is drawn
    uint64_t uploaded_bytes = 0;                                                          // of all cameras
    uint64_t wrong_corner_count = 0;  // drawn with another face's attributes, for the paper's array holds no others
    uint64_t camera_bytes = 0;        // what the cameras keep in memory
    double error_px = 0;              // the greatest bound of what the drawn camera has left unsplit in view
    double missing_px = 0;            // of that, what is not there (MeshStream)
    bool is_settled = true;
};

// The cameras that refine with `camera`: itself first, then those at its place that look to the other sides.
std::vector<view::Camera> cameras_round(const view::Camera& camera, uint32_t count);

// Mesh, drawing and hierarchy must outlive it; the hierarchy is the mesh's own, and needed by Variant::paper alone.
class FrameDrawer {
  public:
    FrameDrawer(const Hierarchy& hierarchy, const Mesh& mesh, const Drawing& drawing, const FrameOptions& options);

    // Brings all cameras' faces nearer to what they ask for, the first time all the way, and so when the picture's size has
    // changed. dt_s: since the last frame.
    void decide(const view::Camera& camera, double dt_s);
    // Draws what was decided; may be called again with other targets, for the same picture.
    FrameCounts draw(const gl::Target& target, const DrawOptions& look);
    // From the next frame on; the faces stay as they are and go on from there.
    void change(const Settings& settings) { options_.settings = settings; }
    const FrameOptions& options() const { return options_; }
    const FrameCounts& counts() const { return counts_; }  // of the frame decided last

    // The drawn camera's, of Variant::own and Variant::shared; null of the paper's.
    const Refinement* refinement() const { return refinements_.empty() ? nullptr : refinements_.front().get(); }
    // Takes note of all cameras, as they were decided last, of Variant::own.
    void take_note(MeshStream& stream, size_t mesh) const;
    // What is drawn: mesh positions in the world, three a triangle, those on their way where they are.
    std::vector<glm::dvec3> drawn_corners_m() const;

  private:
    void start();
    void decide_own(double dt_s);
    void decide_shared();
    void decide_paper();
    void take(const FrameReport& report, bool is_drawn);

    const Mesh& mesh_;
    const Drawing& drawing_;
    FrameOptions options_;
    std::vector<view::Camera> cameras_;
    std::vector<std::unique_ptr<Refinement>> refinements_;  // one of each camera; one in all of Variant::shared
    std::unique_ptr<paper::Mesh> paper_mesh_;
    std::vector<std::unique_ptr<paper::CameraRefinement>> paper_;
    std::vector<std::vector<uint32_t>> paper_faces_;  // of the drawn camera
    std::vector<std::unique_ptr<CameraBuffers>> buffers_;
    std::vector<FrameReport> reports_;
    FrameCounts counts_;
    bool is_first_ = true;
};

}  // namespace overlook::caveclod
