#include "runtime/wang_ldi/draw_plants.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/discrete/draw_shaders.h"
#include "runtime/gl/masked_levels.h"
#include "runtime/terrain/draw_shaders.h"
#include "runtime/wang_ldi/baked_light.h"
#include "runtime/wang_ldi/canopy.h"

namespace overlook::wang_ldi {
namespace {

// Behind a screen door on those samples of each pixel that the door opens, their shares in steps of a sample and the rest by
// pixels (after J. Mulder, F. Groen, J. van Wijk, Pixel Masks for Screen-Door Transparency, 1998); else on all. After discrete's
// kDoor.
constexpr char kFading[] = "#define IS_FADING 1\n", kNotFading[] = "#define IS_FADING 0\n";
constexpr char kLeave[] = R"(
void leave_by_door(Item item) {
#if IS_FADING
    const uint order[4] = uint[](0u, 2u, 3u, 1u);  // those across from each other one after the other
    bool is_out = item.show == 3u;
    float from = is_out ? item.share : 0.0, to = is_out ? item.shift.x : item.share;
    int count = max(gl_NumSamples, 1), mask = 0;
    for (int i = 0; i < count; ++i) {
        uint place = count == 4 ? order[i] : uint(i);
        float at = (float(place) + door()) / float(count);
        if (at >= from && at < to) mask |= 1 << i;
    }
    if (mask == 0) discard;
    gl_SampleMask[0] = mask;
#endif
}
)";

// As discrete's own of one picture, without its light.
constexpr char kUnlitMain[] = R"(
void main() {
    leave_by_door(own_item());
    colour = vec4(encoded(behind_air(unlit_colour(own_item().is_plain), surface.relative_m)), 1.0);
}
)";

// As samples are lit when they are baked (tools/bake/wang_ldi/shade.h), but for shadows, which are what they are on average at a
// height.
constexpr char kSunlitMain[] = R"(
uniform vec3 to_sun, sun, sky, ground;
uniform float transmission, foot_m, canopy_top_m;
uniform vec2 open[32];

vec3 around(vec3 normal, float sky_share) {
    return (sky * (0.5 + 0.5 * normal.z) + ground * (0.5 - 0.5 * normal.z)) * sky_share;
}

void main() {
    Item item = own_item();
    leave_by_door(item);
    vec3 own = unlit_colour(item.is_plain);
    vec3 face = normalize(cross(dFdx(surface.relative_m), dFdy(surface.relative_m)));
    if (dot(face, surface.relative_m) > 0.0) face = -face;
    vec3 normal = has_normals && !item.is_plain ? normalize(surface.normal) : face;
    if (dot(normal, face) < 0.0) normal = is_card ? reflect(normal, face) : -normal;
    float place = clamp(item.scale * (surface.rest_m.z + foot_m) / canopy_top_m, 0.0, 1.0) * 31.0;
    vec2 shares = mix(open[int(place)], open[min(int(place) + 1, 31)], fract(place));
    float facing = dot(normal, to_sun);
    vec3 light = around(normal, shares.y) + sun * (max(0.0, facing) * shares.x);
    if (is_two_sided) light += transmission * (around(-normal, shares.y) + sun * (max(0.0, -facing) * shares.x));
    colour = vec4(encoded(behind_air(own * light, surface.relative_m)), 1.0);
}
)";

void set_light(const gl::Program& program, const discrete::Chain& chain, const PlantLight& of) {
    const BakedLight& light = of.light;
    const Canopy& canopy = of.canopy;
    program.use();
    glUniform3fv(program.at("to_sun"), 1, glm::value_ptr(of.to_sun));
    glUniform3fv(program.at("sun"), 1, glm::value_ptr(light.sun));
    glUniform3fv(program.at("sky"), 1, glm::value_ptr(light.sky));
    glUniform3fv(program.at("ground"), 1, glm::value_ptr(light.ground));
    glUniform1f(program.at("transmission"), light.transmission);
    glUniform1f(program.at("foot_m"), float(chain.origin_m.z));
    glUniform1f(program.at("canopy_top_m"), float(std::max(canopy.top_m, 1e-6)));
    glUniform2fv(program.at("open"), GLsizei(kCanopySteps), glm::value_ptr(canopy.open[0]));
}

// A surface's picture as OpenGL has it; its colour alone where it cannot be read.
Skin skin_of(const caveclod::Surface& surface) {
    if (surface.texture_bytes.empty()) return plain_skin(surface);
    Result<ImageRgba8> picture = decode_png(surface.texture, surface.texture_bytes);
    if (!picture) return plain_skin(surface);
    Skin skin;
    if (!surface.is_alpha_masked) {
        skin.add_level(picture->width, picture->height, picture->pixels, surface);
        skin.add_halves();
        return skin;
    }
    auto add = [&](const ImageRgba8& level) {
        if (size_t(level.width) * level.height <= Skin::kMostTexels)
            skin.add_level(level.width, level.height, level.pixels, surface);
    };
    add(*picture);
    for (const ImageRgba8& smaller : gl::masked_levels(*picture, surface.alpha_cutoff)) add(smaller);
    return skin;
}

}  // namespace

std::string plant_look_text() {
    BakedLight light;
    std::string text = std::string(discrete::shaders::kItemInputs) + discrete::shaders::kVertex + discrete::shaders::kItem +
                       discrete::shaders::kFragment + discrete::shaders::kDoor + terrain::shaders::kAir + kLeave + kUnlitMain +
                       kSunlitMain;
    for (const glm::vec3& one : {light.sun, light.sky, light.ground}) text += fmt::format("{} {} {} ", one.x, one.y, one.z);
    return text + fmt::format("{} {}", light.transmission, kCanopyForm);
}

Result<Plants> Plants::make(std::span<const discrete::Chain> chains, const Planting& planting, const glm::dvec3& to_sun) {
    Plants made;
    bool is_lit = to_sun != glm::dvec3(0);
    made.light_.is_lit = is_lit, made.light_.to_sun = glm::vec3(to_sun);
    if (is_lit) made.light_.canopy = canopy_of(planting, chains, to_sun);
    for (const discrete::Chain& chain : chains) {
        Result<discrete::Drawing> drawing = discrete::Drawing::make(chain);
        if (!drawing) return tl::unexpected(drawing.error());
        auto model = std::make_unique<Model>();
        made.forms_.push_back(form_of(chain));
        model->drawing = std::move(*drawing);
        for (const char* define : {kNotFading, kFading}) {
            std::string main =
                std::string(discrete::shaders::kDoor) + terrain::shaders::kAir + kLeave + (is_lit ? kSunlitMain : kUnlitMain);
            Result<gl::Program> program = model->drawing.program("plants", define, main);
            if (!program) return tl::unexpected(program.error());
            if (is_lit) set_light(*program, chain, made.light_);
            model->programs.push_back(std::move(*program));
        }
        made.models_.push_back(std::move(model));
    }
    return made;
}

PlantCounts counts_of(std::span<const PlantList> lists) {
    PlantCounts counts;
    for (const PlantList& list : lists) {
        counts.error_px = std::max(counts.error_px, list.listed.error_px);
        counts.plant_count += list.listed.frame.in_view_count, counts.triangle_count += list.listed.frame.triangle_count;
    }
    return counts;
}

void Plants::draw_list(const PlantList& list, const view::Camera& camera, double haze_per_m, const discrete::DrawOptions& options,
                       PlantCounts& counts) {
    Model& model = *models_[list.model];
    discrete::DrawList drawn =
        discrete::draw_list(model.drawing.layout(), model.drawing.chain(), list.listed.frame, list.places->placements, camera, 0);
    counts.uploaded_bytes += model.buffers.fill(drawn);
    const gl::Program& program = model.programs[list.is_fading];
    program.use();
    glUniform1f(program.at("haze_per_m"), float(haze_per_m));
    model.drawing.draw_calls(program, model.buffers, drawn, drawn.whole_calls, options);
    counts.draw_call_count += drawn.whole_calls.size();
}

PlantCounts Plants::draw(const gl::Target& target, const view::Camera& camera, std::span<const PlantList> lists,
                         double haze_per_m, const std::optional<view::Part>& part) {
    PlantCounts counts = counts_of(lists);
    target.bind();
    discrete::DrawOptions options;
    options.part = part;
    for (const PlantList& list : lists) draw_list(list, camera, haze_per_m, options, counts);
    return counts;
}

std::span<const PlantShape> Plants::shapes() {
    bool can_be =
        std::all_of(models_.begin(), models_.end(), [](const auto& model) { return can_be_shaped(model->drawing.chain()); });
    if (!can_be || !shapes_.empty()) return shapes_;
    for (const auto& model : models_) {
        const discrete::Chain& chain = model->drawing.chain();
        std::vector<Skin> skins;
        for (const caveclod::Surface& surface : chain.surfaces) skins.push_back(skin_of(surface));
        shapes_.push_back(shape_of(chain, std::move(skins)));
    }
    return shapes_;
}

uint64_t Plants::bytes() const {
    uint64_t bytes = 0;
    for (const auto& model : models_) bytes += model->drawing.bytes();
    return bytes;
}

}  // namespace overlook::wang_ldi
