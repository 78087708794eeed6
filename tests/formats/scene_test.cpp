#include "formats/scene.h"

#include <gtest/gtest.h>

#include "tests/formats/schema_agreement.h"

namespace overlook::scene {
namespace {

const std::string kScene = R"({
  "version": 1,
  "layers": [
    {"asset": "a/b.ovl", "method": "lod-sprite:paper",
     "transform": {"translation_m": [1e7, -2.5, 3], "rotation_z_deg": 30, "scale": 2},
     "settings": {"keyframes": 7, "fill": "push", "morph": true}}
  ],
  "light": {"haze": 0.5},
  "camera": {"fov_y_deg": 42, "near_m": 0.25},
  "error_px": 2
})";

const std::string kFlight = R"({"version": 1, "step_s": 0.1, "interpolation": "linear", "keys": [
  {"time_s": 0, "position_m": [1, 2, 3], "heading_deg": 350, "pitch_deg": -10},
  {"time_s": 0.7, "position_m": [4, 5, 6], "heading_deg": 10, "pitch_deg": 10, "fov_y_deg": 30}]})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    size_t found = text.find(from);
    EXPECT_NE(found, std::string::npos) << from;
    return text.replace(found, from.size(), to);
}
std::string scene_error(const std::string& text) {
    Result<Scene> scene = parse_scene(text, "s.json");
    if (scene) return "(read)";
    EXPECT_EQ(scene.error().exit, Exit::bad_input);
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
    return scene.error().message;
}
std::string flight_error(const std::string& text) {
    Result<Flight> flight = parse_flight(text, "f.json");
    if (flight) return "(read)";
    EXPECT_EQ(flight.error().exit, Exit::bad_input);
    return flight.error().message;
}

TEST(Scene, IsReadAsItIsWritten) {
    Result<Scene> scene = parse_scene(kScene, "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->layers.size(), 1u);
    const Layer& layer = scene->layers[0];
    EXPECT_EQ(layer.asset, "a/b.ovl");
    EXPECT_EQ(layer.method, "lod-sprite");
    EXPECT_EQ(layer.variant, "paper");
    EXPECT_EQ(layer.transform.translation_m, (std::array<double, 3>{1e7, -2.5, 3}));
    EXPECT_EQ(layer.transform.rotation_z_deg, 30);
    EXPECT_EQ(layer.transform.scale, 2);
    ASSERT_EQ(layer.settings.size(), 3u);
    EXPECT_EQ(layer.settings[0], (std::pair<std::string, Setting>("keyframes", 7.0)));
    EXPECT_EQ(layer.settings[1], (std::pair<std::string, Setting>("fill", std::string("push"))));
    EXPECT_EQ(layer.settings[2], (std::pair<std::string, Setting>("morph", true)));
    EXPECT_EQ(scene->light.haze, 0.5);
    EXPECT_EQ(scene->camera.fov_y_deg, 42);
    EXPECT_EQ(scene->camera.near_m, 0.25);
    EXPECT_EQ(scene->error_px, 2);
}

TEST(Scene, HasTheDefaultsOfItsStruct) {
    Result<Scene> scene = parse_scene(R"({"version":1,"layers":[{"asset":"a.ovl","method":"terrain"}]})", "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->error_px, Scene{}.error_px);
    EXPECT_EQ(scene->camera.fov_y_deg, CameraDefaults{}.fov_y_deg);
    EXPECT_FALSE(scene->camera.near_m);
    EXPECT_EQ(scene->layers[0].transform.scale, 1);
    EXPECT_TRUE(scene->layers[0].variant.empty());
}

TEST(Scene, IsWrittenAsItIsRead) {
    Result<Scene> scene = parse_scene(kScene, "s.json");
    ASSERT_TRUE(scene);
    std::string text = json_from_scene(*scene);
    Result<Scene> again = parse_scene(text, "s.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(json_from_scene(*again), text);
    EXPECT_EQ(again->layers[0].settings, scene->layers[0].settings);
    EXPECT_EQ(again->layers[0].transform.translation_m, scene->layers[0].transform.translation_m);
    EXPECT_EQ(again->camera.near_m, scene->camera.near_m);
}

TEST(Scene, NamesThePlaceOfEveryMistake) {
    struct Case {
        std::string from, to, message;
    };
    for (const Case& c : std::initializer_list<Case>{
             {"\"method\": \"lod-sprite:paper\"", "\"method\": \"terain\"",
              "s.json:4:36: /layers/0/method: terain is no method; did you mean terrain?"},
             {"lod-sprite:paper",
              "terrain:", "s.json:4:36: /layers/0/method: a variant is lower-case letters, digits and hyphens after the colon"},
             {"\"method\"", "\"metod\"", "s.json:4:26: /layers/0/metod: is not known here; did you mean method?"},
             {"a/b.ovl", "", "s.json:4:15: /layers/0/asset: is empty; name a baked file"},
             {"a/b.ovl", "/b.ovl", "s.json:4:15: /layers/0/asset: begins with /; name it relative to the scene's file"},
             {"a/b.ovl", "a\\u0000", "s.json:4:15: /layers/0/asset: holds a zero byte"},
             {"\"asset\": \"a/b.ovl\", ", "", "s.json:4:5: /layers/0: has no asset"},
             {"-2.5", "-2e9", "s.json:5:43: /layers/0/transform/translation_m/1: -2000000000 is outside -1000000000..1000000000"},
             {"-2.5", "\"x\"", "s.json:5:43: /layers/0/transform/translation_m/1: is text; a number is wanted"},
             {", 3]", "]", "s.json:5:37: /layers/0/transform/translation_m: has 2 items; 3 numbers are wanted"},
             {"\"scale\": 2", "\"scale\": 0", "s.json:5:84: /layers/0/transform/scale: 0 is outside 1e-06..1000000"},
             {"true", "[]", "s.json:6:60: /layers/0/settings/morph: a setting is a number, text, true or false"},
             {"0.5", "11", "s.json:8:21: /light/haze: 11 is outside 0..10"},
             {"{\"haze\": 0.5}", "3", "s.json:8:12: /light: is a number; an object is wanted"},
             {"42", "171", "s.json:9:27: /camera/fov_y_deg: 171 is outside 1..170"},
             {"\"error_px\": 2", "\"error_px\": 0", "s.json:10:15: /error_px: 0 is outside 0.001..10000"},
             {"\"error_px\": 2", "\"error_px\": 2, \"error_px\": 2", "s.json:10:18: the name error_px stands twice"},
             {"\"version\": 1", "\"version\": 2", "s.json:2:14: /version: 2 is newer than this program, which reads up to 1"},
             {"\"version\": 1", "\"version\": 1.5", "s.json:2:14: /version: 1.5 is no whole number"},
             {"\"version\": 1,", "", "s.json:1:1: has no version"},
         }) {
        EXPECT_EQ(scene_error(replaced(kScene, c.from, c.to)), c.message);
    }
    EXPECT_EQ(scene_error("[]"), "s.json:1:1: is an array; an object is wanted");
    EXPECT_EQ(scene_error(R"({"version":1,"layers":[]})"), "s.json:1:23: /layers: has 0 items; 1 to 64 are wanted");
}

const std::string kForest = R"({"version": 1, "layers": [
  {"asset": "tree.ovl", "method": "discrete:switch", "transform": {"scale": 3}, "instances": [
    {"translation_m": [1, 2, -3], "rotation_z_deg": 90, "scale": 0.5},
    {}]}]})";

TEST(Scene, HoldsInstancesOfItsAsset) {
    Result<Scene> scene = parse_scene(kForest, "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    const std::vector<Instance>& instances = scene->layers[0].instances;
    ASSERT_EQ(instances.size(), 2u);
    EXPECT_EQ(instances[0].transform.translation_m, (std::array<double, 3>{1, 2, -3}));
    EXPECT_EQ(instances[0].transform.rotation_z_deg, 90);
    EXPECT_EQ(instances[0].transform.scale, 0.5);
    EXPECT_EQ(instances[1].transform.scale, Transform{}.scale);
    EXPECT_FALSE(instances[0].moves());
    EXPECT_EQ(scene->layers[0].transform.scale, 3);

    std::string text = json_from_scene(*scene);
    Result<Scene> again = parse_scene(text, "s.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(json_from_scene(*again), text);
    ASSERT_EQ(again->layers[0].instances.size(), 2u);
    EXPECT_EQ(again->layers[0].instances[0].transform.translation_m, instances[0].transform.translation_m);
}

TEST(Scene, HoldsHowItsInstancesGoOn) {
    Result<Scene> scene = parse_scene(
        R"({"version": 1, "layers": [{"asset": "a.ovl", "method": "discrete", "instances": [
        {"translation_m": [1, 2, 3], "rotation_z_deg": 300, "velocity_m_s": [0.5, 0, -1], "spin_deg_s": 90}]}]})",
        "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    const Instance& one = scene->layers[0].instances.at(0);
    EXPECT_TRUE(one.moves());
    EXPECT_EQ(at_time(one, 0).translation_m, one.transform.translation_m);
    EXPECT_EQ(at_time(one, 4).translation_m, (std::array<double, 3>{3, 2, -1}));
    EXPECT_EQ(at_time(one, 4).rotation_z_deg, 300);
    EXPECT_EQ(at_time(one, 1).rotation_z_deg, 30);
    std::string text = json_from_scene(*scene);
    Result<Scene> again = parse_scene(text, "s.json");
    ASSERT_TRUE(again) << again.error().message << text;
    EXPECT_TRUE(json_from_scene(*again) == text);
    EXPECT_EQ(again->layers[0].instances[0].velocity_m_s, one.velocity_m_s);
    EXPECT_EQ(again->layers[0].instances[0].spin_deg_s, 90);
}

TEST(Scene, NamesThePlaceOfEveryMistakeInItsInstances) {
    struct Case {
        std::string from, to, message;
    };
    for (const Case& c : std::initializer_list<Case>{
             {"discrete:switch", "caveclod", "s.json:2:87: /layers/0/instances: caveclod draws no instances; discrete does"},
             {"-3]", "\"x\"]", "s.json:3:30: /layers/0/instances/0/translation_m/2: is text; a number is wanted"},
             {"0.5", "-1", "s.json:3:66: /layers/0/instances/0/scale: -1 is outside 1e-06..1000000"},
             {"{}", "7", "s.json:4:5: /layers/0/instances/1: is a number; an object is wanted"},
             {"{}", "{\"scal\": 2}", "s.json:4:6: /layers/0/instances/1/scal: is not known here; did you mean scale?"},
         }) {
        EXPECT_EQ(scene_error(replaced(kForest, c.from, c.to)), c.message);
    }
    EXPECT_EQ(scene_error(R"({"version":1,"layers":[{"asset":"a","method":"discrete","instances":[]}]})"),
              "s.json:1:69: /layers/0/instances: has 0 items; 1 to 1048576 are wanted");
    for (size_t size = 0; size < kForest.size(); ++size) EXPECT_NE(scene_error(kForest.substr(0, size)), "(read)") << size;
}

const std::string kMeadow = R"({"version": 1, "layers": [
  {"asset": "hills.ovl", "method": "terrain"},
  {"asset": "meadow.ovl", "method": "wang-ldi:paper", "planting": {"lowest_m": 100, "highest_m": 900.5, "steepest": 0.4,
    "mask": "a/mask.png", "density": "d.png", "fairing_tiles": 3, "seed": 77, "tiling": "row-by-row", "models": ["poppy.ovl", "rye.ovl"]}}]})";

TEST(Scene, HoldsWhereWhatItPlantsStands) {
    Result<Scene> scene = parse_scene(kMeadow, "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE(scene->layers[0].planting);
    Planting wanted;
    wanted.lowest_m = 100, wanted.highest_m = 900.5, wanted.steepest = 0.4, wanted.mask = "a/mask.png";
    wanted.density = "d.png", wanted.fairing_tiles = 3, wanted.seed = 77, wanted.tiling = "row-by-row",
    wanted.models = {"poppy.ovl", "rye.ovl"};
    EXPECT_TRUE(scene->layers[1].planting == wanted);
    std::string text = json_from_scene(*scene);
    Result<Scene> again = parse_scene(text, "s.json");
    ASSERT_TRUE(again) << again.error().message << text;
    EXPECT_TRUE(json_from_scene(*again) == text);
    EXPECT_TRUE(again->layers[1].planting == wanted);

    scene = parse_scene(R"({"version":1,"layers":[{"asset":"a.ovl","method":"wang-ldi","planting":{}}]})", "s.json");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->layers[0].planting == Planting{});
}

TEST(Scene, NamesThePlaceOfEveryMistakeInItsPlanting) {
    struct Case {
        std::string from, to, message;
    };
    for (const Case& c : std::initializer_list<Case>{
             {"wang-ldi:paper", "terrain", "s.json:3:60: /layers/1/planting: terrain plants nothing; wang-ldi does"},
             {"900.5", "99", "s.json:3:98: /layers/1/planting/highest_m: 99 is below lowest_m, 100"},
             {"0.4", "-1", "s.json:3:117: /layers/1/planting/steepest: -1 is outside 0..100"},
             {"a/mask.png", "", "s.json:4:13: /layers/1/planting/mask: is empty; name a PNG"},
             {"d.png", "/d.png", "s.json:4:38: /layers/1/planting/density: begins with /; name it relative to the scene's file"},
             {"\"d.png\"", "3", "s.json:4:38: /layers/1/planting/density: is a number; text is wanted"},
             {"fairing_tiles\": 3", "fairing_tiles\": 9", "s.json:4:64: /layers/1/planting/fairing_tiles: 9 is outside 0..8"},
             {"fairing_tiles\": 3", "fairing_tiles\": 0.5",
              "s.json:4:64: /layers/1/planting/fairing_tiles: 0.5 is no whole number"},
             {"77", "1.5", "s.json:4:75: /layers/1/planting/seed: 1.5 is no whole number"},
             {"77", "-1", "s.json:4:75: /layers/1/planting/seed: -1 is outside 0..4294967295"},
             {"row-by-row", "rows", "s.json:4:89: /layers/1/planting/tiling: rows is no way to tile; did you mean row-by-row?"},
             {"row-by-row", "", "s.json:4:89: /layers/1/planting/tiling:  is no way to tile; did you mean row-by-row?"},
             {"\"rye.ovl\"", "[]", "s.json:4:127: /layers/1/planting/models/1: is no text; name a baked chain of levels"},
             {"rye.ovl", "", "s.json:4:127: /layers/1/planting/models/1: is empty; name a baked chain of levels"},
             {"\"mask\"", "\"msk\"", "s.json:4:5: /layers/1/planting/msk: is not known here; did you mean mask?"},
         }) {
        EXPECT_EQ(scene_error(replaced(kMeadow, c.from, c.to)), c.message);
    }
    for (size_t size = 0; size < kMeadow.size(); ++size) EXPECT_NE(scene_error(kMeadow.substr(0, size)), "(read)") << size;
}

TEST(Flight, NamesThePlaceOfEveryMistake) {
    struct Case {
        std::string from, to, message;
    };
    for (const Case& c : std::initializer_list<Case>{
             {"0.7", "0", "f.json:3:14: /keys/1/time_s: 0 is not after the key before, at 0"},
             {"linear", "linar", "f.json:1:48: /interpolation: linar is no interpolation; did you mean linear?"},
             {"350", "361", "f.json:2:57: /keys/0/heading_deg: 361 is outside -360..360"},
             {"\"pitch_deg\": -10", "\"pitch_deg\": -91", "f.json:2:75: /keys/0/pitch_deg: -91 is outside -90..90"},
             {", \"pitch_deg\": -10", "", "f.json:2:3: /keys/0: has no pitch_deg"},
             {"0.7", "-1", "f.json:3:14: /keys/1/time_s: -1 is outside 0..1000000"},
             {"0.1", "0", "f.json:1:26: /step_s: 0 is outside 0.0001..3600"},
             {"\"time_s\": 0.7", "\"time_s\": 1e6",
              "f.json:1:26: /step_s: 0.0001 makes more than 10,000,000 frames of 1000000 s; a longer step is wanted"},
         }) {
        std::string text = replaced(kFlight, c.from, c.to);
        if (c.message.find("makes more") != std::string::npos) text = replaced(text, "0.1", "1e-4");
        EXPECT_EQ(flight_error(text), c.message);
    }
}

TEST(Flight, RefusesNumbersThatAreNone) {
    for (const char* none : {"NaN", "nan", "Infinity", "-Infinity", "1e999", "0x10", "+1", "01", "1.", ".5", "null"}) {
        EXPECT_NE(flight_error(replaced(kFlight, "0.7", none)), "(read)") << none;
    }
}

TEST(Flight, RefusesEveryTruncation) {
    for (size_t size = 0; size < kFlight.size(); ++size) EXPECT_NE(flight_error(kFlight.substr(0, size)), "(read)") << size;
    for (size_t size = 0; size < kScene.size(); ++size) EXPECT_NE(scene_error(kScene.substr(0, size)), "(read)") << size;
}

TEST(Flight, IsWrittenAsItIsRead) {
    Result<Flight> flight = parse_flight(kFlight, "f.json");
    ASSERT_TRUE(flight) << flight.error().message;
    flight->keys[0].position_m[0] = 0.1 + 0.2;  // needs 17 digits
    std::string text = json_from_flight(*flight);
    Result<Flight> again = parse_flight(text, "f.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(json_from_flight(*again), text);
    EXPECT_EQ(again->keys[0].position_m[0], 0.1 + 0.2);
    EXPECT_FALSE(again->keys[0].fov_y_deg);
    EXPECT_EQ(again->keys[1].fov_y_deg, 30);
    EXPECT_EQ(again->interpolation, Interpolation::linear);
}

TEST(Flight, HasAFrameAtEveryStepUpToItsLastKey) {
    Flight flight;
    flight.keys.resize(2);
    for (auto [step_s, length_s, frames] :
         std::initializer_list<std::tuple<double, double, uint32_t>>{{0.1, 0.7, 8},  // 0.7 / 0.1 is a little under 7
                                                                     {0.03125, 599 * 0.03125, 600},
                                                                     {0.05, 29.95, 600},
                                                                     {1, 0.5, 1},
                                                                     {1, 2.999, 3}}) {
        flight.step_s = step_s;
        flight.keys[1].time_s = length_s;
        EXPECT_EQ(frame_count(flight), frames) << step_s << " " << length_s;
    }
    EXPECT_EQ(frame_time_s(flight, 3), 3.0);
}

TEST(JsonDocument, IsRefusedBeyondItsLimits) {
    std::string deep(40, '[');
    Result<json::Value> value = json::parse(deep, "d.json");
    ASSERT_FALSE(value);
    EXPECT_EQ(value.error().message, "d.json:1:33: more than 32 arrays and objects within each other");
    std::string many = "[0";
    for (size_t i = 0; i < json::kMostValues; ++i) many += ",0";
    value = json::parse(many + "]", "d.json");
    ASSERT_FALSE(value);
    EXPECT_EQ(value.error().message, "d.json:1:2000000: more than 1,000,000 values");
    std::string names = "{\"a\":0";
    for (int i = 0; i < 200; ++i) names += ",\"n" + std::to_string(i) + "\":0";
    EXPECT_FALSE(json::parse(names + "}", "d.json"));
    value = json::parse(std::string(json::kMostBytes + 1, ' '), "d.json");
    ASSERT_FALSE(value);
    EXPECT_EQ(value.error().message, "d.json: 16,777,217 bytes; at most 16,777,216 are read");
}

TEST(JsonDocument, KnowsThePlaceOfEachValue) {
    Result<json::Value> value = json::parse("\xef\xbb\xbf{\n  \"a\" :\t[1.5e1 ,\n-2, \"x\\\"y\",null],\"b\": true}\n", "d.json");
    ASSERT_TRUE(value) << value.error().message;
    const json::Value& a = value->items.at(0);
    auto place = [](const json::Value& at) { return std::pair(at.place.line, at.place.column); };
    EXPECT_EQ(place(a), std::pair(2u, 9u));
    EXPECT_EQ(place(a.items.at(0)), std::pair(2u, 10u));
    EXPECT_EQ(place(a.items.at(1)), std::pair(3u, 1u));
    EXPECT_EQ(place(a.items.at(2)), std::pair(3u, 5u));
    EXPECT_EQ(place(a.items.at(3)), std::pair(3u, 12u));
    EXPECT_EQ(place(value->items.at(1)), std::pair(3u, 23u));
    EXPECT_EQ(a.items.at(2).text, "x\"y");
    EXPECT_FALSE(json::parse("\"\xff\"", "d.json"));
}

TEST(Nearest, IsTheNameOfFewestEdits) {
    EXPECT_EQ(json::nearest("trrain", kMethods), "terrain");
    EXPECT_EQ(json::nearest("wangldi", kMethods), "wang-ldi");
    EXPECT_EQ(json::nearest("x", {}), "");
}

TEST(Schema, OfScenesSaysWhatTheParserChecks) {
    nlohmann::json schema = test::schema("scene.schema.json");
    for (const ObjectForm& form : scene_forms()) test::expect_object_agrees(schema, std::string(form.schema), form.members);
    EXPECT_EQ(schema["properties"]["version"]["const"], kSceneVersion);
    EXPECT_EQ(schema["$defs"].size() + 1, scene_forms().size());
    std::string pattern = schema["$defs"]["layer"]["properties"]["method"]["pattern"];
    for (std::string_view method : kMethods) EXPECT_NE(pattern.find(method), std::string::npos) << method;
    EXPECT_EQ(schema["properties"]["error_px"]["default"].get<double>(), Scene{}.error_px);
    EXPECT_EQ(schema["$defs"]["camera"]["properties"]["fov_y_deg"]["default"].get<double>(), CameraDefaults{}.fov_y_deg);
    EXPECT_EQ(schema["$defs"]["light"]["properties"]["haze"]["default"].get<double>(), Light{}.haze);
    const nlohmann::json& planting = schema["$defs"]["planting"]["properties"];
    EXPECT_EQ(planting["steepest"]["default"].get<double>(), Planting{}.steepest);
    EXPECT_EQ(planting["fairing_tiles"]["default"].get<double>(), Planting{}.fairing_tiles);
    EXPECT_EQ(planting["seed"]["default"].get<double>(), Planting{}.seed);
}

TEST(Schema, OfFlightsSaysWhatTheParserChecks) {
    nlohmann::json schema = test::schema("flight.schema.json");
    for (const ObjectForm& form : flight_forms()) test::expect_object_agrees(schema, std::string(form.schema), form.members);
    EXPECT_EQ(schema["properties"]["version"]["const"], kFlightVersion);
    EXPECT_EQ(schema["properties"]["step_s"]["default"].get<double>(), Flight{}.step_s);
    for (std::string name : schema["properties"]["interpolation"]["enum"])
        EXPECT_EQ(flight_error(replaced(kFlight, "linear", name)), "(read)");
}

}  // namespace
}  // namespace overlook::scene
