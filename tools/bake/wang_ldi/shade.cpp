#include "tools/bake/wang_ldi/shade.h"

#include <algorithm>
#include <cmath>

#include "formats/steady_math.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/gloss.h"
#include "tools/bake/wang_ldi/shade_rays.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kPatternStream = 21;

// As many from each direction as its cosine, about the frame's third axis.
glm::vec3 cosine_direction(const glm::mat3& frame, const glm::vec2& at) {
    steady::SinCos round = steady::sin_cos(2 * M_PI * double(at.y));
    float radius = std::sqrt(at.x);
    return frame * glm::vec3(radius * float(round.cos), radius * float(round.sin), std::sqrt(std::max(0.0f, 1 - at.x)));
}

// What sky and ground send to a side of a surface, over what they would if nothing were in the way.
glm::vec3 around(const rays::Scene& scene, const glm::vec3& at, const glm::vec3& side, const glm::vec3& face, const Light& light,
                 const glm::vec2& shift, ShadowRays& rays) {
    glm::mat3 frame = frame_of(side);
    rays.begin();
    for (uint32_t i = 0; i < light.sky_rays; ++i) {
        glm::vec3 along = cosine_direction(frame, place_of(i, light.sky_rays, shift));
        if (glm::dot(along, face) <= 0) continue;  // the smooth normal leans over the face's own horizon
        rays.add(at, along);
    }
    rays.shoot(scene);
    glm::vec3 sum(0);
    for (size_t i = 0; i < rays.rays.size(); ++i)
        if (!rays.blocked[i]) sum += rays.rays[i].along.z > 0 ? light.sky : light.ground;
    return sum / float(light.sky_rays);
}

// Share of the sun that is seen from one side.
float sun_share(const rays::Scene& scene, const glm::vec3& at, const glm::vec3& face, const Light& light, const glm::vec2& shift,
                ShadowRays& rays) {
    rays.begin();
    glm::mat3 frame = frame_of(glm::normalize(light.to_sun));
    auto tangent = float(steady::tan(light.sun_radius_deg * M_PI / 180));
    for (uint32_t i = 0; i < light.sun_rays; ++i) {
        glm::vec2 place = place_of(i, light.sun_rays, shift);
        steady::SinCos round = steady::sin_cos(2 * M_PI * double(place.y));
        float radius = tangent * std::sqrt(place.x);
        glm::vec3 along = frame * glm::vec3(radius * float(round.cos), radius * float(round.sin), 1);
        if (glm::dot(along, face) > 0) rays.add(at, along);
    }
    rays.shoot(scene);
    auto seen = std::count(rays.blocked.begin(), rays.blocked.end(), uint8_t(0));
    return float(seen) / float(light.sun_rays);
}

}  // namespace

glm::vec3 lit(const rays::Scene& scene, const Point& point, const Light& light, uint64_t seed) {
    ShadowRays rays;
    return lit(scene, point, light, seed, rays);
}

glm::vec3 lit(const rays::Scene& scene, const Point& point, const Light& light, uint64_t seed, ShadowRays& rays) {
    Random random(seed);
    glm::vec2 shift(float(random.next_unit()), float(random.next_unit()));
    glm::vec3 to_sun = glm::normalize(light.to_sun), front = point.at_m + kLift * point.face,
              back = point.at_m - kLift * point.face;
    float facing = glm::dot(point.normal, to_sun), share = point.transmission;
    float sun_seen = facing > 0 ? sun_share(scene, front, point.face, light, shift, rays) : 0;
    glm::vec3 seen = around(scene, front, point.normal, point.face, light, shift, rays);
    if (facing > 0) seen += light.sun * (facing * sun_seen);
    if (share > 0) {
        glm::vec3 behind = around(scene, back, -point.normal, -point.face, light, shift, rays);
        if (facing < 0) behind += light.sun * (-facing * sun_share(scene, back, -point.face, light, shift, rays));
        seen += share * behind;
    }
    if (!light.has_gloss || !is_glossy(point)) return point.albedo * seen;
    glm::vec3 even = point.albedo * (1 - point.metallic) * (glm::vec3(1) - mirrored_share(point)) * seen;
    return even + mirrored(scene, point, light, sun_seen, shift, rays);
}

std::vector<glm::vec3> lit_samples(const Models& models, std::span<const TraceStage> stages, std::span<const Sample> samples,
                                   const glm::vec3& eye_m, const Light& light, uint64_t seed,
                                   std::vector<std::vector<rays::Ray>>* asked) {
    std::vector<glm::vec3> colours;
    colours.reserve(samples.size());
    ShadowRays rays;
    for (const Sample& sample : samples) {
        const TraceStage& stage = stages[sample.stage];
        Point point = point_of(models, stage.copies, sample.hit, sample.seen_along);
        point.albedo = sample.albedo, point.to_eye = glm::normalize(eye_m - point.at_m);
        uint64_t own = hash_of(seed, kPatternStream, sample.pixel, sample.layer);
        if (asked) rays.asked = &(*asked)[sample.stage];
        colours.push_back(lit(stage.scene, point, light, own, rays));
    }
    return colours;
}

}  // namespace overlook::wang_ldi
