// The shaders of draw.cpp: parts of a gl::SurfaceShader.
#pragma once

namespace overlook::lod_sprite::shaders {

// A key keeps the thing's own linear colour; the texture encodes it. What the air does is put on anew in every frame.
inline constexpr char kKeyMain[] = R"(
void main() {
    colour = vec4(own_colour(surface.relative_m), 1.0);
}
)";

// How far above or below a vertex the true surface may lie: what low_error_px pixels are there, along the vertical
// (view::error_px_bound_vertical solved for its error).
inline constexpr char kSlack[] = R"(
uniform vec3 eye_forward;
uniform float focal_px, near_m, low_error_px, near_error_px, near_depth_m, most_slack_m;
float slack_m(vec3 at_m) {
    float depth_m = max(dot(eye_forward, at_m), near_m);
    float error_px = depth_m < near_depth_m ? near_error_px : low_error_px;
    float slack = error_px * depth_m / (focal_px * length(at_m.xy) / depth_m + error_px * abs(eye_forward.z));
    return min(slack, most_slack_m);
}
)";

// The coarse surface is drawn so far up that it covers all of the true one; pixels then search the ray behind it.
inline constexpr char kRaised[] = R"(
uniform float raise;  // 0 or 1
vec3 placed(vec3 relative_m) {
    return vec3(relative_m.xy, relative_m.z + raise * slack_m(relative_m));
}
)";

// KEYS is the count of keys, ITERATIONS how often a place is looked up anew, SHOWS_SOURCES whether colours tell the source.
// Key space: axes of the key's camera, z forward, origin at its eye.
//
// A pixel's ray enters the raised surface somewhere; what it meets behind is looked for in a key by iteration: take a point on
// the ray, look up how deep the key is in its direction, go on with the point of the ray as deep (for the novel camera) as what
// the key shows there. That settles where ray and key's surface meet. The four texels round that place are then asked one by one:
// each is a point of the true surface, and counts only if its own place in this frame is where it would be shown.
inline constexpr char kNovelMain[] = R"(
uniform mat3 key_from_world[KEYS];
uniform vec3 eye_in_key_m[KEYS];
uniform vec2 key_tangents[KEYS];
uniform float key_near_m[KEYS];
uniform float key_weights[KEYS];
layout(binding = 4) uniform sampler2D key_colours[KEYS];
layout(binding = 8) uniform sampler2D key_depths[KEYS];  // near / depth
uniform float raise;
uniform float tolerance_px;  // beside the distance of a texel's middle from the place looked up
uniform bool is_slab_tested, is_place_tested;
layout(depth_less) out float gl_FragDepth;

const int kUnknown = 0, kFound = 1, kEmpty = 2;

struct Found {
    int kind;
    vec3 linear;
    float depth_m;
};

// What key k shows on the ray whose point at depth t is ray_m * t, looked for from low_m on, where the coarse surface is.
Found find(int k, vec3 ray_m, float low_m, float slack_depth_m) {
    vec3 origin = eye_in_key_m[k], along = key_from_world[k] * ray_m, forward = key_from_world[k] * eye_forward;
    float near_in_key_m = key_near_m[k];
    vec2 tangents = key_tangents[k], size = vec2(textureSize(key_depths[k], 0)), edge = 1.0 / size;
    float t = low_m;
    vec2 uv = vec2(0.5);
    bool is_inside = true, is_sky = false, was_free = false;
    for (int i = 0; i < ITERATIONS; ++i) {
        vec3 at = origin + along * t;
        is_inside = at.z > near_in_key_m;
        uv = 0.5 + 0.5 * at.xy / (max(at.z, near_in_key_m) * tangents);
        float inverse = texture(key_depths[k], uv).r;
        is_sky = inverse <= 0.0;
        float depth_m = near_in_key_m / max(inverse, 1e-12);
        if (i == 0) was_free = depth_m > at.z * 1.001;
        vec3 shown = vec3((2.0 * uv - 1.0) * tangents * depth_m, depth_m);
        t = is_sky ? t : dot(forward, shown - origin);
    }
    Found found = Found(kUnknown, vec3(0.0), t);
    is_inside = is_inside && all(greaterThan(uv, edge)) && all(lessThan(uv, 1.0 - edge));
    if (!is_inside) return found;
    if (is_sky) {
        if (was_free) found.kind = kEmpty;
        return found;
    }

    vec2 corner = uv * size - 0.5, base = floor(corner), part = corner - base;
    vec4 inverses = textureGather(key_depths[k], (base + 1.0) / size);  // texels (0, 1), (1, 1), (1, 0), (0, 0) from base
    float sum = 0.0, depth_sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 texel = vec2(i == 1 || i == 2, i < 2);
        vec2 share = mix(1.0 - part, part, texel);
        float depth_m = near_in_key_m / max(inverses[i], 1e-12);
        vec2 tangent = (2.0 * (base + texel + 0.5) / size - 1.0) * tangents;
        float own_t = dot(forward, vec3(tangent * depth_m, depth_m) - origin);
        vec3 off_m = vec3(tangent * depth_m, depth_m) - origin - along * own_t;
        float texel_px = focal_px * 2.0 * length((texel - part) * tangents / size) * depth_m / max(own_t, 1e-6);
        bool is_in_place = own_t > 0.0 && focal_px * length(off_m) <= (tolerance_px + texel_px) * own_t;
        float weight = is_in_place || !is_place_tested ? share.x * share.y : 0.0;
        found.linear += weight * texelFetch(key_colours[k], ivec2(base + texel), 0).rgb;
        depth_sum += weight * own_t;
        sum += weight;
    }
    if (sum < 0.05) return found;
    found.linear /= sum;
    found.depth_m = depth_sum / sum;
    bool is_in_slab = abs(found.depth_m - low_m) <= 1.5 * slack_depth_m + 0.002 * low_m;
    // Beyond what the coarse surface allows only if the key saw the space before it empty.
    if (is_in_slab || (was_free && found.depth_m > low_m) || !is_slab_tested) found.kind = kFound;
    return found;
}

void main() {
    float depth_m = dot(eye_forward, surface.relative_m);
    vec3 ray_m = surface.relative_m / depth_m;
    vec3 normal = cross(dFdx(surface.relative_m), dFdy(surface.relative_m));
    normal *= (normal.z < 0.0 ? -1.0 : 1.0) / max(length(normal), 1e-20);
    // Where the ray meets the coarse surface itself, so far below what was drawn.
    float fall = max(-dot(normal, ray_m), 0.01 * length(ray_m));
    float slack_depth_m = slack_m(surface.relative_m) * normal.z / fall;
    float low_m = depth_m + raise * slack_depth_m;

    vec3 sum = vec3(0.0);
    float weight = 0.0, depth_sum = 0.0;
    bool is_empty = false;
    int source = -1;
    if (low_m >= near_depth_m) {
        for (int k = 0; k < KEYS; ++k) {
            Found found = find(k, ray_m, low_m, slack_depth_m);
            is_empty = is_empty || found.kind == kEmpty;
            if (found.kind != kFound) continue;
            sum += key_weights[k] * found.linear;
            depth_sum += key_weights[k] * found.depth_m;
            weight += key_weights[k];
            source = k;
        }
    }
    if (weight == 0.0 && is_empty && raise > 0.0) discard;
    vec3 linear = weight > 0.0 ? sum / weight : own_colour(ray_m * low_m);
    float shown_m = weight > 0.0 ? depth_sum / weight : low_m;
#ifdef SHOWS_SOURCES
    float light = dot(linear, vec3(0.21, 0.72, 0.07));
    vec3 tint = source < 0 ? (low_m < near_depth_m ? vec3(0.2, 0.5, 1.0) : vec3(1.0, 0.25, 0.15))
                           : (source == 0 ? vec3(0.9) : vec3(0.95, 0.85, 0.3));
    linear = tint * (0.15 + light);
#endif
    gl_FragDepth = raise > 0.0 ? near_m / max(shown_m, depth_m) : gl_FragCoord.z;
    colour = vec4(encoded(behind_air(linear, ray_m * shown_m)), 1.0);
}
)";

}  // namespace overlook::lod_sprite::shaders
