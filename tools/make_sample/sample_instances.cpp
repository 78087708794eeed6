#include "tools/make_sample/sample_instances.h"

#include <cmath>
#include <numbers>
#include <random>
#include <span>

#include "formats/scene.h"
#include "tools/make_sample/glb.h"
#include "tools/make_sample/sample_folder.h"
#include "tools/make_sample/shapes.h"
#include "tools/make_sample/tree.h"
#include "tools/make_sample/windmill.h"

namespace overlook::sample {
namespace {

constexpr double kStep_s = 1.0 / 32;

// What stands about, how far from one another, and how the flight goes.
struct Kind {
    std::string name, asset;
    int levels;
    double apart_m, eye_m, flight_s, metres_per_s;
    double up_m;  // of the instances
    double least_scale, most_scale;
    bool turns;
};
const Kind kKinds[] = {{"trees", "tree", kTreeLevels, 15, 2.5, 20, 6, 0, 0.8, 1.25, true},
                       {"windmills", "windmill", kWindmillLevels, 40, 6, 20, 16, 0, 0.9, 1.1, true},
                       {"simple", "simple", 2, 5, 1.7, 12, 3, 1, 1, 1, false}};

const Kind& kind_of(const std::string& name) {
    for (const Kind& kind : kKinds)
        if (kind.name == name) return kind;
    return kKinds[0];
}

GlbNode sphere() {
    mesh::Surface red;
    red.name = "red", red.base_colour = {0.85f, 0.08f, 0.06f, 1};
    ShapeMaker shapes({red});
    shapes.add_tube(0, 30, 48, true, [](double share, double angle) {
        double up = -std::cos(std::numbers::pi * (0.015 + 0.97 * share)), flat = std::sqrt(1 - up * up);
        return glm::dvec3(flat * std::cos(angle), flat * std::sin(angle), up);
    });
    return {"sphere", shapes.take(), {0, 0, 0}, {0, 0, 0}};
}

// knob_m: how far a knob stands out at the top; 0 = none.
GlbNode cube(const char* name, const glm::vec4& colour, double knob_m = 0) {
    mesh::Surface surface;
    surface.name = name, surface.base_colour = colour;
    ShapeMaker shapes({surface});
    shapes.add_box(0, {0, 0, 0}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 0.8}, 1, 1);
    if (knob_m > 0) shapes.add_box(0, {0, 0, 0.8 + knob_m / 2}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, knob_m / 2}, 1, 1);
    return {"cube", shapes.take(), {0, 0, 0}, {0, 0, 0}};
}
const glm::vec4 kBlue{0.06f, 0.12f, 0.85f, 1}, kYellow{0.85f, 0.7f, 0.05f, 1}, kGreen{0.05f, 0.5f, 0.1f, 1};
constexpr double kKnob_m = 0.4;

GlbNode plain(double side_m) {
    constexpr uint32_t kCells = 24;
    mesh::Surface ground;
    ground.name = "ground", ground.base_colour = {0.24f, 0.36f, 0.16f, 1};
    ShapeMaker shapes({ground});
    shapes.add_box(0, {0, 0, -0.5}, {side_m / 2, 0, 0}, {0, side_m / 2, 0}, {0, 0, 0.5}, kCells, kCells);
    return {"plain", shapes.take(), {0, 0, 0}, {0, 0, 0}};
}

Result<std::string> level_text(const Kind& kind, int level, uint64_t seed) {
    if (kind.name == "windmills") return glb_text(windmill(level), kWindmillTurn_s);
    if (kind.name == "simple") return glb_text({level == 0 ? sphere() : cube("blue", kBlue)}, 0);
    auto tree = tree_mesh(seed, tree_detail(level));
    if (!tree) return tl::unexpected(tree.error());
    return glb_text({{"tree", std::move(*tree), {0, 0, 0}, {0, 0, 0}}}, 0);
}

// Rows and columns of a square, as near it as the count allows.
uint32_t side_count(uint32_t count) {
    return uint32_t(std::ceil(std::sqrt(double(count))));
}

std::string scene_text(const Kind& kind, const InstancesOptions& options, uint32_t count) {
    std::mt19937_64 random(options.seed ^ 0x5eed);
    auto number = [&] { return double(random() >> 11) * 0x1p-53; };
    std::string instances;
    uint32_t side = side_count(count);
    for (uint32_t i = 0; i < count; ++i) {
        double jitter = kind.turns ? 0.7 : 0;
        double x_m = kind.apart_m * (i % side - (side - 1) / 2.0 + jitter * (number() - 0.5));
        double y_m = kind.apart_m * (i / side - (side - 1) / 2.0 + jitter * (number() - 0.5));
        double turn_deg = kind.turns ? 360 * number() - 180 : 0;
        double scale = kind.least_scale + (kind.most_scale - kind.least_scale) * number();
        instances +=
            fmt::format("{}        {{\"translation_m\": [{:.2f}, {:.2f}, {:g}], \"rotation_z_deg\": {:.1f}, \"scale\": {:.3f}}}",
                        i == 0 ? "" : ",\n", x_m, y_m, kind.up_m, turn_deg, scale);
    }
    return fmt::format(
        "{{\n  \"version\": {},\n  \"layers\": [\n    {{\n      \"asset\": \"plain.ovl\",\n      \"method\": \"discrete\"\n    "
        "}},\n"
        "    {{\n      \"asset\": \"{}.ovl\",\n      \"method\": \"discrete\",\n      \"instances\": [\n{}\n      ]\n    }}\n  "
        "],\n"
        "  \"camera\": {{\"fov_y_deg\": 60, \"near_m\": 0.5}},\n  \"error_px\": 1\n}}\n",
        scene::kSceneVersion, kind.asset, instances);
}

// Northwards into the field, swaying a little.
scene::Flight flight_of(const Kind& kind, uint32_t count) {
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    double edge_m = kind.apart_m * side_count(count) / 2;
    for (int i = 0; i <= 8; ++i) {
        double share = i / 8.0;
        scene::Key key;
        key.time_s = kind.flight_s * share;
        key.position_m = {0.3 * kind.apart_m * std::sin(2 * share), -edge_m - kind.apart_m + kind.metres_per_s * key.time_s,
                          kind.eye_m * (1 + 0.5 * share)};
        key.heading_deg = 6 * std::sin(4 * share);
        key.pitch_deg = -2;
        flight.keys.push_back(key);
    }
    return flight;
}

std::string readme_of(const Kind& kind) {
    std::string levels;
    for (int level = 0; level < kind.levels; ++level) levels += fmt::format(" {}-{}.glb", kind.asset, level);
    std::string text = fmt::format("# {}\n\n", kind.name);
    if (kind.name != "simple")
        text += fmt::format("Overlook's own levels, cut from the finest:\n\n    bake-lod discrete {}-0.glb -o {}.ovl --why\n\n",
                            kind.asset, kind.asset);
    text += fmt::format("Levels made by hand, as in the paper:\n\n    bake-lod discrete{} -o {}.ovl --why\n\n", levels,
                        kind.name == "simple" ? kind.asset : kind.asset + "-by-hand");
    if (kind.name == "simple")
        text +=
            "The sphere's own levels; and two whose faces are coplanar but for a knob:\n\n    bake-lod discrete simple-0.glb -o "
            "sphere.ovl\n    bake-lod discrete coplanar-0.glb coplanar-1.glb -o coplanar.ovl\n\n";
    text +=
        "The ground, and what it looks like:\n\n    bake-lod discrete plain.glb -o plain.ovl --most-levels 1\n"
        "    player scene.json --flight flight.json\n";
    return text;
}

}  // namespace

Result<std::vector<std::string>> make_instances(const std::string& name, const InstancesOptions& options,
                                                const std::string& folder) {
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());
    const Kind& kind = kind_of(name);
    std::vector<std::pair<std::string, std::string>> files;
    for (int level = 0; level < kind.levels; ++level) {
        auto text = level_text(kind, level, options.seed);
        if (!text) return tl::unexpected(text.error());
        files.emplace_back(fmt::format("{}-{}.glb", kind.asset, level), std::move(*text));
    }
    if (kind.name == "simple") {
        files.emplace_back("coplanar-0.glb", glb_text({cube("yellow", kYellow, kKnob_m)}, 0));
        files.emplace_back("coplanar-1.glb", glb_text({cube("green", kGreen)}, 0));
    }
    double side_m = kind.apart_m * (side_count(options.count) + 8);
    files.emplace_back("plain.glb", glb_text({plain(side_m)}, 0));
    files.emplace_back("scene.json", scene_text(kind, options, options.count));
    files.emplace_back("flight.json", scene::json_from_flight(flight_of(kind, options.count)));
    files.emplace_back("README.md", readme_of(kind));
    if (Result<void> written = made->write(files); !written) return tl::unexpected(written.error());
    return made->files();
}

}  // namespace overlook::sample
