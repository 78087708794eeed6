#include "tools/measure/paper/lod_sprite/plan.h"

#include <algorithm>
#include <cassert>

#include "formats/json.h"
#include "formats/mapped_file.h"
#include "tools/measure/methods.h"

namespace overlook::measure::paper::sprite {
namespace {

using json::Form;
using json::Kind;
using json::Member;
using json::Node;

constexpr Member kPlanMembers[] = {
    {"version", Kind::number, true, 1, 1e6},
    {"high_px", Kind::number, true, 0.01, 1000},
    {"low_px", Kind::number, true, 0.01, 1000},
    {"views", Kind::array, true, 1, 8},
};
constexpr Member kViewMembers[] = {
    {"figure", Kind::number, true, 1, 99},
    {"time_s", Kind::number, true, 0, 1e6},
    {"high_triangles", Kind::number, true, 1, 1e9},
    {"low_triangles", Kind::number, true, 1, 1e9},
};

PlanView read_view(Form& form, const Node& node) {
    form.expect(node, kViewMembers);
    if (!form.is_right()) return {};
    return {int(form.number(node, "figure", 0)), form.number(node, "time_s", 0), form.number(node, "high_triangles", 0),
            form.number(node, "low_triangles", 0)};
}

bool has_setting(const MethodSpec& spec, std::string_view name) {
    return std::any_of(spec.settings.begin(), spec.settings.end(), [&](const auto& one) { return one.first == name; });
}

// What a method calls the error at which it makes a new keyframe.
std::string_view threshold_name(const MethodSpec& spec) {
    for (std::string_view name : {"key-error-px", "key-error"}) {
        if (has_setting(spec, name)) return name;
    }
    return "error-px";
}

Result<MethodSpec> sprite_from(const Plan& plan, const std::string& text) {
    Result<MethodSpec> spec = parse_method(text);
    if (!spec) return spec;
    auto set = [&](std::string_view name, double value) {
        if (text.find("@" + std::string(name) + "=") != std::string::npos) return;
        for (auto& [known, held] : spec->settings) {
            if (known == name) held = value;
        }
    };
    set("error-px", plan.high_px);
    set("low-error-px", plan.low_px);
    set("samples", 1);
    set(threshold_name(*spec), kThreshold_px);
    return spec;
}

}  // namespace

Result<Plan> parse_plan(std::string_view text, const std::string& name) {
    Result<json::Value> root = json::parse(text, name);
    if (!root) return tl::unexpected(root.error());
    Form form(*root, name);
    json::check_version(form, kPlanVersion);
    form.expect(form.root(), kPlanMembers);

    Plan plan;
    plan.high_px = form.number(form.root(), "high_px", 0);
    plan.low_px = form.number(form.root(), "low_px", 0);
    for (const Node& view : form.items(form.member(form.root(), "views"))) plan.views.push_back(read_view(form, view));
    if (form.is_right() && !(plan.low_px > plan.high_px))
        form.fail(form.member(form.root(), "low_px"), fmt::format("{} is not above high_px, {}", plan.low_px, plan.high_px));
    return form.finish(std::move(plan));
}

Result<Plan> read_plan(const std::string& path) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    std::span<const std::byte> bytes = file->bytes();
    return parse_plan({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

Result<Cast> cast_from(const Plan& plan, const std::vector<std::string>& methods) {
    auto cut = [](double error_px) { return *parse_method(fmt::format("terrain:hard@error-px={}@samples=1", error_px)); };
    Cast cast{cut(plan.high_px), cut(plan.low_px), {}};
    for (const std::string& text : methods) {
        Result<MethodSpec> sprite = sprite_from(plan, text);
        if (!sprite) return tl::unexpected(sprite.error());
        cast.sprites.push_back(std::move(*sprite));
    }
    return cast;
}

MethodSpec at_threshold(const MethodSpec& spec, double threshold_px) {
    MethodSpec other = spec;
    for (auto& [name, value] : other.settings) {
        if (name == threshold_name(spec)) value = threshold_px;
    }
    return other;
}

}  // namespace overlook::measure::paper::sprite
