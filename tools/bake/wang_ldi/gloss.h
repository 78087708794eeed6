// What a glossy surface mirrors towards an eye: the sun, and sky and ground as far as nothing is in the way.
//
// Based on: B. Walter, S. Marschner, H. Li, K. Torrance, Microfacet Models for Refraction through Rough Surfaces, 2007 (GGX);
// E. Heitz, Sampling the GGX Distribution of Visible Normals, 2018; C. Schlick, An Inexpensive BRDF Model for Physically-based
// Rendering, 1994; glTF 2.0, appendix B (metallic-roughness).
#pragma once

#include "tools/bake/wang_ldi/shade.h"

namespace overlook::wang_ldi {

// Whether anything is mirrored: surfaces of roughness 1 without metal send light back evenly, and nothing besides.
inline bool is_glossy(const Point& point) {
    return point.roughness < 1 || point.metallic > 0;
}

// What of light that falls straight from the eye is mirrored, by channel.
glm::vec3 mirrored_share(const Point& point);

// Towards point.to_eye, linear. sun_share: how much of the sun is seen from there. Rays for sky and ground: light.sky_rays; shift
// turns their pattern; they go through `rays`. Lobes are at least as wide as the sun.
glm::vec3 mirrored(const rays::Scene& scene, const Point& point, const Light& light, float sun_share, const glm::vec2& shift,
                   ShadowRays& rays);

}  // namespace overlook::wang_ldi
