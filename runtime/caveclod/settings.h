// What a camera asks of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "formats/setting.h"

namespace overlook::caveclod {

// Where what can glide begins to, as a share of the error that splits it: while it is on its way it may reach that, no more.
constexpr double kGlideEnter = 0.85;

struct Settings {
    // What is left unsplit in view may be displaced by no more than this, in pixels; > 0.
    double error_px = 1;
    // The same of what may lie on an outline, by its normals; 0: the same as error_px; at most that.
    double silhouette_error_px = 0;
    // What is split is collapsed again under this share of it: between the two nothing changes. 0..kGlideEnter. Or 1,
    // where nothing glides: then the cut depends on the camera alone, once it is settled, and all that is applied is looked at.
    double collapse_share = 0.7;
    // What comes into view this far beyond the frame's borders is split already; one and a half times that far it is kept. 0..60.
    double guard_deg = 10;
    // Surfaces are drawn from the front alone: what all looks away from the eye is not split.
    bool culls_back_faces = false;
    // Splits and collapses in one frame; 0: as many as are wanted.
    uint32_t most_operations = 8000;
    // Triangles drawn; 0: as many as the error asks for. Over it the least errors are collapsed first.
    uint64_t most_triangles = 0;
    // A split's new position glides to its place in this time where that keeps the promise (Mesh::glides) and its error is at
    // least least_glide_px; 0: everything pops.
    double glide_s = 0.25;
    double least_glide_px = 0.25;
};

// Who refines.
enum class Variant {
    own,    // each camera its own faces (refine.h)
    paper,  // the same as printed in 2002 (paper.h)
    shared  // one refinement that is brought to each camera in turn: the paper's comparison
};

// A way to draw a mesh from frame to frame.
struct FrameOptions {
    Variant variant = Variant::own;
    Settings settings;
    // Cameras that refine at once, 1..4: the one that is drawn and others at its place that look to the other sides.
    uint32_t cameras = 1;
};

// What people may set of a variant; names without what the variant has not.
std::span<const SettingKind> setting_kinds(Variant variant);
// name and value must be of one of them.
void set(FrameOptions& options, std::string_view name, double value);

// What a camera's frame did.
struct FrameReport {
    uint32_t split_count = 0, collapse_count = 0;  // begun: those that glide are on their way for some time
    uint32_t forced_count = 0;     // of the splits: made only because another needed them
    uint32_t evaluated_count = 0;  // splits looked at
    uint32_t gliding_count = 0;    // on their way after this frame
    uint64_t triangle_count = 0;
    double error_px = 0;     // the greatest bound of what is left unsplit in view
    double missing_px = 0;   // the same of what the mesh has not there (Mesh::missing_error_m); in error_px too
    bool is_settled = true;  // no budget has left anything to do
};

}  // namespace overlook::caveclod
