// Light on samples, once each: the sun with a soft shadow, the sky as far as it is seen, leaves that let light through, what is
// glossy as one eye sees it.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4 (samples are lit offline, so that
// any light may be simulated); S. Zhukov, A. Iones, G. Kronin, An Ambient Light Illumination Model, 1998 (how much of the sky a
// place sees).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "runtime/wang_ldi/baked_light.h"
#include "tools/bake/wang_ldi/sample.h"

namespace overlook::wang_ldi {

struct Light {
    glm::vec3 to_sun{0.45f, 0.35f, 0.82f};   // any length but 0; z > 0
    double sun_radius_deg = 1.5;             // how far the sun reaches to each side of its middle
    glm::vec3 sun = BakedLight().sun;        // what a white surface that faces it sends back of it, linear
    glm::vec3 sky = BakedLight().sky;        // and of the whole sky
    glm::vec3 ground = BakedLight().ground;  // and of the ground, which lies below the horizon everywhere
    uint32_t sun_rays = 8, sky_rays = 32;    // of each sample: multiples of 1 .. 256
    bool has_gloss = true;                   // else glossy surfaces send back light evenly, as others do
};

// What a place sends to the viewer (point.to_eye), linear. Rays go from `point` into the stage; `seed` turns the pattern of their
// directions.
glm::vec3 lit(const rays::Scene& scene, const Point& point, const Light& light, uint64_t seed);
// The same, of many points: in memory that is taken once.
struct ShadowRays;
glm::vec3 lit(const rays::Scene& scene, const Point& point, const Light& light, uint64_t seed, ShadowRays& rays);

// [samples] linear colours, as an eye at eye_m sees them: what is not glossy looks the same from anywhere. seed: of all patterns;
// each sample's own follows from its pixel and layer. asked: [stages] to be filled with the rays that were shot, or null.
std::vector<glm::vec3> lit_samples(const Models& models, std::span<const TraceStage> stages, std::span<const Sample> samples,
                                   const glm::vec3& eye_m, const Light& light, uint64_t seed,
                                   std::vector<std::vector<rays::Ray>>* asked = nullptr);

}  // namespace overlook::wang_ldi
