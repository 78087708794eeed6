#include "tools/measure/stability_case.h"

#include <algorithm>
#include <cmath>

#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

using json::Form;
using json::Kind;
using json::Member;
using json::Node;

constexpr uint32_t kCaseCount = 20;

constexpr Member kCaseMembers[] = {
    {"version", Kind::number, true, 1, 1e6},
    {"number", Kind::text, true},
    {"what", Kind::text, true},
    {"note", Kind::text},
    {"scene", Kind::text},
    {"flight", Kind::text},
    {"mesh_scene", Kind::text},
    {"mesh_flight", Kind::text},
    {"chain_scene", Kind::text},
    {"chain_flight", Kind::text},
    {"planting_scene", Kind::text},
    {"planting_flight", Kind::text},
    {"settings", Kind::object},
    {"gates", Kind::array, true, 1, 8},
    {"methods", Kind::array, true, 1, 5},
    {"runs", Kind::array, true, 0, 5},
};
constexpr Member kGateMembers[] = {
    {"figure", Kind::text, true},
    {"most", Kind::number, false, 0, 1e6},
    {"over_asked_px", Kind::number, false, 0, 1000},
    {"of", Kind::text},
};
constexpr Member kSettingMembers[] = {
    {"drop_every", Kind::number, false, 2, 1000}, {"world_moves_m", Kind::array, false, 1, 8},
    {"resize_shares", Kind::array, false, 1, 8},  {"budget_share", Kind::number, false, 0.01, 1},
    {"cameras", Kind::number, false, 2, 16},      {"goes_backwards", Kind::boolean, false},
    {"changed_pixel", Kind::number, false, 0, 1},
};

constexpr std::string_view kFigures[] = {
    "pop_index",
    "switches_after_first_second",
    "hole_pixels",
    "frames_above_twice_asked_error",
    "frames_until_error_met",
    "ghost_share",
    "loss_share",
    "near_plane_cuts",
    "silhouette_p95_px",
    "fallbacks_unsaid",
    "lost_mast_share",
    "honesty",
    "shear_error_px",
    "changed_pixel_share",
    "still_flicker",
    "transition_over_time_s",
    "pop_index_ratio",
    "stale_pixels",
    "cameras_that_differ",
    "budget_miss_share",
    "frames_until_budget_met",
    "changes_of_sign",
    "path_difference_grey",
};
constexpr std::string_view kMeshMethods[] = {"lod-sprite", "caveclod", "discrete"};  // draw meshes, the first terrains as well
constexpr std::string_view kChainMethod = "discrete";                                // draws chains as well
constexpr std::string_view kPlantingMethod = "wang-ldi";                             // draws plantings and nothing else
constexpr std::string_view kSides[] = {"all", "geometry", "image", "chain", "planting"};

template <class Names>
bool is_one_of(const Names& names, std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

CaseGate read_gate(Form& form, const Node& node) {
    CaseGate gate;
    form.expect(node, kGateMembers);
    if (!form.is_right()) return gate;
    gate.figure = form.text(node, "figure", "");
    gate.of = form.text(node, "of", gate.of);
    gate.most = form.number(node, "most", 0);
    gate.over_asked_px = form.number(node, "over_asked_px", -1);
    if (!is_one_of(kFigures, gate.figure)) {
        std::string shown = gate.figure.substr(0, 64);
        form.fail(form.member(node, "figure"),
                  fmt::format("{} is no figure; did you mean {}?", shown, json::nearest(shown, kFigures)));
    }
    if (!is_one_of(kSides, gate.of)) form.fail(form.member(node, "of"), "geometry, image, chain, planting or all is wanted");
    bool has_most = form.member(node, "most").value != nullptr, has_over = form.member(node, "over_asked_px").value != nullptr;
    if (!has_most && !has_over) form.fail(node, "has no bound: most or over_asked_px is wanted");
    if (has_most && has_over) form.fail(node, "has two bounds: most or over_asked_px is wanted");
    return gate;
}

std::vector<double> read_numbers(Form& form, const Node& node, double least, double most) {
    std::vector<double> numbers;
    for (const Node& item : form.items(node)) {
        double number = item.value->number;
        if (item.value->kind != Kind::number || !(number >= least && number <= most))
            form.fail(item, fmt::format("a number from {} to {} is wanted", least, most));
        numbers.push_back(number);
    }
    return numbers;
}

CaseSettings read_settings(Form& form, const Node& node) {
    CaseSettings settings;
    form.expect(node, kSettingMembers);
    if (!form.is_right() || node.value == nullptr) return settings;
    double drop_every = form.number(node, "drop_every", 0);
    if (drop_every != std::floor(drop_every)) form.fail(form.member(node, "drop_every"), "is no whole number");
    settings.drop_every = uint32_t(drop_every);
    double cameras = form.number(node, "cameras", 1);
    if (cameras != std::floor(cameras)) form.fail(form.member(node, "cameras"), "is no whole number");
    settings.cameras = uint32_t(cameras);
    settings.world_moves_m = read_numbers(form, form.member(node, "world_moves_m"), 0, 1e8);
    settings.resize_shares = read_numbers(form, form.member(node, "resize_shares"), 0.01, 4);
    settings.budget_share = form.number(node, "budget_share", 1);
    Node backwards = form.member(node, "goes_backwards"), changed = form.member(node, "changed_pixel");
    settings.goes_backwards = backwards.value != nullptr && backwards.value->boolean;
    if (changed.value != nullptr) settings.changed_pixel = changed.value->number;
    return settings;
}

std::vector<std::string> read_methods(Form& form, const Node& node) {
    std::vector<std::string> methods;
    for (const Node& item : form.items(node)) {
        std::string method = item.value->text.substr(0, 64);
        if (!is_one_of(scene::kMethods, method))
            form.fail(item, fmt::format("{} is no method; did you mean {}?", method, json::nearest(method, scene::kMethods)));
        if (is_one_of(methods, method)) form.fail(item, method + " stands twice");
        methods.push_back(method);
    }
    return methods;
}

bool is_number(const std::string& text) {
    for (uint32_t i = 1; i <= kCaseCount; ++i) {
        if (text == fmt::format("S{:02}", i)) return true;
    }
    return false;
}

// What only the whole case can tell.
void check_whole(Form& form, const Case& made) {
    if (!is_number(made.number))
        form.fail(form.member(form.root(), "number"), fmt::format("{} is no case; S01 to S20 are", made.number.substr(0, 64)));
    Node runs = form.member(form.root(), "runs");
    for (const Node& run : form.items(runs)) {
        if (!is_one_of(made.methods, run.value->text)) form.fail(run, run.value->text + " is not among the case's methods");
    }
    for (const Node& run : form.items(runs)) {
        bool is_of_mesh = is_one_of(kMeshMethods, run.value->text), is_of_chain = run.value->text == kChainMethod;
        if (run.value->text == kPlantingMethod) {
            if (made.planting_scene.empty() || made.planting_flight.empty())
                form.fail(runs, "a case that wang-ldi runs needs a planting_scene and a planting_flight");
            continue;
        }
        bool has_scene =
            !made.scene.empty() || (is_of_mesh && !made.mesh_scene.empty()) || (is_of_chain && !made.chain_scene.empty());
        bool has_flight =
            !made.flight.empty() || (is_of_mesh && !made.mesh_flight.empty()) || (is_of_chain && !made.chain_flight.empty());
        if (!has_scene || !has_flight) form.fail(runs, "a case that runs needs a scene and a flight");
    }
}

}  // namespace

Case for_meshes(Case each) {
    if (!each.mesh_scene.empty()) each.scene = each.mesh_scene;
    if (!each.mesh_flight.empty()) each.flight = each.mesh_flight;
    return each;
}

Case for_chains(Case each) {
    each.scene = each.chain_scene;
    if (!each.chain_flight.empty()) each.flight = each.chain_flight;
    return each;
}

Case for_plantings(Case each) {
    each.scene = each.planting_scene, each.flight = each.planting_flight;
    return each;
}

bool is_of_meshes_alone(const Case& each) {
    return !each.runs.empty() && each.scene.empty();
}

std::span<const std::string_view> figure_names() {
    return kFigures;
}

Result<Case> parse_case(std::string_view text, const std::string& name) {
    Result<json::Value> root = json::parse(text, name);
    if (!root) return tl::unexpected(root.error());
    Form form(*root, name);
    json::check_version(form, kCaseVersion);
    form.expect(form.root(), kCaseMembers);

    Case made;
    made.number = form.text(form.root(), "number", "");
    made.what = form.text(form.root(), "what", "");
    made.note = form.text(form.root(), "note", "");
    made.scene = form.text(form.root(), "scene", "");
    made.flight = form.text(form.root(), "flight", "");
    made.mesh_scene = form.text(form.root(), "mesh_scene", "");
    made.mesh_flight = form.text(form.root(), "mesh_flight", "");
    made.chain_scene = form.text(form.root(), "chain_scene", "");
    made.chain_flight = form.text(form.root(), "chain_flight", "");
    made.planting_scene = form.text(form.root(), "planting_scene", "");
    made.planting_flight = form.text(form.root(), "planting_flight", "");
    made.settings = read_settings(form, form.member(form.root(), "settings"));
    for (const Node& gate : form.items(form.member(form.root(), "gates"))) made.gates.push_back(read_gate(form, gate));
    made.methods = read_methods(form, form.member(form.root(), "methods"));
    made.runs = read_methods(form, form.member(form.root(), "runs"));
    check_whole(form, made);
    return form.finish(std::move(made));
}

Result<std::vector<Case>> read_cases(const std::string& folder) {
    std::vector<Case> cases;
    for (uint32_t i = 1; i <= kCaseCount; ++i) {
        std::string path = fmt::format("{}/s{:02}.json", folder, i);
        Result<MappedFile> file = MappedFile::open(path);
        if (!file) return tl::unexpected(file.error());
        std::span<const std::byte> bytes = file->bytes();
        Result<Case> made = parse_case({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
        if (!made) return tl::unexpected(made.error());
        if (made->number != fmt::format("S{:02}", i)) return bad_input("{}: is case {}", path, made->number);
        for (std::string* path_in : {&made->scene, &made->flight, &made->mesh_scene, &made->mesh_flight, &made->chain_scene,
                                     &made->chain_flight, &made->planting_scene, &made->planting_flight}) {
            if (!path_in->empty()) *path_in = folder + "/" + *path_in;
        }
        cases.push_back(std::move(*made));
    }
    return cases;
}

std::vector<std::string> owed_cases(std::span<const Case> cases) {
    std::vector<std::string> owed;
    for (const Case& each : cases) {
        for (const std::string& method : each.methods) {
            if (!is_one_of(each.runs, method)) owed.push_back(each.number + " " + method);
        }
    }
    return owed;
}

}  // namespace overlook::measure
