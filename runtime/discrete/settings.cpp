#include "runtime/discrete/settings.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

namespace overlook::discrete {
namespace {

constexpr double kImperceptible_px = 0.25;

constexpr std::array<std::string_view, 4> kCriteria = {"error", "size", "distance", "importance"};

enum class Whose { all, fading, turns, paper, fsi };

bool has(Variant variant, Whose whose) {
    switch (whose) {
        case Whose::all:
            return true;
        case Whose::fading:
            return fades(variant);
        case Whose::turns:
            return draws_by_turns(variant);
        case Whose::paper:
            return variant == Variant::fsi_paper;
        case Whose::fsi:
            return variant == Variant::fsi;
    }
    return false;
}

struct KnownSetting {
    Whose whose = Whose::all;
    SettingKind kind;  // `otherwise` is filled in by variant
    void (*set)(FrameOptions& options, double value);
    double (*get)(const FrameOptions& options);
};

KnownSetting number(Whose whose, std::string_view name, double least, double most, void (*set)(FrameOptions&, double),
                    double (*get)(const FrameOptions&)) {
    return {whose, SettingKind{name, least, most, 0, false, name != "error-px"}, set, get};
}
KnownSetting flag(Whose whose, std::string_view name, void (*set)(FrameOptions&, double), double (*get)(const FrameOptions&)) {
    return {whose, SettingKind{name, 0, 1, 0, true, true, true}, set, get};
}

#define OVERLOOK_NUMBER(whose, name, least, most, member)                          \
    number(                                                                        \
        whose, name, least, most, [](FrameOptions& o, double v) { o.member = v; }, \
        [](const FrameOptions& o) { return o.member; })
#define OVERLOOK_FLAG(whose, name, member)                                 \
    flag(                                                                  \
        whose, name, [](FrameOptions& o, double v) { o.member = v != 0; }, \
        [](const FrameOptions& o) { return double(o.member); })

const std::vector<KnownSetting>& known_settings() {
    static const std::vector<KnownSetting> kKnown = {
        OVERLOOK_NUMBER(Whose::all, "error-px", 0.01, 10000, select.error_px),
        {Whose::all, SettingKind{"by", 0, kCriteria.size() - 1, 0, true, true, false, kCriteria},
         [](FrameOptions& o, double v) { o.select.criterion = Criterion(uint32_t(v)); },
         [](const FrameOptions& o) { return double(o.select.criterion); }},
        OVERLOOK_NUMBER(Whose::all, "size-px", 1, 100000, select.size_px),
        OVERLOOK_NUMBER(Whose::all, "distance-m", 0.001, 1e9, select.distance_m),
        OVERLOOK_NUMBER(Whose::all, "periphery", 0, 100, select.periphery),
        OVERLOOK_NUMBER(Whose::all, "area-weight", 0, 1000, select.area_weight),
        OVERLOOK_NUMBER(Whose::all, "refine-share", 0.1, 1, select.refine_share),
        OVERLOOK_NUMBER(Whose::all, "coarsen-share", 0.1, 0.99, select.coarsen_share),
        OVERLOOK_NUMBER(Whose::fading, "fade-s", 0.001, 60, fade_s),
        OVERLOOK_FLAG(Whose::fading, "foresee", foresees),
        OVERLOOK_FLAG(Whose::fading, "one-by-one", is_one_by_one),
        OVERLOOK_FLAG(Whose::turns, "reproject", reprojects),
        OVERLOOK_FLAG(Whose::paper, "half-precision", is_half_precise),
        OVERLOOK_FLAG(Whose::fsi, "keep-hidden", remedies.keeps_hidden),
        OVERLOOK_FLAG(Whose::fsi, "wide-ids", remedies.has_wide_ids),
        OVERLOOK_FLAG(Whose::fsi, "wide-depth", remedies.has_wide_depth),
        OVERLOOK_FLAG(Whose::fsi, "weigh-by-phase", remedies.weighs_by_phase),
        OVERLOOK_FLAG(Whose::fsi, "long-ramps", remedies.has_long_ramps),
        OVERLOOK_FLAG(Whose::fsi, "ease-ends", remedies.eases_ends),
        OVERLOOK_FLAG(Whose::fsi, "split-parities", remedies.splits_parities),
        OVERLOOK_FLAG(Whose::fsi, "split-things", remedies.splits_things),
        OVERLOOK_FLAG(Whose::fsi, "move-instances", remedies.moves_instances),
        OVERLOOK_FLAG(Whose::fsi, "search", remedies.searches),
        OVERLOOK_FLAG(Whose::fsi, "suit-grain", remedies.suits_grain),
        OVERLOOK_FLAG(Whose::fsi, "copy-rest", remedies.copies_rest),
        OVERLOOK_FLAG(Whose::fsi, "sieve", remedies.sieves),
        OVERLOOK_FLAG(Whose::fsi, "know-cuts", remedies.knows_cuts),
        OVERLOOK_NUMBER(Whose::fsi, "softness", 0, 4, remedies.softness),
    };
    return kKnown;
}

#undef OVERLOOK_NUMBER
#undef OVERLOOK_FLAG

std::vector<SettingKind> kinds_of(Variant variant) {
    std::vector<SettingKind> kinds;
    FrameOptions defaults = defaults_of(variant);
    for (const KnownSetting& known : known_settings()) {
        if (!has(variant, known.whose)) continue;
        kinds.push_back(known.kind);
        kinds.back().otherwise = known.get(defaults);
    }
    return kinds;
}

}  // namespace

FrameOptions defaults_of(Variant variant) {
    FrameOptions options;
    options.variant = variant;
    if (variant == Variant::late) options.select.error_px = kImperceptible_px;
    if (variant == Variant::fsi_paper) options.is_one_by_one = true;
    return options;
}

std::span<const SettingKind> setting_kinds(Variant variant) {
    static const std::array<std::vector<SettingKind>, 6> kKinds = {kinds_of(Variant::fsi),    kinds_of(Variant::fsi_paper),
                                                                   kinds_of(Variant::hard),   kinds_of(Variant::blend),
                                                                   kinds_of(Variant::dither), kinds_of(Variant::late)};
    return kKinds[size_t(variant)];
}

void set(FrameOptions& options, std::string_view name, double value) {
    const std::vector<KnownSetting>& known = known_settings();
    auto found = std::find_if(known.begin(), known.end(), [&](const KnownSetting& one) { return one.kind.name == name; });
    assert(found != known.end() && has(options.variant, found->whose) && value >= found->kind.least && value <= found->kind.most);
    found->set(options, value);
}

}  // namespace overlook::discrete
