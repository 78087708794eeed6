// The shaders that put two frames together: draw_turns.cpp's. They stand alone: any renderer that has two such buffers can use
// them.
#pragma once

namespace overlook::discrete::shaders {

// How buffers are read. SAMPLES: of the buffers and the picture, a pixel.
inline constexpr char kSamplers[] = R"(
#if SAMPLES > 1
#define Picture sampler2DMS
#define Numbers usampler2DMS
#define fetch(from, at) texelFetch(from, at, gl_SampleID)
#define fetch_sample(from, at, index) texelFetch(from, at, index)
#else
#define Picture sampler2D
#define Numbers usampler2D
#define fetch(from, at) texelFetch(from, at, 0)
#define fetch_sample(from, at, index) texelFetch(from, at, 0)
#define gl_SampleID 0
#endif
)";

// What puts two frames together, between kSamplers and kPlaces.
inline constexpr char kCombined[] = R"(
uniform mat4 camera_old_from_new;
layout(location = 0) out vec4 colour;
)";

// Places of pixels and in clip coordinates, for any stage; z: what the depth buffer holds.
inline constexpr char kPlaces[] = R"(
uniform ivec2 size_px;
bool is_inside(ivec2 at) {
    return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size_px));
}
// Where a pixel's middle is, in clip coordinates, and back.
vec2 clip_of(vec2 at_px) {
    return 2.0 * at_px / vec2(size_px) - 1.0;
}
vec2 place_px(vec4 at) {
    return at.w > 0.0 ? (0.5 * at.xy / at.w + 0.5) * vec2(size_px) : vec2(-1.0);
}
vec3 moved(mat4 by, vec2 clip, float z) {
    vec4 at = by * vec4(clip, z, 1.0);
    return at.w > 0.0 ? vec3(place_px(at), at.z / at.w) : vec3(-1.0);
}
)";

// Section 3.4, with Equation 2 and its three cases.
inline constexpr char kPaperCombination[] = R"(
layout(binding = 0) uniform Picture new_colour;
layout(binding = 1) uniform Picture new_depth_and_id;
layout(binding = 2) uniform Picture old_colour;
layout(binding = 3) uniform Picture old_depth_and_id;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 newer = fetch(new_colour, at).rgb;
    vec2 newer_at = fetch(new_depth_and_id, at).xy;
    colour = vec4(newer, 1.0);
    gl_FragDepth = 1.0 - newer_at.x;
    ivec2 old_at = ivec2(floor(moved(camera_old_from_new, clip_of(vec2(at) + 0.5), 1.0 - newer_at.x).xy));
    if (!is_inside(old_at)) return;
    vec2 older_at = fetch(old_depth_and_id, old_at).xy;
    if (newer_at.y == 0.0 && older_at.y == 0.0) return;
    vec3 older = fetch(old_colour, old_at).rgb;
    if (newer_at.y == older_at.y) {
        colour = vec4(0.5 * (newer + older), 1.0);
    } else if (older_at.x < newer_at.x) {
        colour = vec4(older, 1.0);
        gl_FragDepth = 1.0 - older_at.x;
    }
}
)";

}  // namespace overlook::discrete::shaders
