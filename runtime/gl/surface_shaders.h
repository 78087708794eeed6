// GLSL that every thing that is drawn shares (surface.h says what a fragment shader finds at hand).
#pragma once

namespace overlook::gl::shaders {

// How fragment shaders begin that mix colours in linear light and write them as a picture holds them. The root of sRGB is taken
// by square roots, within a tenth of an 8-bit level of it, since powers cost a software renderer three times as much.
inline constexpr char kEncoding[] = R"(#version 450 core
vec3 encoded(vec3 linear) {
    vec3 root = sqrt(max(linear, vec3(0.0031308)));
    vec3 high = 0.29810 * sqrt(root) + 0.83375 * root - 0.055315 * linear - 0.076902;
    return mix(high, linear * 12.92, lessThanEqual(linear, vec3(0.0031308)));
}
)";

// Vertices are drawn where they are.
inline constexpr char kUnmoved[] = R"(
vec3 placed(vec3 relative_m) {
    return relative_m;
}
)";

// The thing's own colours behind the air.
inline constexpr char kShadedMain[] = R"(
void main() {
    colour = vec4(encoded(behind_air(own_colour(surface.relative_m), surface.relative_m)), 1.0);
}
)";

// One triangle over the whole picture, as far away as can be.
inline constexpr char kBackgroundVertex[] = R"(#version 450 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// How a fragment shader of the background begins: in what direction of the world its pixel looks.
inline constexpr char kBackgroundDirection[] = R"(#version 450 core
uniform mat3 world_from_eye;
uniform float focal_px;
uniform vec2 middle_px;  // of the picture
uniform vec2 first_px;   // of the part that is drawn: its lower left corner in the picture
out vec4 colour;
vec3 direction() {
    return normalize(world_from_eye * vec3((gl_FragCoord.xy + first_px - middle_px) / focal_px, -1.0));
}
)";

}  // namespace overlook::gl::shaders
