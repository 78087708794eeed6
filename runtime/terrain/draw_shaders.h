// The shaders of draw.cpp, beside those of runtime/gl/surface_shaders.h; fragment shaders are put together from gl's kEncoding,
// kAir and what follows it.
#pragma once

namespace overlook::terrain::shaders {

// A vertex is a raster sample, or from `sample_count` on a place in the list of those that morph: which sample, and how far above
// its own height.
inline constexpr char kTerrainVertexInputs[] = R"(#version 450 core
layout(binding = 1) uniform samplerBuffer heights;   // of every sample above the terrain's base, metres
layout(binding = 2) uniform usamplerBuffer morphs;   // sample, and the bits of its rise in metres
uniform uint sample_count;
uniform uint width;
uniform ivec2 camera_sample;                   // whole cells of the camera's place, and what is left of it
uniform vec2 camera_rest;
uniform vec2 metres_per_cell;                  // y negative: rows go down the raster
uniform float camera_height_m;                 // above the terrain's base
uniform mat4 clip_from_relative;
uniform vec4 part;                             // of the picture: scale and shift of what is drawn
uniform vec2 raster_size;
out Surface {
    vec3 relative_m;
    vec2 place;                                // 0..1 over the raster
    float height_m;
} surface;
)";

// Which cell a place is: of a raster; of tiles, by the first cell and the level of its slot (runtime/terrain/tiles.h).
inline constexpr char kRasterCells[] = R"(
ivec2 cell_of(uint id) {
    return ivec2(id % width, id / width);
}
)";
inline constexpr char kTileCells[] = R"(
layout(binding = 4) uniform usamplerBuffer slots;
ivec2 cell_of(uint id) {
    uint local = id % (129u * 129u);
    uvec4 slot = texelFetch(slots, int(id / (129u * 129u)));
    uvec2 cell = slot.xy + (uvec2(local % 129u, local / 129u) << slot.z);
    return ivec2(min(cell, uvec2(raster_size) - 1u));
}
)";

inline constexpr char kTerrainVertexMain[] = R"(
void main() {
    uint id = uint(gl_VertexID);
    float rise_m = 0.0;
    if (id >= sample_count) {
        uvec2 morph = texelFetch(morphs, int(id - sample_count)).xy;
        id = morph.x;
        rise_m = uintBitsToFloat(morph.y);
    }
    float height_m = texelFetch(heights, int(id)).r + rise_m;
    ivec2 cell = cell_of(id);
    vec2 cells_away = vec2(cell - camera_sample) - camera_rest;
    vec3 true_m = vec3(cells_away * metres_per_cell, height_m - camera_height_m);
    surface.relative_m = placed(true_m);
    surface.place = (vec2(cell) + 0.5 + (surface.relative_m.xy - true_m.xy) / metres_per_cell) / raster_size;
    surface.height_m = height_m + surface.relative_m.z - true_m.z;
    gl_Position = clip_from_relative * vec4(surface.relative_m, 1.0);
    gl_Position.xy = gl_Position.xy * part.xy + gl_Position.w * part.zw;
}
)";

// Gives every corner of a triangle its own coordinate, 1 there and 0 on the side opposite.
inline constexpr char kWireframeGeometry[] = R"(#version 450 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in Surface {
    vec3 relative_m;
    vec2 place;
    float height_m;
} corner[];
out Surface {
    vec3 relative_m;
    vec2 place;
    float height_m;
} surface;
out vec3 corners;

void main() {
    for (int i = 0; i < 3; ++i) {
        surface.relative_m = corner[i].relative_m;
        surface.place = corner[i].place;
        surface.height_m = corner[i].height_m;
        corners = vec3(i == 0, i == 1, i == 2);
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
)";

inline constexpr char kAir[] = R"(
uniform float haze_per_m;
// The sky, and the air before far things, by the sine of the altitude one looks at.
vec3 low_air_colour(float up) {
    return mix(vec3(0.24, 0.31, 0.39), vec3(0.60, 0.69, 0.78), exp(-12.0 * up * up));  // nadir, horizon
}
vec3 air_colour(float up) {
    vec3 horizon = vec3(0.60, 0.69, 0.78);
    vec3 middle = vec3(0.16, 0.34, 0.64);
    vec3 zenith = vec3(0.04, 0.11, 0.34);
    if (up < 0.0) return low_air_colour(up);
    vec3 low = mix(horizon, middle, 1.0 - exp(-7.0 * up - 20.0 * up * up));
    return mix(low, zenith, smoothstep(0.2, 0.95, up));
}

// A linear colour at a place relative to the eye.
vec3 behind_air(vec3 own, vec3 at_m) {
    float distance_m = length(at_m);
    vec3 air = low_air_colour(min(at_m.z / max(distance_m, 1e-6), 0.0) * 0.35);
    float hazes = distance_m * haze_per_m;
    return mix(air, own, exp(-hazes * sqrt(hazes)));
}
)";

inline constexpr char kTerrainFragment[] = R"(
in Surface {
    vec3 relative_m;
    vec2 place;
    float height_m;
} surface;
uniform bool has_texture;
uniform sampler2D colours;
uniform vec2 height_range_m;
uniform vec2 place_per_m;
out vec4 colour;

vec3 slope_shading(float height_m) {
    vec3 normal = normalize(cross(dFdx(surface.relative_m), dFdy(surface.relative_m)));
    if (normal.z < 0.0) normal = -normal;
    float light = 0.22 + 0.78 * max(0.0, dot(normal, normalize(vec3(-0.55, 0.55, 0.62))));
    float share = clamp((height_m - height_range_m.x) / max(height_range_m.y - height_range_m.x, 1e-6), 0.0, 1.0);
    return light * mix(vec3(0.33, 0.36, 0.24), vec3(0.70, 0.66, 0.60), share);
}

// Of the ground near the pixel, at a place relative to the eye.
vec3 own_colour(vec3 at_m) {
    vec3 away_m = at_m - surface.relative_m;
    if (!has_texture) return slope_shading(surface.height_m + away_m.z);
    return texture(colours, surface.place + away_m.xy * place_per_m).rgb;
}
)";

// Lines of even width on the screen, from how fast a corner's coordinate changes from pixel to pixel.
inline constexpr char kWireframeMain[] = R"(
in vec3 corners;
uniform float line_px;
void main() {
    vec3 per_px = max(fwidth(corners), vec3(1e-9));
    vec3 away_px = corners / per_px;
    float nearest_px = min(away_px.x, min(away_px.y, away_px.z));
    float line = 1.0 - smoothstep(0.5 * line_px - 0.5, 0.5 * line_px + 0.5, nearest_px);
    vec3 paper = mix(own_colour(surface.relative_m), vec3(0.85, 0.85, 0.82), 0.45);
    vec3 ink = vec3(0.015, 0.05, 0.11);
    colour = vec4(encoded(behind_air(mix(paper, ink, 0.85 * line), surface.relative_m)), 1.0);
}
)";

// The encoded colours of the sky in a row of kSkyColours, by the sine of the altitude, -1..1 from its first middle to its last.
inline constexpr int kSkyColours = 2048;
inline constexpr char kSkyRowFragment[] = R"(
uniform float count;
out vec4 colour;
void main() {
    colour = vec4(encoded(air_colour(2.0 * (gl_FragCoord.x - 0.5) / (count - 1.0) - 1.0)), 1.0);
}
)";

inline constexpr char kSkyFragment[] = R"(
layout(binding = 3) uniform sampler2D sky_row;

void main() {
    float count = float(textureSize(sky_row, 0).x), place = (0.5 + 0.5 * direction().z) * (count - 1.0) + 0.5;
    vec3 air = textureLod(sky_row, vec2(place / count, 0.5), 0.0).rgb;
    // Half a step of noise, the same in every frame, keeps the sky from showing bands.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy + first_px, vec2(0.06711056, 0.00583715)))) - 0.5;
    colour = vec4(air + noise / 255.0, 1.0);
}
)";

}  // namespace overlook::terrain::shaders
