#include "formats/scene.h"

#include <algorithm>
#include <cmath>

namespace overlook::scene {
namespace {

using json::Form;
using json::Kind;
using json::Member;
using json::Node;

constexpr Member kSceneMembers[] = {
    {"version", Kind::number, true, 1, 1e6},
    {"layers", Kind::array, true, 1, 64},
    {"light", Kind::object},
    {"camera", Kind::object},
    {"error_px", Kind::number, false, 0.001, 10000},
};
constexpr Member kLayerMembers[] = {
    {"asset", Kind::text, true},  {"transform", Kind::object}, {"instances", Kind::array, false, 1, double(kMostInstances)},
    {"method", Kind::text, true}, {"settings", Kind::object},  {"planting", Kind::object},
};
constexpr Member kTransformMembers[] = {
    {"translation_m", Kind::array, false, -1e9, 1e9, 3},
    {"rotation_z_deg", Kind::number, false, -360, 360},
    {"scale", Kind::number, false, 1e-6, 1e6},
};
constexpr Member kInstanceMembers[] = {
    kTransformMembers[0],
    kTransformMembers[1],
    kTransformMembers[2],
    {"velocity_m_s", Kind::array, false, -1e4, 1e4, 3},
    {"spin_deg_s", Kind::number, false, -3600, 3600},
};
constexpr Member kPlantingMembers[] = {
    {"lowest_m", Kind::number, false, -1e6, 1e6},
    {"highest_m", Kind::number, false, -1e6, 1e6},
    {"steepest", Kind::number, false, 0, 100},
    {"mask", Kind::text},
    {"density", Kind::text},
    {"fairing_tiles", Kind::number, false, 0, 8},
    {"seed", Kind::number, false, 0, 4294967295.0},
    {"tiling", Kind::text},
    {"models", Kind::array, false, 1, double(kMostModels)},
};
constexpr Member kLightMembers[] = {{"haze", Kind::number, false, 0, 10}};
constexpr Member kCameraMembers[] = {
    {"fov_y_deg", Kind::number, false, 1, 170},
    {"near_m", Kind::number, false, 0.001, 1000},
};
constexpr ObjectForm kForms[] = {
    {"", kSceneMembers},
    {"/$defs/layer", kLayerMembers},
    {"/$defs/transform", kTransformMembers},
    {"/$defs/instance", kInstanceMembers},
    {"/$defs/planting", kPlantingMembers},
    {"/$defs/light", kLightMembers},
    {"/$defs/camera", kCameraMembers},
};

bool is_variant(std::string_view text) {
    return !text.empty() && text.size() <= 64 &&
           text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string_view::npos;
}

void read_method(Form& form, const Node& node, Layer& layer) {
    if (node.value == nullptr) return;
    const std::string& text = node.value->text;
    size_t colon = text.find(':');
    layer.method = text.substr(0, colon);
    if (std::find(kMethods.begin(), kMethods.end(), layer.method) == kMethods.end()) {
        std::string shown = layer.method.substr(0, 64);
        return form.fail(node, fmt::format("{} is no method; did you mean {}?", shown, json::nearest(shown, kMethods)));
    }
    if (colon == std::string::npos) return;
    layer.variant = text.substr(colon + 1);
    if (!is_variant(layer.variant)) form.fail(node, "a variant is lower-case letters, digits and hyphens after the colon");
}

// A file's name, relative to the scene's; what: "a baked file".
void read_file_name(Form& form, const Node& node, std::string_view what, std::string& name) {
    if (node.value == nullptr) return;
    if (node.value->kind != Kind::text) return form.fail(node, fmt::format("is no text; name {}", what));
    name = node.value->text;
    if (name.empty()) return form.fail(node, fmt::format("is empty; name {}", what));
    if (name.front() == '/') return form.fail(node, "begins with /; name it relative to the scene's file");
    if (name.find('\0') != std::string::npos) form.fail(node, "holds a zero byte");
}

void read_settings(Form& form, const Node& node, Layer& layer) {
    std::vector<Node> items = form.items(node);
    for (size_t i = 0; i < items.size(); ++i) {
        const json::Value& value = *items[i].value;
        Setting setting;
        if (value.kind == Kind::boolean)
            setting = value.boolean;
        else if (value.kind == Kind::number)
            setting = value.number;
        else if (value.kind == Kind::text)
            setting = value.text;
        else
            return form.fail(items[i], "a setting is a number, text, true or false");
        layer.settings.emplace_back(node.value->names[i], std::move(setting));
    }
}

// Left as it is where there is none.
void read_triple(Form& form, const Node& node, std::array<double, 3>& triple) {
    std::vector<Node> items = form.items(node);
    if (!form.is_right()) return;
    for (size_t i = 0; i < items.size(); ++i) triple[i] = items[i].value->number;
}

// members: those of a transform, and perhaps more.
Transform read_transform(Form& form, const Node& node, std::span<const Member> members) {
    Transform transform;
    form.expect(node, members);
    read_triple(form, form.member(node, "translation_m"), transform.translation_m);
    if (!form.is_right()) return transform;
    transform.rotation_z_deg = form.number(node, "rotation_z_deg", transform.rotation_z_deg);
    transform.scale = form.number(node, "scale", transform.scale);
    return transform;
}

Instance read_instance(Form& form, const Node& node) {
    Instance instance{read_transform(form, node, kInstanceMembers)};
    read_triple(form, form.member(node, "velocity_m_s"), instance.velocity_m_s);
    if (form.is_right()) instance.spin_deg_s = form.number(node, "spin_deg_s", 0);
    return instance;
}

void read_instances(Form& form, const Node& node, Layer& layer) {
    if (node.value != nullptr && layer.method != "discrete")
        form.fail(node, fmt::format("{} draws no instances; discrete does", layer.method));
    for (const Node& item : form.items(node)) layer.instances.push_back(read_instance(form, item));
}

uint32_t read_whole(Form& form, const Node& object, std::string_view name, uint32_t otherwise) {
    double number = form.number(object, name, otherwise);
    if (number != std::floor(number)) form.fail(form.member(object, name), fmt::format("{} is no whole number", number));
    return form.is_right() ? uint32_t(number) : otherwise;
}

void read_planting(Form& form, const Node& node, Layer& layer) {
    if (node.value == nullptr) return;
    if (layer.method != "wang-ldi") return form.fail(node, fmt::format("{} plants nothing; wang-ldi does", layer.method));
    form.expect(node, kPlantingMembers);
    if (!form.is_right()) return;
    Planting& planting = layer.planting.emplace();
    auto number_of = [&](std::string_view name) -> std::optional<double> {
        if (form.member(node, name).value == nullptr) return std::nullopt;
        return form.number(node, name, 0);
    };
    planting.lowest_m = number_of("lowest_m"), planting.highest_m = number_of("highest_m");
    planting.steepest = form.number(node, "steepest", planting.steepest);
    read_file_name(form, form.member(node, "mask"), "a PNG", planting.mask);
    read_file_name(form, form.member(node, "density"), "a PNG", planting.density);
    planting.fairing_tiles = read_whole(form, node, "fairing_tiles", planting.fairing_tiles);
    planting.seed = read_whole(form, node, "seed", planting.seed);
    planting.tiling = form.text(node, "tiling", "").substr(0, 64);
    if (form.member(node, "tiling").value != nullptr &&
        std::find(kTilings.begin(), kTilings.end(), planting.tiling) == kTilings.end())
        form.fail(form.member(node, "tiling"), fmt::format("{} is no way to tile; did you mean {}?", planting.tiling,
                                                           json::nearest(planting.tiling, kTilings)));
    for (const Node& item : form.items(form.member(node, "models")))
        read_file_name(form, item, "a baked chain of levels", planting.models.emplace_back());
    if (planting.lowest_m && planting.highest_m && *planting.highest_m < *planting.lowest_m)
        form.fail(form.member(node, "highest_m"),
                  fmt::format("{} is below lowest_m, {}", *planting.highest_m, *planting.lowest_m));
}

Layer read_layer(Form& form, const Node& node) {
    Layer layer;
    form.expect(node, kLayerMembers);
    if (!form.is_right()) return layer;
    read_file_name(form, form.member(node, "asset"), "a baked file", layer.asset);
    read_method(form, form.member(node, "method"), layer);
    layer.transform = read_transform(form, form.member(node, "transform"), kTransformMembers);
    read_instances(form, form.member(node, "instances"), layer);
    read_settings(form, form.member(node, "settings"), layer);
    read_planting(form, form.member(node, "planting"), layer);
    return layer;
}

std::string text_of(const Setting& setting) {
    if (const bool* truth = std::get_if<bool>(&setting)) return *truth ? "true" : "false";
    if (const double* number = std::get_if<double>(&setting)) return fmt::format("{}", *number);
    return json::quoted(std::get<std::string>(setting));
}

std::string members_of(const Transform& transform) {
    return fmt::format("\"translation_m\": [{}, {}, {}], \"rotation_z_deg\": {}, \"scale\": {}", transform.translation_m[0],
                       transform.translation_m[1], transform.translation_m[2], transform.rotation_z_deg, transform.scale);
}

std::string text_of(const Instance& instance) {
    std::string text = "{" + members_of(instance.transform);
    const std::array<double, 3>& v = instance.velocity_m_s;
    if (instance.moves())
        text += fmt::format(", \"velocity_m_s\": [{}, {}, {}], \"spin_deg_s\": {}", v[0], v[1], v[2], instance.spin_deg_s);
    return text + "}";
}

std::string text_of(const Planting& planting) {
    std::string text = fmt::format("{{\"steepest\": {}, \"fairing_tiles\": {}, \"seed\": {}", planting.steepest,
                                   planting.fairing_tiles, planting.seed);
    if (planting.lowest_m) text += fmt::format(", \"lowest_m\": {}", *planting.lowest_m);
    if (planting.highest_m) text += fmt::format(", \"highest_m\": {}", *planting.highest_m);
    if (!planting.mask.empty()) text += ", \"mask\": " + json::quoted(planting.mask);
    if (!planting.density.empty()) text += ", \"density\": " + json::quoted(planting.density);
    if (!planting.tiling.empty()) text += ", \"tiling\": " + json::quoted(planting.tiling);
    for (size_t i = 0; i < planting.models.size(); ++i)
        text += (i == 0 ? ", \"models\": [" : ", ") + json::quoted(planting.models[i]);
    return text + (planting.models.empty() ? "}" : "]}");
}

std::string text_of(const Layer& layer) {
    std::string text = fmt::format("    {{\n      \"asset\": {},\n", json::quoted(layer.asset));
    text += fmt::format("      \"transform\": {{{}}},\n", members_of(layer.transform));
    for (size_t i = 0; i < layer.instances.size(); ++i)
        text += fmt::format("{}        {}", i == 0 ? "      \"instances\": [\n" : ",\n", text_of(layer.instances[i]));
    if (!layer.instances.empty()) text += "\n      ],\n";
    if (layer.planting) text += fmt::format("      \"planting\": {},\n", text_of(*layer.planting));
    text += fmt::format("      \"method\": {},\n      \"settings\": {{",
                        json::quoted(layer.variant.empty() ? layer.method : layer.method + ":" + layer.variant));
    for (size_t i = 0; i < layer.settings.size(); ++i) {
        const auto& [name, value] = layer.settings[i];
        text += fmt::format("{}{}: {}", i == 0 ? "" : ", ", json::quoted(name), text_of(value));
    }
    return text + "}\n    }";
}

Result<Scene> scene_from(const json::Value& root, const std::string& name) {
    Form form(root, name);
    Scene scene;
    json::check_version(form, kSceneVersion);
    form.expect(form.root(), kSceneMembers);
    for (const Node& layer : form.items(form.member(form.root(), "layers"))) scene.layers.push_back(read_layer(form, layer));

    Node light = form.member(form.root(), "light"), camera = form.member(form.root(), "camera");
    form.expect(light, kLightMembers);
    form.expect(camera, kCameraMembers);
    scene.light.haze = form.number(light, "haze", scene.light.haze);
    scene.camera.fov_y_deg = form.number(camera, "fov_y_deg", scene.camera.fov_y_deg);
    if (form.member(camera, "near_m").value != nullptr) scene.camera.near_m = form.number(camera, "near_m", 0);
    scene.error_px = form.number(form.root(), "error_px", scene.error_px);
    return form.finish(std::move(scene));
}

}  // namespace

Transform at_time(const Instance& instance, double time_s) {
    Transform moved = instance.transform;
    for (size_t i = 0; i < 3; ++i) moved.translation_m[i] += time_s * instance.velocity_m_s[i];
    moved.rotation_z_deg = std::fmod(moved.rotation_z_deg + std::fmod(time_s * instance.spin_deg_s, 360), 360);
    return moved;
}

std::span<const ObjectForm> scene_forms() {
    return kForms;
}

Result<Scene> parse_scene(std::string_view text, const std::string& name) {
    Result<json::Value> root = json::parse(text, name);
    if (!root) return tl::unexpected(root.error());
    return scene_from(*root, name);
}

Result<Scene> read_scene(const std::string& path) {
    Result<json::Value> root = json::read(path);
    if (!root) return tl::unexpected(root.error());
    return scene_from(*root, path);
}

std::string path_in_scene(const std::string& scene_path, const std::string& name) {
    size_t slash = scene_path.rfind('/');
    return slash == std::string::npos ? name : scene_path.substr(0, slash + 1) + name;
}

std::string asset_path(const std::string& scene_path, const Layer& layer) {
    return path_in_scene(scene_path, layer.asset);
}

std::string json_from_scene(const Scene& scene) {
    std::string text = fmt::format("{{\n  \"version\": {},\n  \"layers\": [\n", kSceneVersion);
    for (size_t i = 0; i < scene.layers.size(); ++i) text += (i == 0 ? "" : ",\n") + text_of(scene.layers[i]);
    text += fmt::format("\n  ],\n  \"light\": {{\"haze\": {}}},\n  \"camera\": {{\"fov_y_deg\": {}", scene.light.haze,
                        scene.camera.fov_y_deg);
    if (scene.camera.near_m) text += fmt::format(", \"near_m\": {}", *scene.camera.near_m);
    return text + fmt::format("}},\n  \"error_px\": {}\n}}\n", scene.error_px);
}

}  // namespace overlook::scene
