#include "tools/bake/wang_ldi/gloss.h"

#include <algorithm>
#include <cmath>

#include "formats/steady_math.h"
#include "tools/bake/wang_ldi/shade_rays.h"

namespace overlook::wang_ldi {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kLeastAlpha = 0.04f;   // a lobe about as wide as the sun
constexpr float kLeastCosine = 0.05f;  // to the eye: smooth normals may lean away from it
constexpr float kDielectric = 0.04f;   // mirrored of light from straight ahead by what is no metal

float alpha_of(const Point& point) {
    return std::max(point.roughness * point.roughness, kLeastAlpha);
}

glm::vec3 fresnel(const Point& point, float cosine) {
    float off = std::clamp(1 - cosine, 0.0f, 1.0f), off2 = off * off;
    glm::vec3 straight = glm::mix(glm::vec3(kDielectric), point.albedo, point.metallic);
    return straight + (glm::vec3(1) - straight) * off2 * off2 * off;
}

// How many of the facets that face a direction are not hidden from it.
float unhidden(float cosine, float alpha) {
    float a2 = alpha * alpha, c2 = cosine * cosine;
    return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * c2));
}

float facets(float cosine, float alpha) {
    float a2 = alpha * alpha, d = cosine * cosine * (a2 - 1) + 1;
    return a2 / (kPi * d * d);
}

// A facet that the eye sees, in the frame of the surface, as many as are seen.
glm::vec3 seen_facet(const glm::vec3& to_eye, float alpha, const glm::vec2& at) {
    glm::vec3 stretched = glm::normalize(glm::vec3(alpha * to_eye.x, alpha * to_eye.y, to_eye.z));
    float length2 = stretched.x * stretched.x + stretched.y * stretched.y;
    glm::vec3 across = length2 > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / std::sqrt(length2) : glm::vec3(1, 0, 0),
              along = glm::cross(stretched, across);
    steady::SinCos round = steady::sin_cos(2 * M_PI * double(at.y));
    float radius = std::sqrt(at.x), s = 0.5f * (1 + stretched.z);
    float x = radius * float(round.cos), y = (1 - s) * std::sqrt(std::max(0.0f, 1 - x * x)) + s * radius * float(round.sin);
    glm::vec3 facet = x * across + y * along + std::sqrt(std::max(0.0f, 1 - x * x - y * y)) * stretched;
    return glm::normalize(glm::vec3(alpha * facet.x, alpha * facet.y, std::max(1e-6f, facet.z)));
}

// The eye in the surface's frame, never behind it.
glm::vec3 local_eye(const glm::mat3& frame, const Point& point) {
    glm::vec3 to_eye = glm::transpose(frame) * point.to_eye;
    to_eye.z = std::max(to_eye.z, kLeastCosine);
    return glm::normalize(to_eye);
}

glm::vec3 sun_of(const Point& point, const Light& light, const glm::mat3& frame, const glm::vec3& to_eye) {
    glm::vec3 to_sun = glm::transpose(frame) * glm::normalize(light.to_sun);
    if (to_sun.z <= 0) return glm::vec3(0);
    glm::vec3 half = glm::normalize(to_sun + to_eye);
    float alpha = alpha_of(point), seen = unhidden(to_eye.z, alpha) * unhidden(to_sun.z, alpha);
    // light.sun is what white sends back: a pi-th of what falls on it.
    return light.sun * fresnel(point, glm::dot(to_eye, half)) * (kPi * facets(half.z, alpha) * seen / (4 * to_eye.z));
}

}  // namespace

glm::vec3 mirrored_share(const Point& point) {
    return fresnel(point, std::max(glm::dot(point.normal, point.to_eye), kLeastCosine));
}

glm::vec3 mirrored(const rays::Scene& scene, const Point& point, const Light& light, float sun_share, const glm::vec2& shift,
                   ShadowRays& rays) {
    glm::mat3 frame = frame_of(point.normal);
    glm::vec3 to_eye = local_eye(frame, point), from = point.at_m + kLift * point.face;
    float alpha = alpha_of(point);
    rays.begin();
    std::vector<glm::vec3> shares;
    for (uint32_t i = 0; i < light.sky_rays; ++i) {
        glm::vec3 facet = seen_facet(to_eye, alpha, place_of(i, light.sky_rays, shift));
        glm::vec3 away = 2 * glm::dot(to_eye, facet) * facet - to_eye, along = frame * away;
        if (away.z <= 0 || glm::dot(along, point.face) <= 0) continue;
        rays.add(from, along);
        shares.push_back(fresnel(point, glm::dot(to_eye, facet)) * unhidden(away.z, alpha) *
                         (along.z > 0 ? light.sky : light.ground));
    }
    rays.shoot(scene);
    glm::vec3 sum(0);
    for (size_t i = 0; i < shares.size(); ++i)
        if (!rays.blocked[i]) sum += shares[i];
    return sum / float(light.sky_rays) + sun_share * sun_of(point, light, frame, to_eye);
}

}  // namespace overlook::wang_ldi
