// The shaders of draw.cpp: parts of a gl::SurfaceShader.
#pragma once

namespace overlook::lod_sprite::shaders {

// How far from a place the true surface may lie: what low_error_px pixels are there, along the vertical
// (view::error_px_bound_vertical solved for its error) or in any direction (view::error_px_bound).
inline constexpr char kSlack[] = R"(
uniform vec3 eye_forward;
uniform float focal_px, near_m, low_error_px, near_error_px, near_depth_m, most_slack_m;
float slack_m(vec3 at_m) {
    float depth_m = max(dot(eye_forward, at_m), near_m);
    float error_px = depth_m < near_depth_m ? near_error_px : low_error_px;
#ifdef ERROR_IS_VERTICAL
    float slack = error_px * depth_m / (focal_px * length(at_m.xy) / depth_m + error_px * abs(eye_forward.z));
#else
    float slack = error_px * depth_m / (focal_px * length(at_m) / depth_m + error_px);
#endif
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

// KEYS is the count of keys, LOOK_UPS how often a place is looked up anew, SHOWS_SOURCES whether colours tell the source.
// Key space: axes of the key's camera, z forward, origin at its eye.
//
// A pixel's ray enters the raised surface somewhere; what it meets behind is looked for in a key by iteration: take a point on
// the ray, look up how deep the key is in its direction, go on with the point of the ray as deep (for the novel camera) as what
// the key shows there, until its place in the key hardly moves. That settles where ray and key's surface meet. The four texels
// round that place are then asked one by one: each is a point of the true surface (or of the sky, infinitely far), and counts
// only if its own place in this frame is where it would be shown. No loop goes over keys: a sampler that is not known when the
// shader is compiled costs a software renderer several times as much.
inline constexpr char kFind[] = R"(
uniform mat3 key_from_world[KEYS];
uniform vec3 forward_in_key[KEYS];
uniform vec3 eye_in_key_m[KEYS];
uniform vec2 key_tangents[KEYS];
uniform float key_near_m[KEYS];
uniform float key_weights[KEYS];
layout(binding = 4) uniform sampler2D key_colours[KEYS];
layout(binding = 8) uniform sampler2D key_depths[KEYS];  // near / depth
uniform float raise;
uniform float tolerance_px;   // beside the distance of a texel's middle from the place looked up
uniform float most_texel_px;  // a texel that has become wider shows nothing
uniform bool is_slab_tested, is_place_tested;
const float kFarthest = 1e-7;  // of near / depth: the sky
const float kSettled = 0.25;   // texels

// Where in a key to look for what a pixel's ray meets, and what the key shows there.
struct Place {
    vec2 base, part;  // of the lower left of four texels; where between their middles
    vec4 weights;     // of those that count, in the order of textureGather
    float sum;        // of the weights
    bool is_found, is_sky;
};

// In key k, on the ray whose point at depth t is ray_m * t, looked for from low_m on, where the coarse surface is.
Place place_in(int k, vec3 ray_m, float low_m, float slack_depth_m) {
    vec3 origin = eye_in_key_m[k], along = key_from_world[k] * ray_m, forward = forward_in_key[k];
    float near_in_key_m = key_near_m[k], origin_t = dot(forward, origin);
    vec2 tangents = key_tangents[k], size = vec2(textureSize(key_depths[k], 0)), middle = 0.5 * size;
    vec2 scale = middle / tangents, texel_tangents = 1.0 / scale;
    float widest_m = most_texel_px / (focal_px * max(texel_tangents.x, texel_tangents.y));  // for every metre of depth
    vec3 at = origin + along * low_m;
    bool is_fine = at.z > near_in_key_m && at.z <= widest_m * low_m, was_free = false;
    vec2 tangent = at.xy / max(at.z, near_in_key_m), texel = middle + scale * tangent;
    for (int i = 0; i < LOOK_UPS; ++i) {
        float depth_m = near_in_key_m / max(textureLod(key_depths[k], texel / size, 0.0).r, kFarthest);
        if (i == 0) was_free = depth_m > at.z * 1.001;
        at = origin + along * (dot(forward, vec3(tangent, 1.0)) * depth_m - origin_t);
        tangent = at.xy / max(at.z, near_in_key_m);
        vec2 before = texel;
        texel = middle + scale * tangent;
        vec2 moved = abs(texel - before);
        if (max(moved.x, moved.y) < kSettled) break;
    }
    Place place;
    vec2 corner = texel - 0.5, base = floor(corner), part = corner - base;
    bool is_inside = at.z > near_in_key_m && all(greaterThanEqual(base, vec2(0.0))) && all(lessThan(base, size - 1.0));

    vec4 depths_m = near_in_key_m / max(textureGather(key_depths[k], (base + 1.0) / size), kFarthest);
    vec2 low_tangent = (base + 0.5) * texel_tangents - tangents;
    vec4 right = vec4(0.0, 1.0, 1.0, 0.0), up = vec4(1.0, 1.0, 0.0, 0.0);  // the order of textureGather
    vec4 x = (low_tangent.x + right * texel_tangents.x) * depths_m - origin.x;
    vec4 y = (low_tangent.y + up * texel_tangents.y) * depths_m - origin.y;
    vec4 z = depths_m - origin.z;
    vec4 own_t = forward.x * x + forward.y * y + forward.z * z;
    vec4 off_x = x - along.x * own_t, off_y = y - along.y * own_t, off_z = z - along.z * own_t;
    vec4 off_squared = off_x * off_x + off_y * off_y + off_z * off_z;
    vec4 away_x = (right - part.x) * texel_tangents.x, away_y = (up - part.y) * texel_tangents.y;
    vec4 allowed = tolerance_px / focal_px * own_t + sqrt(away_x * away_x + away_y * away_y) * depths_m;
    bvec4 in_place = lessThanEqual(off_squared, allowed * allowed);
    vec4 weights = mix(vec4(1.0 - part.x), vec4(part.x), right) * mix(vec4(1.0 - part.y), vec4(part.y), up);
    if (is_place_tested) weights *= vec4(in_place) * vec4(greaterThan(own_t, vec4(0.0)));
    weights *= vec4(lessThanEqual(depths_m, widest_m * own_t));
    place.base = base, place.part = part, place.weights = weights;
    place.sum = weights.x + weights.y + weights.z + weights.w;

    float shown_m = dot(weights, own_t) / max(place.sum, 1e-6);
    // Beyond what the coarse surface allows only if the key saw the space before it empty.
    bool is_in_slab = abs(shown_m - low_m) <= 1.5 * slack_depth_m + 0.002 * low_m;
    bool is_sky = shown_m > 0.5 / kFarthest * near_in_key_m;
    // What the key saw through there, it saw through as finely as if it had shown something.
    place.is_found = is_inside && place.sum > 0.05 && (is_in_slab || (was_free && shown_m > low_m) || !is_slab_tested) &&
                     (is_fine || !is_sky);
    place.is_sky = place.is_found && is_sky;
    return place;
}

// The texels that count, mixed; encoded.
vec3 shown_at(int k, Place place) {
    ivec2 texel = ivec2(place.base);
    vec3 shown = place.weights.x * texelFetch(key_colours[k], texel + ivec2(0, 1), 0).rgb +
                 place.weights.y * texelFetch(key_colours[k], texel + ivec2(1, 1), 0).rgb +
                 place.weights.z * texelFetch(key_colours[k], texel + ivec2(1, 0), 0).rgb +
                 place.weights.w * texelFetch(key_colours[k], texel, 0).rgb;
    return shown / max(place.sum, 1e-6);
}

// The same where all four count, by the texture unit alone.
vec3 all_shown_at(int k, Place place) {
    return textureLod(key_colours[k], (place.base + place.part + 0.5) / vec2(textureSize(key_colours[k], 0)), 0.0).rgb;
}

// The ray of this pixel, as deep as 1 m; how deep the coarse surface itself is on it, and how thick along it what the coarse surface
// may be off by.
void look(out vec3 ray_m, out float low_m, out float slack_depth_m) {
    float depth_m = dot(eye_forward, surface.relative_m);
    ray_m = surface.relative_m / depth_m;
    vec3 normal = cross(dFdx(surface.relative_m), dFdy(surface.relative_m));
    float steepest = 0.01 * length(ray_m);
#ifdef ERROR_IS_VERTICAL
    normal *= (normal.z < 0.0 ? -1.0 : 1.0) / max(length(normal), 1e-20);
    // Where the ray meets the coarse surface itself, so far below what was drawn.
    slack_depth_m = slack_m(surface.relative_m) * normal.z / max(-dot(normal, ray_m), steepest);
    low_m = depth_m + raise * slack_depth_m;
#else
    slack_depth_m = slack_m(surface.relative_m) / max(abs(dot(normal, ray_m)) / max(length(normal), 1e-20), steepest);
    low_m = depth_m;
#endif
}
)";

// First what keys show, on the raised surface, so that it hides the surface itself; the sky is left as it is. WHOLE: only pixels
// all of whose texels count, in every key: nearly all of them, and the cheaper.
inline constexpr char kNovelMain[] = R"(
uniform float own_weight;  // of what is there already, where the first key alone shows something
vec4 sum = vec4(0.0);
int used = 0;
void add_key(int k, vec3 ray_m, float low_m, float slack_depth_m) {
    Place place = place_in(k, ray_m, low_m, slack_depth_m);
    bool counts = place.is_found && !place.is_sky;
#ifdef WHOLE
    if (!counts || place.sum < 0.9999) discard;
    vec3 shown = all_shown_at(k, place);
#else
    vec3 shown = shown_at(k, place);
#endif
    float weight = counts ? key_weights[k] : 0.0;
#ifdef SHOWS_SOURCES
    shown = dot(shown, vec3(0.3, 0.6, 0.1)) * (k == 0 ? vec3(1.0) : vec3(1.0, 0.9, 0.3));
#endif
    sum += weight * vec4(shown, 1.0);
    if (weight > 0.0) used |= 1 << k;
}

void main() {
    vec3 ray_m;
    float low_m, slack_depth_m;
    look(ray_m, low_m, slack_depth_m);
    add_key(0, ray_m, low_m, slack_depth_m);
#if KEYS > 1
    add_key(1, ray_m, low_m, slack_depth_m);
#endif
#if KEYS > 2
    add_key(2, ray_m, low_m, slack_depth_m);
#endif
    if (sum.a == 0.0 || low_m < near_depth_m) discard;
#ifdef MASK_OWN
    colour = vec4(float(used) / 255.0, 0.0, 0.0, 1.0);
#else
    colour = vec4(sum.rgb / sum.a, used == 1 ? 1.0 - own_weight : 1.0);
#endif
}
)";

// Then what no key shows, with the thing's own colours, but for what a key knows to be sky.
inline constexpr char kOwnMain[] = R"(
void main() {
    vec3 own = own_colour(surface.relative_m);
    bool is_near = dot(eye_forward, surface.relative_m) < near_depth_m;
#if KEYS > 0
    vec3 ray_m;
    float low_m, slack_depth_m;
    look(ray_m, low_m, slack_depth_m);
    bool is_sky = place_in(0, ray_m, low_m, slack_depth_m).is_sky;
#if KEYS > 1
    is_sky = place_in(1, ray_m, low_m, slack_depth_m).is_sky || is_sky;
#endif
#if KEYS > 2
    is_sky = place_in(2, ray_m, low_m, slack_depth_m).is_sky || is_sky;
#endif
    if (!is_near && is_sky) discard;
#endif
#ifdef SHOWS_SOURCES
    own = (is_near ? vec3(0.2, 0.5, 1.0) : vec3(1.0, 0.25, 0.15)) * (0.15 + dot(own, vec3(0.21, 0.72, 0.07)));
#endif
#ifdef MASK_OWN
    colour = vec4(float(is_near ? MASK_NEAR : MASK_OWN) / 255.0, 0.0, 0.0, 1.0);
#else
    colour = vec4(encoded(behind_air(own, surface.relative_m)), 1.0);
#endif
}
)";

}  // namespace overlook::lod_sprite::shaders
