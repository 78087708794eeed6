#include "runtime/wang_ldi/draw_plants.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/discrete/draw_shaders.h"
#include "runtime/wang_ldi/baked_light.h"
#include "runtime/wang_ldi/canopy.h"

namespace overlook::wang_ldi {
namespace {

// Of plants that give way to images, on the pixels that a screen door opens first; else on all. After discrete's kDoor.
constexpr char kFading[] = "#define IS_FADING 1\n", kNotFading[] = "#define IS_FADING 0\n";
constexpr char kLeave[] = R"(
void leave_by_door(Item item) {
#if IS_FADING
    if (door() >= item.share) discard;
#endif
}
)";

// As discrete's own of one picture, without its light.
constexpr char kUnlitMain[] = R"(
void main() {
    leave_by_door(own_item());
    colour = vec4(encoded(unlit_colour(own_item().is_plain)), 1.0);
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
    colour = vec4(encoded(own * light), 1.0);
}
)";

void set_light(const gl::Program& program, const discrete::Chain& chain, const Canopy& canopy, const glm::dvec3& to_sun) {
    BakedLight light;
    glm::vec3 towards(to_sun);
    program.use();
    glUniform3fv(program.at("to_sun"), 1, glm::value_ptr(towards));
    glUniform3fv(program.at("sun"), 1, glm::value_ptr(light.sun));
    glUniform3fv(program.at("sky"), 1, glm::value_ptr(light.sky));
    glUniform3fv(program.at("ground"), 1, glm::value_ptr(light.ground));
    glUniform1f(program.at("transmission"), light.transmission);
    glUniform1f(program.at("foot_m"), float(chain.origin_m.z));
    glUniform1f(program.at("canopy_top_m"), float(std::max(canopy.top_m, 1e-6)));
    glUniform2fv(program.at("open"), GLsizei(kCanopySteps), glm::value_ptr(canopy.open[0]));
}

}  // namespace

std::string plant_look_text() {
    BakedLight light;
    std::string text = std::string(discrete::shaders::kItemInputs) + discrete::shaders::kVertex + discrete::shaders::kItem +
                       discrete::shaders::kFragment + discrete::shaders::kDoor + kLeave + kUnlitMain + kSunlitMain;
    for (const glm::vec3& one : {light.sun, light.sky, light.ground}) text += fmt::format("{} {} {} ", one.x, one.y, one.z);
    return text + fmt::format("{} {}", light.transmission, kCanopyForm);
}

Result<Plants> Plants::make(std::span<const discrete::Chain> chains, const Planting& planting, const glm::dvec3& to_sun) {
    Plants made;
    bool is_lit = to_sun != glm::dvec3(0);
    Canopy canopy;
    if (is_lit) canopy = canopy_of(planting, chains, to_sun);
    for (const discrete::Chain& chain : chains) {
        Result<discrete::Drawing> drawing = discrete::Drawing::make(chain);
        if (!drawing) return tl::unexpected(drawing.error());
        auto model = std::make_unique<Model>();
        model->form = form_of(chain);
        model->drawing = std::move(*drawing);
        for (const char* define : {kNotFading, kFading}) {
            std::string main = std::string(discrete::shaders::kDoor) + kLeave + (is_lit ? kSunlitMain : kUnlitMain);
            Result<gl::Program> program = model->drawing.program("plants", define, main);
            if (!program) return tl::unexpected(program.error());
            if (is_lit) set_light(*program, chain, canopy, to_sun);
            model->programs.push_back(std::move(*program));
        }
        made.models_.push_back(std::move(model));
    }
    return made;
}

void Plants::draw_model(Model& model, bool is_fading, const PlantPlaces& places, const view::Camera& camera, double error_px,
                        const std::optional<view::Part>& part, PlantCounts& counts) const {
    ListedPlants listed = plants_listed(model.form, places, camera, error_px);
    const discrete::FrameList& frame = listed.frame;
    counts.error_px = std::max(counts.error_px, listed.error_px);
    counts.plant_count += frame.in_view_count, counts.triangle_count += frame.triangle_count;
    if (frame.items.empty()) return;
    discrete::DrawOptions options;
    options.part = part;
    discrete::DrawList list =
        discrete::draw_list(model.drawing.layout(), model.drawing.chain(), frame, places.placements, camera, 0);
    counts.uploaded_bytes += model.buffers.fill(list);
    model.drawing.draw_calls(model.programs[is_fading], model.buffers, list, list.whole_calls, options);
    counts.draw_call_count += list.whole_calls.size();
}

PlantCounts Plants::draw(const gl::Target& target, const view::Camera& camera, std::span<const PlantPlaces> by_model,
                         double error_px, const std::optional<view::Part>& part) {
    PlantCounts counts;
    target.bind();
    for (size_t m = 0; m < models_.size(); ++m) {
        PlantPlaces whole, fading;
        for (size_t p = 0; p < by_model[m].placements.size(); ++p) {
            PlantPlaces& of = by_model[m].shares[p] < 1 ? fading : whole;
            of.placements.push_back(by_model[m].placements[p]), of.shares.push_back(by_model[m].shares[p]);
        }
        draw_model(*models_[m], false, whole, camera, error_px, part, counts);
        draw_model(*models_[m], true, fading, camera, error_px, part, counts);
    }
    return counts;
}

uint64_t Plants::bytes() const {
    uint64_t bytes = 0;
    for (const auto& model : models_) bytes += model->drawing.bytes();
    return bytes;
}

}  // namespace overlook::wang_ldi
