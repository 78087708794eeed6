// Scenes and flights: what people write, and the player records, to say what is seen from where. JSON, version 1; the forms are
// samples/schema/scene.schema.json and flight.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "formats/json.h"
#include "formats/result.h"

namespace overlook::scene {

constexpr int kSceneVersion = 1;
constexpr int kFlightVersion = 1;

// From an asset's own frame into the scene's: scaled, then turned, then moved.
struct Transform {
    std::array<double, 3> translation_m{0, 0, 0};  // -1e9..1e9 each
    double rotation_z_deg = 0;                     // counter-clockwise seen from above (x towards y), -360..360
    double scale = 1;                              // 1e-6..1e6

    bool operator==(const Transform&) const = default;
};

// Where an asset stands at the flight's time 0, and how it goes on from there: evenly.
struct Instance {
    Transform transform;
    std::array<double, 3> velocity_m_s{0, 0, 0};  // -1e4..1e4 each
    double spin_deg_s = 0;                        // about the upright through its own origin, as rotation_z_deg, -3600..3600

    bool moves() const { return velocity_m_s != std::array<double, 3>{0, 0, 0} || spin_deg_s != 0; }
};
// Where it is then; its rotation within -360..360.
Transform at_time(const Instance& instance, double time_s);

using Setting = std::variant<bool, double, std::string>;

// Ways to choose tiles: each by itself, or one after the other, as the paper does it.
constexpr std::string_view kRandomAccess = "random-access", kRowByRow = "row-by-row";
constexpr std::array<std::string_view, 2> kTilings = {kRandomAccess, kRowByRow};

// Where on its ground what a layer plants stands: on the scene's terrain, or on a plain at height 0 if it has none. Files are
// named relative to the scene's.
struct Planting {
    std::optional<double> lowest_m, highest_m;  // all of a tile's ground lies between, -1e6..1e6
    double steepest = 1;                        // no ground under a tile is steeper, metres up for a metre along, 0..100
    std::string mask;            // a PNG over the ground: planted where it is half white at least; empty: everywhere
    std::string density;         // a PNG over the ground: how densely, white as densely as anywhere; empty: white
    uint32_t fairing_tiles = 1;  // over so many tiles at its edge the planting thins out, 0..8
    uint32_t seed = 1;           // of the tiling
    std::string tiling;          // one of kTilings; empty: by random access, or row by row where the tiles permit no other
    // Chains of levels of what is planted, in the order of the models in the baked file: what near tiles are drawn with. Empty:
    // none, and near tiles are drawn as far ones. At most kMostModels.
    std::vector<std::string> models;

    bool operator==(const Planting&) const = default;
};
constexpr size_t kMostModels = 4096;

// Something drawn, and how.
struct Layer {
    std::string asset;  // a baked file, relative to the scene's file
    Transform transform;
    // Where the asset stands, each time whole, before `transform` is applied to all; of method discrete alone. None: once, as it
    // is.
    std::vector<Instance> instances;                        // at most kMostInstances
    std::string method;                                     // one of kMethods
    std::string variant;                                    // as in "lod-sprite:paper"; empty = the default one
    std::vector<std::pair<std::string, Setting>> settings;  // in the file's order; which there are, the method knows
    std::optional<Planting> planting = {};                  // of method wang-ldi alone
};

struct Light {
    double haze = 1;  // how much the air hides far things: 0 = not at all, 1 = a fair day, at most 10
};

struct CameraDefaults {
    double fov_y_deg = 60;         // where a flight's key names none, 1..170
    std::optional<double> near_m;  // 0.001..1000; otherwise chosen by the size of the asset's cells
};

struct Scene {
    std::vector<Layer> layers;  // 1..64
    Light light;
    CameraDefaults camera;
    double error_px = 1;  // the budget: nothing in the picture is displaced by more, 0.001..10000
};

// A document holds no more than json::kMostValues, some 140,000 instances with all that they may say.
constexpr size_t kMostInstances = size_t(1) << 20;

constexpr std::array<std::string_view, 5> kMethods = {"terrain", "lod-sprite", "caveclod", "discrete", "wang-ldi"};

// Between two keys: the first's pose; evenly; or along the cubic of runtime/view/flight.h.
enum class Interpolation { constant, linear, smooth };

struct Key {
    double time_s = 0;                          // 0..1e6, growing from key to key
    std::array<double, 3> position_m{0, 0, 0};  // -1e9..1e9 each
    double heading_deg = 0;                     // clockwise from +y (north), -360..360
    double pitch_deg = 0;                       // up positive, -90..90
    std::optional<double> fov_y_deg;            // 1..170; otherwise the scene's
};

constexpr size_t kMostKeys = 65536;
constexpr uint32_t kMostFrames = 10'000'000;

struct Flight {
    double step_s = 0.03125;  // from frame to frame, 1e-4..3600
    Interpolation interpolation = Interpolation::smooth;
    std::vector<Key> keys;  // 1..kMostKeys
};

// Parse a document, which may be hostile; name is the file's, for messages. Every failure is Exit::bad_input, one line with line,
// column and JSON pointer: as json::parse and json::Form::expect, and
//   "valley.scene.json:12:7: /layers/0/method: terain is no method; did you mean terrain?"
//   "valley.scene.json:12:7: /layers/0/method: a variant is lower-case letters, digits and hyphens after the colon"
//   "valley.scene.json:12:7: /layers/0/asset: is empty; name a baked file" (also: begins with /, or holds a zero byte)
//   "valley.scene.json:12:7: /layers/0/instances: terrain draws no instances; discrete does"
//   "valley.scene.json:12:7: /layers/0/planting: terrain plants nothing; wang-ldi does"
//   "valley.scene.json:12:7: /layers/0/planting/mask: is empty; name a PNG" (also: begins with /, or holds a zero byte)
//   "valley.scene.json:12:7: /layers/0/planting/highest_m: 200 is below lowest_m, 500"
//   "valley.scene.json:12:7: /layers/0/planting/seed: 1.5 is no whole number"
//   "valley.scene.json:12:7: /layers/0/planting/tiling: rows is no way to tile; did you mean row-by-row?"
//   "a.flight.json:9:5: /keys/3/time_s: 2 is not after the key before, at 2"
//   "a.flight.json:3:5: /interpolation: smoth is no interpolation; did you mean smooth?"
//   "a.flight.json:2:3: /step_s: 1e-04 makes more than 10,000,000 frames of 1001 s; a longer step is wanted"
Result<Scene> parse_scene(std::string_view text, const std::string& name);
Result<Flight> parse_flight(std::string_view text, const std::string& name);

// The same from files. Fail further as MappedFile::open.
Result<Scene> read_scene(const std::string& path);
Result<Flight> read_flight(const std::string& path);

// The path of a file that a scene names, of a layer's asset: relative to the folder of the scene's file.
std::string path_in_scene(const std::string& scene_path, const std::string& name);
std::string asset_path(const std::string& scene_path, const Layer& layer);

// Texts that parse back to the same values, bit for bit. Same value, same bytes.
std::string json_from_scene(const Scene& scene);
std::string json_from_flight(const Flight& flight);

// How many frames a flight has: frame i is at i * step_s (one product, so that no error adds up), the last at its last key's time
// at most, where a billionth of a step over it counts as on it.
uint32_t frame_count(const Flight& flight);
inline double frame_time_s(const Flight& flight, uint64_t frame) {
    return double(frame) * flight.step_s;
}

// The members of each object of the two forms, as the parser checks them; `schema` is the object's place in the schema file.
struct ObjectForm {
    std::string_view schema;
    std::span<const json::Member> members;
};
std::span<const ObjectForm> scene_forms();
std::span<const ObjectForm> flight_forms();

}  // namespace overlook::scene
