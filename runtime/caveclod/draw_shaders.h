// The shaders of draw.cpp, beside those of runtime/gl/surface_shaders.h.
#pragma once

namespace overlook::caveclod::shaders {

// A vertex is one of the mesh, or from glide_begin on one on its way between two of them.
inline constexpr char kMeshVertexInputs[] = R"(#version 450 core
layout(binding = 1) uniform usamplerBuffer vertices;  // four words: position, high and low; normal; uv
layout(binding = 2) uniform usamplerBuffer glides;    // two texels each: to and whether it glides, the bits of the share, weights; from
layout(binding = 3) uniform usamplerBuffer colours;   // red in the lowest byte
uniform uint glide_begin;
uniform uint low_bits;
uniform bool has_colours;
uniform ivec3 camera_steps;                   // whole steps of the camera's place, and what is left of it
uniform vec3 camera_rest;
uniform float step_m;
uniform vec2 uv_low;
uniform float uv_step;
uniform float normal_step;
uniform mat4 clip_from_relative;
uniform vec4 part;                            // of the picture: scale and shift of what is drawn
out Surface {
    vec3 relative_m;
    vec3 normal;
    vec2 uv;
    vec4 tint;
} surface;
)";

inline constexpr char kMeshVertexMain[] = R"(
struct Vertex {
    vec3 relative_m;
    vec3 normal;
    vec2 uv;
    vec4 tint;
};

vec4 linear_of(uint word) {
    vec4 encoded = unpackUnorm4x8(word);
    vec3 low = encoded.rgb / 12.92, high = pow((encoded.rgb + 0.055) / 1.055, vec3(2.4));
    return vec4(mix(high, low, lessThanEqual(encoded.rgb, vec3(0.04045))), encoded.a);
}

Vertex vertex_at(uint id) {
    uvec4 words = texelFetch(vertices, int(id));
    uvec3 high = uvec3(words.x & 0xffffu, words.x >> 16, words.y & 0xffffu);
    uint packed_low = words.y >> 16;
    uvec3 low = uvec3(packed_low & 15u, packed_low >> 4 & 15u, packed_low >> 8 & 15u);
    ivec3 steps = ivec3(high << low_bits | low);
    vec2 at = vec2(ivec2(int(words.z << 16) >> 16, int(words.z) >> 16)) * normal_step;
    vec3 normal = vec3(at, 1.0 - abs(at.x) - abs(at.y));
    if (normal.z < 0.0) normal.xy = (1.0 - abs(at.yx)) * vec2(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0);
    Vertex vertex;
    vertex.relative_m = (vec3(steps - camera_steps) - camera_rest) * step_m;
    vertex.normal = normalize(normal);
    vertex.uv = uv_low + vec2(words.w & 0xffffu, words.w >> 16) * uv_step;
    vertex.tint = has_colours ? linear_of(texelFetch(colours, int(id)).r) : vec4(1.0);
    return vertex;
}

void main() {
    uint id = uint(gl_VertexID);
    Vertex vertex;
    if (id < glide_begin) {
        vertex = vertex_at(id);
    } else {
        int at = 2 * int(id - glide_begin);
        uvec3 glide = texelFetch(glides, at).xyz, from = texelFetch(glides, at + 1).xyz;
        bool glides_there = (glide.x & 0x80000000u) != 0u;
        float share = uintBitsToFloat(glide.y);
        Vertex to = vertex_at(glide.x & 0x7fffffffu), a = vertex_at(from.x);
        vertex = a;
        if (!glides_there) {
            Vertex b = vertex_at(from.y), c = vertex_at(from.z);
            vec2 weights = unpackUnorm2x16(glide.z);
            float rest = 1.0 - weights.x - weights.y;
            vertex.relative_m = to.relative_m;
            vertex.normal = weights.x * a.normal + weights.y * b.normal + rest * c.normal;
            vertex.uv = weights.x * a.uv + weights.y * b.uv + rest * c.uv;
            vertex.tint = weights.x * a.tint + weights.y * b.tint + rest * c.tint;
        }
        vertex.relative_m = mix(vertex.relative_m, to.relative_m, share);
        vertex.normal = mix(vertex.normal, to.normal, share);
        vertex.uv = mix(vertex.uv, to.uv, share);
        vertex.tint = mix(vertex.tint, to.tint, share);
    }
    surface.relative_m = placed(vertex.relative_m);
    surface.normal = vertex.normal;
    surface.uv = vertex.uv;
    surface.tint = vertex.tint;
    gl_Position = clip_from_relative * vec4(surface.relative_m, 1.0);
    gl_Position.xy = gl_Position.xy * part.xy + gl_Position.w * part.zw;
}
)";

inline constexpr char kMeshFragment[] = R"(
in Surface {
    vec3 relative_m;
    vec3 normal;
    vec2 uv;
    vec4 tint;
} surface;
layout(binding = 0) uniform sampler2D picture;
uniform vec4 base_colour;
uniform float alpha_cutoff;
uniform bool has_normals;
out vec4 colour;

// Of the surface near the pixel: light from the upper left, and a little from the eye.
vec3 own_colour(vec3 at_m) {
    vec4 own = base_colour * surface.tint * texture(picture, surface.uv);
    if (own.a < alpha_cutoff) discard;
    vec3 flat_normal = normalize(cross(dFdx(surface.relative_m), dFdy(surface.relative_m)));
    if (dot(flat_normal, surface.relative_m) > 0.0) flat_normal = -flat_normal;
    vec3 normal = has_normals ? normalize(surface.normal) : flat_normal;
    if (dot(normal, flat_normal) < 0.0) normal = -normal;
    float light = 0.25 + 0.6 * max(0.0, dot(normal, normalize(vec3(-0.5, -0.3, 0.8))));
    return own.rgb * (light + 0.15 * max(0.0, dot(normal, -normalize(surface.relative_m))));
}

// No air stands before a model.
vec3 behind_air(vec3 linear, vec3 at_m) {
    return linear;
}
)";

// Lighter above the horizon than below.
inline constexpr char kBackgroundFragment[] = R"(
void main() {
    colour = vec4(mix(vec3(0.30, 0.33, 0.38), vec3(0.62, 0.68, 0.76), 0.5 + 0.5 * direction().z), 1.0);
}
)";

}  // namespace overlook::caveclod::shaders
