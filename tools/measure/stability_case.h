// The cases of the stability suite: samples/stability/s01.json .. s20.json. JSON, version 1:
//
//     {"version": 1, "number": "S16", "what": "every seventh frame dropped",
//      "scene": "../scenes/sample.json", "flight": "../flights/s01.json",     paths relative to the case's file
//      "mesh_scene": "../scenes/sample-mesh.json", "mesh_flight": "...",      for methods that draw meshes; may be left out
//      "chain_scene": "../scenes/chains.json", "chain_flight": "...",         for discrete:fsi and its like; may be left out
//      "planting_scene": "../scenes/planting.json", "planting_flight": "...", for wang-ldi; may be left out
//      "settings": {"drop_every": 7},
//      "gates": [{"figure": "pop_index_ratio", "most": 1.1}],
//      "methods": ["terrain", "lod-sprite"], "runs": ["terrain"],
//      "note": "what is known of a gate that is missed"}                     for the page; may be left out
//
// methods: whom the case concerns. runs: for which of them the case is ready to be run today; the others owe it. A case that no
// method can run yet may be without scene and flight.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/scene.h"

namespace overlook::measure {

constexpr int kCaseVersion = 1;

// A number that a run must keep.
struct CaseGate {
    std::string figure;         // one of figure_names()
    double most = 0;            // the figure is at most this
    // Whom it holds: "geometry" (terrain, caveclod, discrete), "image" (lod-sprite), "chain" (discrete:fsi and its like), "planting"
    // (wang-ldi) or "all".
    std::string of = "all";
    double over_asked_px = -1;  // >= 0: most is this much over the asked error in pixels instead
};

// What happens during the run besides the flight.
struct CaseSettings {
    uint32_t drop_every = 0;            // every n-th frame is not drawn; 0 = none
    std::vector<double> world_moves_m;  // the whole run again with world and cameras moved by so much along x and y
    std::vector<double> resize_shares;  // at equally spaced frames the picture's size becomes this share of the first size
    double budget_share = 1;            // from the middle frame on the triangle budget is this share
    uint32_t cameras = 1;               // the flight in so many equally long legs, each flown by a camera of its own, all at once
    bool goes_backwards = false;        // the frames again, in reverse order
    std::optional<double> changed_pixel;  // by how much a pixel must change to count, 0..1
};

struct Case {
    std::string number;  // "S01" .. "S20"
    std::string what;
    std::string scene, flight;  // paths; empty = not there yet
    CaseSettings settings;
    std::vector<CaseGate> gates;
    std::vector<std::string> methods;  // of scene::kMethods
    std::vector<std::string> runs;     // of methods
    std::string note{};                // what is known of a gate that is missed; empty = nothing
    // Of methods that draw meshes, where those fly over something of their own; empty = as the others.
    std::string mesh_scene{}, mesh_flight{};
    // Of methods that draw chains of levels and nothing else; empty = the case is not run for them.
    std::string chain_scene{}, chain_flight{};
    // Of wang-ldi, likewise.
    std::string planting_scene{}, planting_flight{};
};

// The case as methods that draw meshes fly it.
Case for_meshes(Case each);

// The case as methods that draw chains alone fly it.
Case for_chains(Case each);

// The case as wang-ldi flies it.
Case for_plantings(Case each);

// Whether it runs for no method of terrains.
bool is_of_meshes_alone(const Case& each);

// The names of the figures that a gate may hold.
std::span<const std::string_view> figure_names();

// Parses a case. Every failure is Exit::bad_input, as of scene::parse_scene, and further:
//   "s01.json:3:13: /number: S1 is no case; S01 to S20 are"
//   "s01.json:9:18: /gates/0/figure: pop_idx is no figure; did you mean pop_index?"
//   "s01.json:9:5: /gates/0: has no bound: most or over_asked_px is wanted" (or has both)
//   "s01.json:12:20: /runs/0: terrain is not among the case's methods"
//   "s01.json:12:11: /runs: a case that runs needs a scene and a flight"
Result<Case> parse_case(std::string_view text, const std::string& name);

// Reads s01.json .. s20.json of a folder, in their order; scene and flight become paths from where the folder's is. Fails as
// parse_case, as MappedFile::open where one is missing, and with "FOLDER/s03.json: is case S04".
Result<std::vector<Case>> read_cases(const std::string& folder);

// "S05 lod-sprite", a line for each method that owes a case, in the cases' order.
std::vector<std::string> owed_cases(std::span<const Case> cases);

}  // namespace overlook::measure
