#include "runtime/player/method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace overlook::player {
namespace {

constexpr std::array<std::string_view, 15> kNames = {
    "terrain",         "lod-sprite",      "lod-sprite:paper", "caveclod",           "caveclod:paper",
    "caveclod:shared", "discrete",        "discrete:fsi",     "discrete:fsi-paper", "discrete:switch",
    "discrete:blend",  "discrete:dither", "discrete:late",    "wang-ldi",           "wang-ldi:paper"};
static_assert(size_t(Method::wang_ldi_paper) + 1 == kNames.size());
constexpr std::array<SettingKind, 1> kErrorAlone = {SettingKind{"error-px", 0.001, 10000, 1}};

std::span<const SettingKind> settings_of(Method method) {
    switch (method) {
        case Method::lod_sprite:
            return lod_sprite::setting_kinds();
        case Method::lod_sprite_paper:
            return lod_sprite::paper::setting_kinds();
        case Method::caveclod:
        case Method::caveclod_paper:
        case Method::caveclod_shared:
            return caveclod::setting_kinds(variant_of(method));
        case Method::wang_ldi:
        case Method::wang_ldi_paper:
            return wang_ldi::setting_kinds(planting_variant_of(method));
        case Method::terrain:
            break;
        default:
            return discrete::setting_kinds(discrete_variant_of(method));
    }
    return kErrorAlone;
}

std::string scene_name(std::string_view setting) {
    std::string name(setting);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::string wanted(const SettingKind& kind) {
    if (kind.is_switch) return "true or false is wanted";
    if (!kind.words.empty()) return fmt::format("{} is wanted", listed_words(kind));
    return fmt::format("a {}number from {} to {} is wanted", kind.is_whole ? "whole " : "", kind.least, kind.most);
}

// The setting's value, switches as 0 or 1, words as their places.
std::optional<double> value_of(const scene::Setting& setting, const SettingKind& kind) {
    if (kind.is_switch) {
        const bool* is_on = std::get_if<bool>(&setting);
        return is_on != nullptr ? std::optional(double(*is_on)) : std::nullopt;
    }
    if (!kind.words.empty()) {
        const std::string* word = std::get_if<std::string>(&setting);
        return word != nullptr ? value_of_word(kind, *word) : std::nullopt;
    }
    const double* number = std::get_if<double>(&setting);
    if (number == nullptr || !(*number >= kind.least && *number <= kind.most)) return std::nullopt;
    if (kind.is_whole && *number != std::floor(*number)) return std::nullopt;
    return *number;
}

// Of "/layers/PLACE".
Result<Method> method_of(const std::string& path, const scene::Layer& layer, size_t place) {
    std::string whole = layer.variant.empty() ? layer.method : layer.method + ":" + layer.variant;
    auto found = std::find(kNames.begin(), kNames.end(), whole);
    if (found != kNames.end()) return Method(found - kNames.begin());
    return bad_input("{}: /layers/{}/method: {} has no variant {}", path, place, layer.method, layer.variant);
}

// A setting by its name in scenes.
Result<SettingKind> kind_of(const std::string& path, Method method, const std::string& name, size_t place) {
    std::span<const SettingKind> kinds = settings_of(method);
    auto found = std::find_if(kinds.begin(), kinds.end(), [&](const SettingKind& kind) { return scene_name(kind.name) == name; });
    if (found != kinds.end()) return *found;
    std::vector<std::string> names;
    for (const SettingKind& kind : kinds) names.push_back(scene_name(kind.name));
    std::vector<std::string_view> known(names.begin(), names.end());
    std::string_view near = json::nearest(std::string_view(name).substr(0, 64), known);
    return bad_input("{}: /layers/{}/settings/{}: {} has no such setting; did you mean {}?", path, place, name.substr(0, 64),
                     name_of(method), near);
}

// A scene's own promises must not be finer than what they are built on.
Result<void> check_promises(const std::string& path, const LayerMethod& layer) {
    auto check = [&](std::string_view name, double value, double error_px) -> Result<void> {
        if (value >= error_px) return {};
        return bad_input("{}: /layers/0/settings/{}: {} is less than the error_px of {}", path, name, value, error_px);
    };
    if (layer.method == Method::lod_sprite_paper) return check("low_error_px", layer.paper.low_error_px, layer.paper.error_px);
    if (layer.method != Method::lod_sprite) return {};
    const lod_sprite::Settings& settings = layer.sprite.decide;
    Result<void> low = check("low_error_px", settings.low_error_px, settings.error_px);
    return low ? check("key_error_px", settings.key_error_px, settings.error_px) : low;
}

}  // namespace

std::string_view name_of(Method method) {
    return kNames[size_t(method)];
}

std::string_view name_of(Thing thing) {
    if (thing == Thing::planting) return "planting";
    if (thing == Thing::chain) return "chain of levels";
    return thing == Thing::mesh ? "mesh" : "terrain";
}

std::string_view things_of(Method method) {
    if (method >= Method::wang_ldi) return "plantings";
    if (method == Method::discrete) return "meshes and chains of levels";
    if (method > Method::discrete) return "chains of levels";
    return method >= Method::caveclod ? "meshes" : "terrains";
}

bool draws(Method method, Thing thing) {
    if (thing == Thing::planting || method >= Method::wang_ldi) return (thing == Thing::planting) == (method >= Method::wang_ldi);
    if (thing == Thing::chain) return method >= Method::discrete;
    if (method > Method::discrete) return false;
    return method == Method::lod_sprite || (method >= Method::caveclod) == (thing == Thing::mesh);
}

Method default_method(Thing thing) {
    if (thing == Thing::planting) return Method::wang_ldi;
    if (thing == Thing::chain) return Method::discrete;
    return thing == Thing::mesh ? Method::caveclod : Method::terrain;
}

bool takes_budgets(Method method) {
    return has_wireframe(method) || method >= Method::wang_ldi;
}

bool keeps_triangles(Method method, Thing thing) {
    return method == Method::caveclod || method == Method::caveclod_shared || thing == Thing::planting || keeps_ms(method, thing);
}

bool keeps_ms(Method, Thing thing) {
    return thing == Thing::chain;
}

bool has_wireframe(Method method) {
    return method == Method::terrain || (method >= Method::caveclod && method < Method::wang_ldi);
}

bool shows_sources(Method method) {
    return method == Method::lod_sprite || method >= Method::wang_ldi;
}

wang_ldi::Variant planting_variant_of(Method method) {
    return method == Method::wang_ldi_paper ? wang_ldi::Variant::paper : wang_ldi::Variant::own;
}

caveclod::Variant variant_of(Method method) {
    if (method == Method::caveclod_paper) return caveclod::Variant::paper;
    return method == Method::caveclod_shared ? caveclod::Variant::shared : caveclod::Variant::own;
}

discrete::Variant discrete_variant_of(Method method) {
    switch (method) {
        case Method::discrete_fsi_paper:
            return discrete::Variant::fsi_paper;
        case Method::discrete_switch:
            return discrete::Variant::hard;
        case Method::discrete_blend:
            return discrete::Variant::blend;
        case Method::discrete_dither:
            return discrete::Variant::dither;
        case Method::discrete_late:
            return discrete::Variant::late;
        default:
            return discrete::Variant::fsi;
    }
}

Method next(Method method, Thing thing) {
    auto after = [](Method one) { return Method((size_t(one) + 1) % kNames.size()); };
    Method found = after(method);
    while (!draws(found, thing) || found == Method::discrete_fsi) found = after(found);
    return found;
}

Result<Method> parse_method(std::string_view text) {
    auto found = std::find(kNames.begin(), kNames.end(), text);
    if (found != kNames.end()) return Method(found - kNames.begin());
    return bad_command("--method {}: there is no such method; did you mean {}? (known: {})", text,
                       json::nearest(text.substr(0, 64), kNames), fmt::join(kNames, ", "));
}

Result<LayerMethod> layer_method_of(const std::string& path, scene::Scene& described, size_t place) {
    const scene::Layer& layer = described.layers[place];
    LayerMethod read;
    Result<Method> method = method_of(path, layer, place);
    if (!method) return tl::unexpected(method.error());
    read.method = *method;

    std::vector<std::pair<SettingKind, double>> values;
    for (const auto& [name, setting] : layer.settings) {
        Result<SettingKind> kind = kind_of(path, read.method, name, place);
        if (!kind) return tl::unexpected(kind.error());
        std::optional<double> value = value_of(setting, *kind);
        if (!value) return bad_input("{}: /layers/{}/settings/{}: {}", path, place, name, wanted(*kind));
        if (kind->name == "error-px") described.error_px = *value;
        values.emplace_back(*kind, *value);
    }
    // What the scene does not say keeps the ratio to its error that it has by default.
    read.sprite = with_error(read.sprite, described.error_px);
    read.paper = with_error(read.paper, described.error_px);
    read.mesh = with_error(read.mesh, described.error_px);
    read.chain = with_error(discrete::defaults_of(discrete_variant_of(read.method)), described.error_px);
    read.planting = wang_ldi::defaults_of(planting_variant_of(read.method));
    read.planting.error_px = described.error_px;
    for (const auto& [kind, value] : values) {
        if (read.method == Method::lod_sprite) lod_sprite::set(read.sprite, kind.name, value);
        if (read.method == Method::lod_sprite_paper) lod_sprite::paper::set(read.paper, kind.name, value);
        if (read.method >= Method::caveclod && read.method < Method::discrete) caveclod::set(read.mesh, kind.name, value);
        if (read.method >= Method::wang_ldi) wang_ldi::set(read.planting, kind.name, value);
        if (read.method >= Method::discrete && read.method < Method::wang_ldi) discrete::set(read.chain, kind.name, value);
        read.sets_chain = read.sets_chain || (read.method == Method::discrete && kind.name != "error-px");
    }
    if (Result<void> checked = check_promises(path, read); !checked) return tl::unexpected(checked.error());
    return read;
}

lod_sprite::FrameOptions with_error(lod_sprite::FrameOptions options, double error_px) {
    double ratio = error_px / options.decide.error_px;
    options.decide.error_px = error_px;
    options.decide.low_error_px *= ratio;
    options.decide.key_error_px *= ratio;
    return options;
}

lod_sprite::paper::FrameOptions with_error(lod_sprite::paper::FrameOptions options, double error_px) {
    double ratio = error_px / options.error_px;
    options.error_px = error_px;
    options.low_error_px *= ratio;
    options.decide.key_error_px *= ratio;
    return options;
}

discrete::FrameOptions with_error(discrete::FrameOptions options, double error_px) {
    options.select.error_px = discrete::defaults_of(options.variant).select.error_px * error_px;
    return options;
}

caveclod::FrameOptions with_error(caveclod::FrameOptions options, double error_px) {
    options.settings.silhouette_error_px *= error_px / options.settings.error_px;
    options.settings.error_px = error_px;
    return options;
}

}  // namespace overlook::player
