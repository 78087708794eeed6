#include "tools/measure/methods.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>

#include "formats/names.h"
#include "runtime/caveclod/settings.h"
#include "runtime/lod_sprite/draw_paper_frames.h"
#include "runtime/terrain/refine.h"
#include "tools/measure/discrete_method.h"
#include "tools/measure/full_geometry.h"
#include "tools/measure/lod_sprite_method.h"
#include "tools/measure/lod_sprite_paper_method.h"
#include "tools/measure/mesh_method.h"
#include "tools/measure/planting_method.h"
#include "tools/measure/streamed_method.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

constexpr SettingKind kErrorPx{"error-px", 0.01, 1000, 1, false};
constexpr SettingKind kSamples{"samples", 1, 8, 4, true};
constexpr SettingKind kMorph{"morph", 0, 1, terrain::kDefaultMorph, false};
constexpr SettingKind kTriangles{"triangles", 0, 1e9, 0, true, true};
constexpr std::array<SettingKind, 4> kTerrainSettings = {kErrorPx, kSamples, kMorph, kTriangles};
constexpr std::array<SettingKind, 3> kHardSettings = {kErrorPx, kSamples, kTriangles};
constexpr std::array<SettingKind, 3> kTileSettings = {kErrorPx, kSamples, kMorph};
constexpr std::array<SettingKind, 1> kFullSettings = {kSamples};
// What runtime says of a method, and the samples of the pictures.
std::vector<SettingKind> with_samples(std::span<const SettingKind> settings) {
    std::vector<SettingKind> all(settings.begin(), settings.end());
    all.push_back(kSamples);
    return all;
}

std::vector<SettingKind> with_streaming(std::span<const SettingKind> settings) {
    std::vector<SettingKind> all(settings.begin(), settings.end());
    all.insert(all.end(), kStreamSettings.begin(), kStreamSettings.end());
    return all;
}

std::vector<MethodKind> make_kinds() {
    static const std::vector<SettingKind> kSprite = with_samples(lod_sprite::setting_kinds());
    static const std::vector<SettingKind> kSpritePaper = with_samples(lod_sprite::paper::setting_kinds());
    static const std::vector<SettingKind> kOwn = with_samples(caveclod::setting_kinds(caveclod::Variant::own)),
                                          kOthers = with_samples(caveclod::setting_kinds(caveclod::Variant::paper)),
                                          kBlocks = with_streaming(kOwn), kTiles = with_streaming(kTileSettings);
    std::vector<MethodKind> kinds = {
        {"terrain", "", kTerrainSettings}, {"terrain", "hard", kHardSettings},    {"terrain", "streamed", kTiles},
        {"lod-sprite", "", kSprite},       {"lod-sprite", "paper", kSpritePaper}, {"caveclod", "", kOwn},
        {"caveclod", "paper", kOthers},    {"caveclod", "shared", kOthers},       {"caveclod", "streamed", kBlocks}};
    static std::vector<std::vector<SettingKind>> levels;
    for (const DiscreteVariant& one : discrete_variants()) levels.push_back(with_samples(discrete::setting_kinds(one.variant)));
    kinds.push_back({"discrete", "", levels.front()});
    for (size_t i = 0; i < levels.size(); ++i) kinds.push_back({"discrete", discrete_variants()[i].name, levels[i]});
    static const std::vector<SettingKind> kPlanted = planting_settings(wang_ldi::Variant::own),
                                          kPlantedPaper = planting_settings(wang_ldi::Variant::paper);
    kinds.push_back({"wang-ldi", "", kPlanted});
    kinds.push_back({"wang-ldi", "paper", kPlantedPaper});
    kinds.push_back({"full", "", kFullSettings});
    return kinds;
}

const std::vector<MethodKind>& kinds() {
    static const std::vector<MethodKind> kKinds = make_kinds();
    return kKinds;
}

// A method as typed, with the settings that were given alone.
struct Asked {
    const MethodKind* kind = nullptr;
    MethodSpec spec;
    std::vector<bool> is_given;  // of each setting
};

// "; did you mean terrain?", or nothing if no name is near.
template <class Kinds>
std::string suggestion(std::string_view word, const Kinds& kinds) {
    std::string_view nearest;
    size_t least = std::max<size_t>(2, word.size() / 3) + 1;
    for (const auto& kind : kinds) {
        size_t distance = edit_distance(word, kind.name);
        if (distance < least) {
            least = distance;
            nearest = kind.name;
        }
    }
    return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::string known_names() {
    std::string names;
    for (const MethodKind& kind : kinds()) {
        if (kind.variant.empty()) names += (names.empty() ? "" : ", ") + std::string(kind.name);
    }
    return names;
}

std::optional<double> number_of(std::string_view text, const SettingKind& kind) {
    if (!kind.words.empty()) return value_of_word(kind, text);
    double value = 0;
    auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool is_number = problem == std::errc() && after == text.data() + text.size();
    if (!is_number || !(value >= kind.least && value <= kind.most)) return std::nullopt;
    if (kind.is_whole && value != std::floor(value)) return std::nullopt;
    return value;
}

std::string wanted(const SettingKind& kind) {
    if (!kind.words.empty()) return fmt::format("{} takes {}", kind.name, listed_words(kind));
    return fmt::format("{} takes a {}number from {} to {}", kind.name, kind.is_whole ? "whole " : "", kind.least, kind.most);
}

size_t place_of(const MethodKind& kind, std::string_view setting_name) {
    auto found = std::find_if(kind.settings.begin(), kind.settings.end(),
                              [&](const SettingKind& setting_kind) { return setting_kind.name == setting_name; });
    return size_t(found - kind.settings.begin());
}

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    while (true) {
        size_t end = std::min(text.find(at), text.size());
        parts.push_back(text.substr(0, end));
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

Result<void> take_setting(std::string_view text, std::string_view part, Asked& asked) {
    std::string_view name = part.substr(0, part.find('='));
    size_t place = place_of(*asked.kind, name);
    if (place == asked.kind->settings.size()) {
        return bad_command("--method {}: {} has no setting {}{}", text, family_of(asked.spec), name,
                           suggestion(name, asked.kind->settings));
    }
    if (asked.is_given[place]) return bad_command("--method {}: {} is given twice", text, name);
    const SettingKind& kind = asked.kind->settings[place];
    std::optional<double> value = number_of(part.substr(std::min(name.size() + 1, part.size())), kind);
    if (!value) return bad_command("--method {}: {}", text, wanted(kind));
    asked.spec.settings[place].second = *value;
    asked.is_given[place] = true;
    return {};
}

Result<Asked> asked_from(std::string_view text) {
    std::vector<std::string_view> parts = split(text, '@');
    size_t colon = parts[0].find(':');
    std::string_view name = parts[0].substr(0, colon);
    std::string_view variant = colon == std::string_view::npos ? "" : parts[0].substr(colon + 1);
    auto has_name = [&](const MethodKind& known) { return known.name == name; };
    if (std::none_of(kinds().begin(), kinds().end(), has_name)) {
        std::string near = suggestion(name, kinds());
        return bad_command("--method {}: there is no such method{} (known: {})", text, near, known_names());
    }
    auto kind = std::find_if(kinds().begin(), kinds().end(),
                             [&](const MethodKind& known) { return has_name(known) && known.variant == variant; });
    bool names_nothing = colon != std::string_view::npos && variant.empty();
    if (kind == kinds().end() || names_nothing) return bad_command("--method {}: {} has no such variant", text, name);
    Asked asked{&*kind, {std::string(name), std::string(variant), {}}, std::vector<bool>(kind->settings.size())};
    for (const SettingKind& known : kind->settings) asked.spec.settings.emplace_back(known.name, known.otherwise);
    for (size_t i = 1; i < parts.size(); ++i) {
        if (Result<void> taken = take_setting(text, parts[i], asked); !taken) return tl::unexpected(taken.error());
    }
    return asked;
}

// Replaces each method that the sweep concerns by one a value.
Result<std::vector<Asked>> swept(const std::vector<Asked>& methods, std::string_view sweep) {
    size_t equals = sweep.find('=');
    if (equals == std::string_view::npos) return bad_command("--sweep {}: setting=value,value,... is wanted", sweep);
    std::string_view name = sweep.substr(0, equals);
    std::vector<Asked> all;
    bool concerns_any = false;
    for (const Asked& method : methods) {
        size_t place = place_of(*method.kind, name);
        if (place == method.kind->settings.size() || method.is_given[place]) {
            all.push_back(method);
            continue;
        }
        concerns_any = true;
        for (std::string_view text : split(sweep.substr(equals + 1), ',')) {
            std::optional<double> value = number_of(text, method.kind->settings[place]);
            if (!value) return bad_command("--sweep {}: {}", sweep, wanted(method.kind->settings[place]));
            all.push_back(method);
            all.back().spec.settings[place].second = *value;
            all.back().is_given[place] = true;
        }
    }
    if (!concerns_any) return bad_command("--sweep {}: none of the methods has a setting {} to sweep", sweep, name);
    return all;
}

}  // namespace

std::span<const MethodKind> method_kinds() {
    return kinds();
}

const MethodKind* kind_of(const MethodSpec& spec) {
    auto kind = std::find_if(kinds().begin(), kinds().end(),
                             [&](const MethodKind& one) { return one.name == spec.name && one.variant == spec.variant; });
    return kind == kinds().end() ? nullptr : &*kind;
}

std::string named(const MethodSpec& spec) {
    return spec.variant.empty() ? spec.name : spec.name + ":" + spec.variant;
}

std::string family_of(const MethodSpec& spec) {
    return budget_of(spec) > 0 ? named(spec) + "@" + std::string(kTriangles.name) : named(spec);
}

std::string label_of(const MethodSpec& spec) {
    std::string label = named(spec);
    const MethodKind* kind = kind_of(spec);
    for (const auto& [name, value] : spec.settings) {
        const SettingKind* known = kind == nullptr ? nullptr : &kind->settings[place_of(*kind, name)];
        bool goes_without_saying = known != nullptr && known->is_seldom && known->otherwise == value;
        if (!goes_without_saying)
            label += fmt::format("@{}={}", name, known != nullptr ? text_of(*known, value) : fmt::format("{}", value));
    }
    return label;
}

double budget_of(const MethodSpec& spec) {
    for (const auto& [name, value] : spec.settings) {
        if (name == kTriangles.name) return value;
    }
    return 0;
}

double setting(const MethodSpec& spec, const std::string& name) {
    auto found = std::find_if(spec.settings.begin(), spec.settings.end(), [&](const auto& one) { return one.first == name; });
    assert(found != spec.settings.end());
    return found->second;
}

Result<MethodSpec> parse_method(std::string_view text) {
    Result<Asked> asked = asked_from(text);
    if (!asked) return tl::unexpected(asked.error());
    return asked->spec;
}

Result<std::vector<MethodSpec>> specs_from(const std::vector<std::string>& methods, const std::vector<std::string>& sweeps) {
    std::vector<Asked> all;
    for (const std::string& text : methods) {
        Result<Asked> asked = asked_from(text);
        if (!asked) return tl::unexpected(asked.error());
        all.push_back(std::move(*asked));
    }
    for (const std::string& sweep : sweeps) {
        Result<std::vector<Asked>> more = swept(all, sweep);
        if (!more) return tl::unexpected(more.error());
        all = std::move(*more);
    }
    std::vector<MethodSpec> specs;
    for (const Asked& asked : all) {
        if (std::find(specs.begin(), specs.end(), asked.spec) == specs.end()) specs.push_back(asked.spec);
    }
    return specs;
}

MethodSpec floor_spec(double samples) {
    return {"full", "", {{"samples", samples}}};
}

bool is_floor(const MethodSpec& spec) {
    return spec.name == "full" && spec.variant.empty();
}

double morph_of(const MethodSpec& spec) {
    return spec.variant == "hard" ? 0 : setting(spec, "morph");
}

std::unique_ptr<Method> make_method(const MethodSpec& spec, World& world) {
    if (is_floor(spec)) return make_full_method(world);
    if (is_streamed(spec)) return make_streamed_method(world, spec);
    if (family_of(spec) == "lod-sprite:paper") return make_lod_sprite_paper_method(world, spec);
    if (spec.name == "lod-sprite") return make_lod_sprite_method(world, spec);
    if (spec.name == "caveclod") return make_caveclod_method(world, spec);
    if (world.is_planted()) return make_planting_method(world, spec);
    if (world.is_chain()) return make_chain_method(world, spec);
    if (spec.name == "discrete") return make_discrete_method(world, setting(spec, "error-px"));
    assert(spec.name == "terrain");
    return make_terrain_method(world, {budget_of(spec), setting(spec, "error-px"), false}, morph_of(spec));
}

}  // namespace overlook::measure
