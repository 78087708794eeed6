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
inline constexpr char kNovelMain[] = R"(
uniform mat3 key_from_world[KEYS];
uniform vec3 eye_in_key_m[KEYS];
uniform vec2 key_tangents[KEYS];
uniform float key_near_m[KEYS];
uniform float key_weights[KEYS];
layout(binding = 4) uniform sampler2D key_colours[KEYS];
layout(binding = 8) uniform sampler2D key_depths[KEYS];  // near / depth
uniform float raise;
uniform float tolerance_px;
uniform bool is_slab_tested, is_step_tested;

const int kUnknown = 0, kFound = 1, kEmpty = 2;

struct Found {
    int kind;
    vec3 linear;
    float depth_m;
};

// What key k shows on the ray whose point at depth t is ray_m * t, near depth low_m, where the coarse surface is.
Found find(int k, vec3 ray_m, float low_m, float slack_depth_m, vec3 normal) {
    vec3 origin = eye_in_key_m[k], along = key_from_world[k] * ray_m, forward = key_from_world[k] * eye_forward;
    vec2 size = vec2(textureSize(key_depths[k], 0));
    vec2 edge = 0.5 / size;
    float t = low_m;
    vec2 uv = vec2(0.0);
    vec3 shown = vec3(0.0);
    bool is_inside = true, is_sky = false, was_free = false;
    for (int i = 0; i < ITERATIONS; ++i) {
        vec3 at = origin + along * t;
        is_inside = at.z > key_near_m[k];
        uv = 0.5 + 0.5 * at.xy / (max(at.z, key_near_m[k]) * key_tangents[k]);
        is_inside = is_inside && all(greaterThan(uv, edge)) && all(lessThan(uv, 1.0 - edge));
        float inverse = texture(key_depths[k], uv).r;
        is_sky = inverse <= 0.0;
        float depth_m = key_near_m[k] / max(inverse, 1e-12);
        shown = vec3((2.0 * uv - 1.0) * key_tangents[k] * depth_m, depth_m);
        if (i == 0) was_free = depth_m > at.z * 1.002;
        t = is_sky ? t : dot(forward, shown - origin);
    }
    Found found = Found(kUnknown, vec3(0.0), t);
    if (!is_inside || t <= 0.0) return found;
    float off_px = focal_px * length(shown - origin - along * t) / t;

    // Across a step in depth nothing is mixed: the nearest texel alone, if it is in place.
    vec4 around = textureGather(key_depths[k], uv);
    float least = min(min(around.x, around.y), min(around.z, around.w));
    float most = max(max(around.x, around.y), max(around.z, around.w));
    vec3 normal_in_key = key_from_world[k] * normal;
    vec3 direction = vec3((2.0 * uv - 1.0) * key_tangents[k], 1.0);
    float grade = length(normal_in_key.xy * 2.0 * key_tangents[k] / size) / max(abs(dot(normal_in_key, direction)), 1e-3);
    bool is_step = is_step_tested && most > least * (1.02 + 4.0 * grade);
    found.linear = texture(key_colours[k], uv).rgb;
    if (is_step) {
        ivec2 texel = ivec2(uv * size);
        float inverse = texelFetch(key_depths[k], texel, 0).r;
        is_sky = inverse <= 0.0;
        float depth_m = key_near_m[k] / max(inverse, 1e-12);
        vec2 middle = (vec2(texel) + 0.5) / size;
        shown = vec3((2.0 * middle - 1.0) * key_tangents[k] * depth_m, depth_m);
        t = dot(forward, shown - origin);
        off_px = t > 0.0 ? focal_px * length(shown - origin - along * t) / t : 1e9;
        found.linear = texelFetch(key_colours[k], texel, 0).rgb;
    }
    found.depth_m = t;
    if (is_sky) {
        if (was_free) found.kind = kEmpty;
        return found;
    }
    bool is_in_slab = !is_slab_tested || abs(t - low_m) <= 1.5 * slack_depth_m + 0.002 * low_m;
    if (off_px <= tolerance_px && is_in_slab) found.kind = kFound;
    else if (was_free && t > low_m && off_px <= tolerance_px) found.kind = kEmpty;
    return found;
}

void main() {
    float depth_m = dot(eye_forward, surface.relative_m);
    vec3 ray_m = surface.relative_m / depth_m;
    vec3 normal = cross(dFdx(surface.relative_m), dFdy(surface.relative_m));
    normal *= (normal.z < 0.0 ? -1.0 : 1.0) / max(length(normal), 1e-20);
    // Where the ray meets the coarse surface itself, so far below what was drawn.
    float slack = slack_m(surface.relative_m);
    float fall = max(-dot(normal, ray_m), 0.02 * length(ray_m));
    float slack_depth_m = slack * normal.z / fall;
    float low_m = depth_m + raise * slack_depth_m;
    vec3 low_at_m = ray_m * low_m;

    vec3 sum = vec3(0.0);
    float weight = 0.0, shown_m = low_m;
    bool is_empty = false;
    int source = -1;
    if (low_m >= near_depth_m) {
        for (int k = 0; k < KEYS; ++k) {
            Found found = find(k, ray_m, low_m, slack_depth_m, normal);
            is_empty = is_empty || found.kind == kEmpty;
            if (found.kind != kFound) continue;
            sum += key_weights[k] * found.linear;
            weight += key_weights[k];
            shown_m = found.depth_m;
            source = k;
        }
    }
    if (weight == 0.0 && is_empty && raise > 0.0) discard;
    vec3 linear = weight > 0.0 ? sum / weight : own_colour(low_at_m);
#ifdef SHOWS_SOURCES
    float light = dot(linear, vec3(0.21, 0.72, 0.07));
    vec3 tint = source < 0 ? (low_m < near_depth_m ? vec3(0.2, 0.5, 1.0) : vec3(1.0, 0.25, 0.15))
                           : (source == 0 ? vec3(0.9) : vec3(0.95, 0.85, 0.3));
    linear = tint * (0.15 + light);
#endif
    colour = vec4(encoded(behind_air(linear, ray_m * shown_m)), 1.0);
}
)";

}  // namespace overlook::lod_sprite::shaders
