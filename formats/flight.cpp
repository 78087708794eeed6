#include <algorithm>
#include <cmath>

#include "formats/numbers.h"
#include "formats/scene.h"

namespace overlook::scene {
namespace {

using json::Form;
using json::Kind;
using json::Member;
using json::Node;

constexpr Member kFlightMembers[] = {
    {"version", Kind::number, true, 1, 1e6},
    {"step_s", Kind::number, false, 1e-4, 3600},
    {"interpolation", Kind::text, true},
    {"keys", Kind::array, true, 1, double(kMostKeys)},
};
constexpr Member kKeyMembers[] = {
    {"time_s", Kind::number, true, 0, 1e6},         {"position_m", Kind::array, true, -1e9, 1e9, 3},
    {"heading_deg", Kind::number, true, -360, 360}, {"pitch_deg", Kind::number, true, -90, 90},
    {"fov_y_deg", Kind::number, false, 1, 170},
};
constexpr ObjectForm kForms[] = {{"", kFlightMembers}, {"/$defs/key", kKeyMembers}};
constexpr std::array<std::string_view, 3> kInterpolations = {"constant", "linear", "smooth"};

Interpolation read_interpolation(Form& form, const Node& node) {
    if (node.value == nullptr) return Interpolation::smooth;
    const std::string& text = node.value->text;
    auto found = std::find(kInterpolations.begin(), kInterpolations.end(), text);
    if (found == kInterpolations.end()) {
        std::string shown = text.substr(0, 64);
        form.fail(node, fmt::format("{} is no interpolation; did you mean {}?", shown, json::nearest(shown, kInterpolations)));
        return Interpolation::smooth;
    }
    return Interpolation(found - kInterpolations.begin());
}

void read_key(Form& form, const Node& node, std::vector<Key>& keys) {
    form.expect(node, kKeyMembers);
    if (!form.is_right()) return;
    Key key;
    key.time_s = form.number(node, "time_s", 0);
    std::vector<Node> position = form.items(form.member(node, "position_m"));
    for (size_t i = 0; i < position.size(); ++i) key.position_m[i] = position[i].value->number;
    key.heading_deg = form.number(node, "heading_deg", 0);
    key.pitch_deg = form.number(node, "pitch_deg", 0);
    if (form.member(node, "fov_y_deg").value != nullptr) key.fov_y_deg = form.number(node, "fov_y_deg", 0);
    if (!keys.empty() && !(key.time_s > keys.back().time_s)) {
        form.fail(form.member(node, "time_s"),
                  fmt::format("{} is not after the key before, at {}", key.time_s, keys.back().time_s));
    }
    keys.push_back(key);
}

Result<Flight> flight_from(const json::Value& root, const std::string& name) {
    Form form(root, name);
    Flight flight;
    json::check_version(form, kFlightVersion);
    form.expect(form.root(), kFlightMembers);
    flight.interpolation = read_interpolation(form, form.member(form.root(), "interpolation"));
    flight.step_s = form.number(form.root(), "step_s", flight.step_s);
    for (const Node& key : form.items(form.member(form.root(), "keys"))) read_key(form, key, flight.keys);

    if (form.is_right() && flight.keys.back().time_s / flight.step_s > kMostFrames) {
        Node step = form.member(form.root(), "step_s");
        form.fail(step.value != nullptr ? step : form.root(),
                  fmt::format("{} makes more than {} frames of {} s; a longer step is wanted", flight.step_s,
                              with_commas(kMostFrames), flight.keys.back().time_s));
    }
    return form.finish(std::move(flight));
}

}  // namespace

std::span<const ObjectForm> flight_forms() {
    return kForms;
}

Result<Flight> parse_flight(std::string_view text, const std::string& name) {
    Result<json::Value> root = json::parse(text, name);
    if (!root) return tl::unexpected(root.error());
    return flight_from(*root, name);
}

Result<Flight> read_flight(const std::string& path) {
    Result<json::Value> root = json::read(path);
    if (!root) return tl::unexpected(root.error());
    return flight_from(*root, path);
}

std::string json_from_flight(const Flight& flight) {
    std::string text = fmt::format("{{\n  \"version\": {},\n  \"step_s\": {},\n  \"interpolation\": \"{}\",\n  \"keys\": [",
                                   kFlightVersion, flight.step_s, kInterpolations[size_t(flight.interpolation)]);
    const char* before = "\n";
    for (const Key& key : flight.keys) {
        text +=
            fmt::format("{}    {{\"time_s\": {}, \"position_m\": [{}, {}, {}], \"heading_deg\": {}, \"pitch_deg\": {}", before,
                        key.time_s, key.position_m[0], key.position_m[1], key.position_m[2], key.heading_deg, key.pitch_deg);
        if (key.fov_y_deg) text += fmt::format(", \"fov_y_deg\": {}", *key.fov_y_deg);
        text += "}";
        before = ",\n";
    }
    return text + "\n  ]\n}\n";
}

uint32_t frame_count(const Flight& flight) {
    if (flight.keys.empty()) return 0;
    double steps = flight.keys.back().time_s / flight.step_s;
    return uint32_t(std::clamp(std::floor(steps + 1e-9), 0.0, double(kMostFrames))) + 1;
}

}  // namespace overlook::scene
