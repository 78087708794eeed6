// Section 6, flown: every flight by Overlook's way and by the paper's, both beside drawing the geometry, radii, remedies switched
// off one by one, holes over magenta, images that come through a quarter of the memory they take, and what is to be seen.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gl/context.h"
#include "tools/measure/numbers/gaps.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/fields.h"

namespace overlook::measure::paper::wang {

// Families of races beside "Overlook".
constexpr char kByProcessor[] = "geometry by the processor", kByOpenGl[] = "geometry by OpenGL";

// A run of some frames.
struct FieldRow {
    std::string set;     // "flight", "error", "radius", "remedy" or "race"
    std::string family;  // "Overlook", "the paper's", "geometry"; of a race by whom as well
    std::string what;    // of a flight its name, of a remedy what is switched off, of a race how far geometry goes; empty
    double x = 0;        // error asked in pixels, or radius in tiles
    double ms_p50 = 0, ms_p99 = 0;
    double samples = 0, triangles = 0, tiles = 0;         // of the median frame
    double outside_share = 0;                             // of the frames: the eye was outside the cell, as is said
    std::optional<double> e_p99{}, e_mean{}, w{}, pop{};  // where it was compared
    std::optional<double> floor_e_p99{};                  // of all geometry at as many samples a pixel
    std::optional<Gaps> in_cell{}, anywhere{};            // over magenta
    std::optional<double> own_times_as_fast{};            // of a race
};

// A walk with less memory than all images take.
struct StreamedWalk {
    uint64_t all_bytes = 0, budget_bytes = 0,
             upload_budget_bytes = 0;                           // of all images; what may be there; what a frame may take over
    uint64_t most_resident_bytes = 0, most_uploaded_bytes = 0;  // on the way included; in a frame
    uint64_t uploaded_bytes = 0, dropped = 0;                   // in all
    uint32_t frames = 0, late_frames = 0;                       // that showed another in place of an image
    uint64_t shown = 0, late = 0, missing = 0;                  // images, over all frames
    std::string refused;                                        // why it was not walked; empty: it was
};

struct FlownLand {
    std::string name;
    uint32_t width_px = 0, height_px = 0, judged_width_px = 0, judged_height_px = 0;
    double millions_in_view = 0;  // triangles of the finest levels of all plants in view up to kPlantsUpTo_m
    double plants_in_view = 0;
    std::vector<FieldRow> rows;
    StreamedWalk streamed;
    std::vector<Picture> pictures;
};

struct FieldOptionsAsked {
    uint32_t width_px = 640, height_px = 480, frames = 24;  // of flights
    uint32_t judged_width_px = 320, judged_height_px = 240, judged_frames = 3;
};

// The land's world must be uploaded. plants: for names of pictures. Fails as run_course, gaps_over_magenta and FrameDrawer::make.
Result<FlownLand> fly_land(Land& land, const std::string& plants, const FieldOptionsAsked& asked, const gl::Renderer& renderer,
                           const std::function<void(double)>& done);

// The methods of a race at an error asked, for cameras of one picture: geometry goes to where textures begin.
struct Raced {
    double geometry_to_m = 0;
    std::string own, by_processor, by_opengl;
};
Raced raced_at(const Land& land, const view::Camera& camera, double error_px);

// Overlook as it draws by itself beside the same picture with geometry in place of all images: plants at discrete levels of the
// same error up to where textures begin, by Overlook's own hand and by OpenGL, instanced; the same far points beyond. At 1, 2, 4
// and 8 px, each frame by all of them in turn, one sample a pixel. Adds the rows. Fails as run_course.
Result<void> race_geometry(Land& land, std::vector<view::Camera> cameras, const gl::Renderer& renderer,
                           std::vector<FieldRow>& rows);

// The land walked with a quarter of the memory that its images take. Fails as FrameDrawer.
Result<StreamedWalk> walk_streamed(Land& land, const std::vector<view::Camera>& cameras, double step_s);

}  // namespace overlook::measure::paper::wang
