// What the stability suite's cases share: the world on the card, the size of the pictures, the flight's cameras.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/measure/methods.h"
#include "tools/measure/run.h"
#include "tools/measure/stability_case.h"

namespace overlook::measure {

// How a case comes by a method: make_method, or what breaks one to see that its gates are missed.
using MethodMaker = std::function<std::unique_ptr<Method>(const MethodSpec&, World&)>;

struct Stage {
    World& world;  // uploaded
    gl::Renderer renderer;
    uint32_t width_px = 320, height_px = 240;
    uint32_t frames = 0;         // at most so many of a flight where pictures are judged; 0 = all
    double asked_px = 1;         // the error that was asked for, whatever a method makes of it
    std::string cache_folder;    // for reference frames; empty = none
    std::string kept_folder{};   // for findings, so that a run that was broken off goes on; empty = none
    std::string program_hash{};  // of what finds them
    MethodMaker make = make_method;
};

// A frame beside what it should have been.
struct Shot {
    uint32_t frame = 0;
    ImageRgb8 test, reference;
};

// What a case found out about one method.
struct Finding {
    std::map<std::string, double> figures;  // by the names of the case's gates
    std::string sentence;
    uint32_t frames = 0;
    std::optional<Shot> worst;
    std::vector<double> promised_px{};  // of the frames, where holes were counted
};

// Which of a flight's frames.
enum class Pick {
    all,     // at the flight's own step
    in_row,  // the first stage.frames, at the flight's own step: for what changes from frame to frame
    spread,  // stage.frames over the whole flight: for what each frame is by itself
};
// Whether a method shows pictures again: what a frame is then depends on the frames before it, and flights are flown in their
// steps, the first stage.frames of them, where others may be taken frame by frame.
bool is_image(const MethodSpec& spec);
// Whether a frame depends on the frames before it: as above, of refinement that goes on from frame to frame, and of changes of
// level, which take their time or wait for a reason.
bool has_history(const MethodSpec& spec);
Pick pick_of(std::span<const MethodSpec> specs, Pick of_geometry);  // specs: all with a history or none
std::vector<view::Camera> cameras_of(const Stage& stage, const scene::Flight& flight, Pick pick);

// One picture of a method as it stands. Fails with Exit::impossible (targets).
Result<ImageRgb8> draw_once(Method& method, const view::Camera& camera, uint32_t frame, uint32_t samples);
uint32_t samples_of(const MethodSpec& spec);

// Whether what is decided is a cut of a terrain, which depends on the camera alone.
bool is_cut(const Stage& stage, const MethodSpec& spec);

// A frame of a new method and the reference's. Fails as ReferenceRenderer does.
Result<Shot> shot_of(const Stage& stage, const MethodSpec& spec, const view::Camera& camera, uint32_t frame);

// The frames by all specs and their floors beside the reference. Fails as run_course.
Result<CourseResult> fly(Stage& stage, std::vector<view::Camera> cameras, double step_s, std::span<const MethodSpec> specs);
std::optional<Shot> shown(const WorstFrame& worst);  // none if there is none

// One of the case's ways to run: a finding for each spec, in their order. The specs are all of image methods, all of methods of
// meshes, all of methods of chains, or none of them.
using CaseRunner = Result<std::vector<Finding>> (*)(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// Cases judged on pops beside the reference: S01 and S09, S16.
Result<std::vector<Finding>> run_dolly(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_dropping(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// Cases judged on frames beside the reference: S03, S04, S06, S07, S08.
Result<std::vector<Finding>> run_yaw(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_teleports(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_skimming(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_horizon(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_climb(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// Cases judged by pictures that should be the same: S12, S17, S18, S20.
Result<std::vector<Finding>> run_moved_world(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_resize(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_cameras(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_back_and_forth(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// S13: chains of levels that are coplanar or do not match. Time stands still in mid-transition, and goes on until it is over.
Result<std::vector<Finding>> run_mismatched(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// S14: chains of which instances move. What is seen where they have been.
Result<std::vector<Finding>> run_crossing(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// Cases of methods that show pictures again: S05, S15.
Result<std::vector<Finding>> run_ridge(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_turning_back(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// S10: what is left of masts, in pictures of 64 samples a pixel, or 16 where those are too large. Fails with Exit::impossible
// where a flight shows none.
Result<std::vector<Finding>> run_masts(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// S19.
Result<std::vector<Finding>> run_halved_budget(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// Cases judged on what is decided: S02, S11.
Result<std::vector<Finding>> run_jitter(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);
Result<std::vector<Finding>> run_slopes(Stage&, const Case&, const scene::Flight&, std::span<const MethodSpec>);

// The greatest distance on the screen, pixels, between a source sample and where the cut of this spec draws it; and the greatest
// that it predicts. unsure_m: how far the source's samples may stand from where the file has them.
struct Displacement {
    double measured_px = 0, predicted_px = 0;
};
Displacement displacement_of(const Stage& stage, const MethodSpec& spec, const view::Camera& camera, double unsure_m = 0);

// The greatest distance on the screen, pixels, between the source and what a method of meshes has decided to draw; infinite if it
// cannot tell.
double displacement_of(Method& method);

// S11 of a method that shows pictures again: flown twice over the same ground painted with waves, so that each pixel tells which
// place it shows; held against where full geometry has that place. Outlines are left out. Fails with Exit::impossible.
Result<Finding> shear_of(Stage& stage, const MethodSpec& spec, const scene::Flight& flight);

// S08 of planted ground: adds whether every frame whose eye is higher or lower than images were sampled for was said to be such.
Result<void> say_fallbacks(Stage& stage, std::span<const MethodSpec> specs, const std::vector<view::Camera>& cameras,
                   std::vector<Finding>& findings);

// S11 of planted ground: how far, on the picture, the sheared ground under drawn images stands from the real one; not of what is
// not drawn by images. Fails with Exit::impossible where the flight shows no such tile.
Result<Finding> planted_shear(Stage& stage, const MethodSpec& spec, const scene::Flight& flight);

// S18: cameras that fly at once, each with a method of its own from `make`, all over what these share. legs: [cameras][frames] >=
// 1, equally long. Every frame is decided for all cameras, then drawn for all, beginning with another one each time; then each
// camera flies alone. Fails with Exit::impossible (targets).
struct Together {
    uint32_t cameras_that_differ = 0;  // have a picture whose hash is not that of the same picture alone
    uint32_t pictures = 0;             // compared
    std::optional<Shot> worst;         // of the camera with the most pixels that differ: at once, and alone
};
Result<Together> fly_together(const std::function<std::unique_ptr<Method>()>& make,
                              std::span<const std::vector<view::Camera>> legs, uint32_t samples);

}  // namespace overlook::measure
