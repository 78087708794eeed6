#include "runtime/caveclod/settings.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace overlook::caveclod {
namespace {

struct KnownSetting {
    SettingKind kind;
    void (*set)(FrameOptions& options, double value);
    bool is_own = true;  // of the default variant alone
};

std::vector<KnownSetting> make_settings() {
    const Settings is;
    auto number = [](std::string_view name, double least, double most, double otherwise, bool is_seldom) {
        return SettingKind{name, least, most, otherwise, false, is_seldom};
    };
    auto whole = [](std::string_view name, double least, double most, double otherwise) {
        return SettingKind{name, least, most, otherwise, true, true};
    };
    return {
        {number("error-px", 0.01, 10000, is.error_px, false), [](FrameOptions& o, double v) { o.settings.error_px = v; }, false},
        {number("silhouette-px", 0, 10000, is.silhouette_error_px, true),
         [](FrameOptions& o, double v) { o.settings.silhouette_error_px = v; }},
        {number("collapse-share", 0, kGlideEnter, is.collapse_share, true),
         [](FrameOptions& o, double v) { o.settings.collapse_share = v; }},
        {number("guard-deg", 0, 60, is.guard_deg, true), [](FrameOptions& o, double v) { o.settings.guard_deg = v; }},
        {SettingKind{"cull-back-faces", 0, 1, double(is.culls_back_faces), true, true, true},
         [](FrameOptions& o, double v) { o.settings.culls_back_faces = v != 0; }},
        {whole("operations", 0, 1e9, is.most_operations), [](FrameOptions& o, double v) { o.settings.most_operations = uint32_t(v); }},
        {whole("triangles", 0, 1e9, double(is.most_triangles)),
         [](FrameOptions& o, double v) { o.settings.most_triangles = uint64_t(v); }},
        {number("glide-s", 0, 10, is.glide_s, true), [](FrameOptions& o, double v) { o.settings.glide_s = v; }},
        {whole("cameras", 1, 4, 1), [](FrameOptions& o, double v) { o.cameras = uint32_t(v); }, false},
    };
}

const std::vector<KnownSetting>& known_settings() {
    static const std::vector<KnownSetting> kKnown = make_settings();
    return kKnown;
}

std::vector<SettingKind> kinds(bool is_own) {
    std::vector<SettingKind> kinds;
    for (const KnownSetting& known : known_settings()) {
        if (is_own || !known.is_own) kinds.push_back(known.kind);
    }
    return kinds;
}

}  // namespace

std::span<const SettingKind> setting_kinds(Variant variant) {
    static const std::vector<SettingKind> kOwn = kinds(true), kOthers = kinds(false);
    return variant == Variant::own ? kOwn : kOthers;
}

void set(FrameOptions& options, std::string_view name, double value) {
    const std::vector<KnownSetting>& known = known_settings();
    auto found = std::find_if(known.begin(), known.end(), [&](const KnownSetting& one) { return one.kind.name == name; });
    assert(found != known.end() && value >= found->kind.least && value <= found->kind.most);
    found->set(options, value);
}

}  // namespace overlook::caveclod
