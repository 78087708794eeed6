#include "tools/bake/wang_ldi/shade.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/gloss.h"
#include "tools/bake/wang_ldi/shade_rays.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kPatternStream = 21;

// As many from each direction as its cosine, about the frame's third axis.
glm::vec3 cosine_direction(const glm::mat3& frame, const glm::vec2& at) {
    float radius = std::sqrt(at.x), angle = 6.28318531f * at.y;
    return frame * glm::vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0f, 1 - at.x)));
}

// What sky and ground send to a side of a surface, over what they would if nothing were in the way.
glm::vec3 around(const rays::Scene& scene, const glm::vec3& at, const glm::vec3& side, const glm::vec3& face, uint32_t count,
                 const Light& light, const glm::vec2& shift) {
    ShadowRays rays;
    glm::mat3 frame = frame_of(side);
    std::vector<uint8_t> is_sky;
    glm::vec3 sum(0);
    for (uint32_t i = 0; i < count; ++i) {
        glm::vec3 along = cosine_direction(frame, place_of(i, count, shift));
        if (glm::dot(along, face) <= 0) continue;  // the smooth normal leans over the face's own horizon
        rays.add(at, along), is_sky.push_back(along.z > 0);
    }
    rays.shoot(scene);
    for (size_t i = 0; i < is_sky.size(); ++i)
        if (!rays.blocked[i]) sum += is_sky[i] ? light.sky : light.ground;
    return sum / float(count);
}

// Share of the sun that is seen from one side.
float sun_share(const rays::Scene& scene, const glm::vec3& at, const glm::vec3& face, const Light& light,
                const glm::vec2& shift) {
    ShadowRays rays;
    glm::mat3 frame = frame_of(glm::normalize(light.to_sun));
    auto tangent = float(std::tan(light.sun_radius_deg * 0.017453292519943295));
    for (uint32_t i = 0; i < light.sun_rays; ++i) {
        glm::vec2 place = place_of(i, light.sun_rays, shift);
        float radius = tangent * std::sqrt(place.x), angle = 6.28318531f * place.y;
        glm::vec3 along = frame * glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 1);
        if (glm::dot(along, face) > 0) rays.add(at, along);
    }
    rays.shoot(scene);
    auto seen = std::count(rays.blocked.begin(), rays.blocked.end(), uint8_t(0));
    return float(seen) / float(light.sun_rays);
}

}  // namespace

glm::vec3 lit(const rays::Scene& scene, const Point& point, const Light& light, uint64_t seed) {
    Random random(seed);
    glm::vec2 shift(float(random.next_unit()), float(random.next_unit()));
    glm::vec3 to_sun = glm::normalize(light.to_sun), front = point.at_m + kLift * point.face,
              back = point.at_m - kLift * point.face;
    float facing = glm::dot(point.normal, to_sun), share = point.transmission;
    float sun_seen = facing > 0 ? sun_share(scene, front, point.face, light, shift) : 0;
    glm::vec3 seen = around(scene, front, point.normal, point.face, light.sky_rays, light, shift);
    if (facing > 0) seen += light.sun * (facing * sun_seen);
    if (share > 0) {
        glm::vec3 behind = around(scene, back, -point.normal, -point.face, light.sky_rays, light, shift);
        if (facing < 0) behind += light.sun * (-facing * sun_share(scene, back, -point.face, light, shift));
        seen += share * behind;
    }
    if (!light.has_gloss || !is_glossy(point)) return point.albedo * seen;
    glm::vec3 even = point.albedo * (1 - point.metallic) * (glm::vec3(1) - mirrored_share(point)) * seen;
    return even + mirrored(scene, point, light, sun_seen, shift);
}

std::vector<glm::vec3> lit_samples(const Models& models, std::span<const TraceStage> stages, std::span<const Sample> samples,
                                   const glm::vec3& eye_m, const Light& light, uint64_t seed) {
    std::vector<glm::vec3> colours;
    colours.reserve(samples.size());
    for (const Sample& sample : samples) {
        const TraceStage& stage = stages[sample.stage];
        Point point = point_of(models, stage.copies, sample.hit, sample.seen_along);
        point.albedo = sample.albedo, point.to_eye = glm::normalize(eye_m - point.at_m);
        uint64_t own = hash_of(seed, kPatternStream, sample.pixel, sample.layer);
        colours.push_back(lit(stage.scene, point, light, own));
    }
    return colours;
}

}  // namespace overlook::wang_ldi
