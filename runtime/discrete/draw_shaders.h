// The shaders of draw.cpp, beside those of runtime/gl/surface_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

// What vertex and fragment shaders know of an item: draw_list.h's PackedItem.
inline constexpr char kItems[] = R"(
struct Item {
    vec3 place_m;      // of the chain's origin, from the eye
    float scale;
    float cosine, sine, share, grain;
    uint id, level, show, change;
    vec2 shift;        // of the visibility's lookup
    uint first_pose, is_plain;
    vec3 line;         // in gl_FragCoord: above 0 on the side that is drawn if side is 1, else if it is 2; 0: all is drawn
    uint side;
};
layout(std430, binding = 0) readonly buffer Items { Item items[]; };
)";

inline constexpr char kVertex[] = R"(
layout(location = 0) in uvec4 place;   // whole steps, and the part
layout(location = 1) in vec2 octahedral;
layout(location = 2) in vec2 uv_steps;
layout(location = 3) in vec4 encoded_tint;
layout(location = 4) in uint item_index;
struct Pose {
    vec4 turn, move_m;
};
layout(std430, binding = 1) readonly buffer Poses { Pose poses[]; };
uniform float step_m;
uniform vec2 uv_low;
uniform float uv_step;
uniform bool is_animated;
uniform mat4 clip_from_relative;
uniform vec4 part;  // of the picture: scale and shift of what is drawn
out Surface {
    vec3 relative_m;
    vec3 normal;
    vec2 uv;
    vec4 tint;
    vec3 rest_m;
} surface;
flat out uint item_of;

vec4 linear_of(vec4 encoded) {
    vec3 low = encoded.rgb / 12.92, high = pow((encoded.rgb + 0.055) / 1.055, vec3(2.4));
    return vec4(mix(high, low, lessThanEqual(encoded.rgb, vec3(0.04045))), encoded.a);
}

vec3 turned(vec4 turn, vec3 v) {
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}

vec3 stood(Item item, vec3 v) {
    return vec3(item.cosine * v.x - item.sine * v.y, item.sine * v.x + item.cosine * v.y, v.z);
}

void main() {
    Item item = items[item_index];
    vec3 own_m = vec3(place.xyz) * step_m;
    vec3 normal = vec3(octahedral, 1.0 - abs(octahedral.x) - abs(octahedral.y));
    if (normal.z < 0.0) {
        vec2 signs = vec2(octahedral.x < 0.0 ? -1.0 : 1.0, octahedral.y < 0.0 ? -1.0 : 1.0);
        normal.xy = (1.0 - abs(octahedral.yx)) * signs;
    }
    surface.rest_m = own_m;
    if (is_animated) {
        Pose pose = poses[item.first_pose + place.w];
        own_m = turned(pose.turn, own_m) + pose.move_m.xyz;
        normal = turned(pose.turn, normal);
    }
    surface.relative_m = item.place_m + item.scale * stood(item, own_m);
    surface.normal = stood(item, normalize(normal));
    surface.uv = uv_low + uv_steps * uv_step;
    surface.tint = linear_of(encoded_tint);
    item_of = item_index;
    gl_Position = clip_from_relative * vec4(surface.relative_m, 1.0);
    gl_Position.xy = gl_Position.xy * part.xy + gl_Position.w * part.zw;
}
)";

inline constexpr char kFragment[] = R"(
in Surface {
    vec3 relative_m;
    vec3 normal;
    vec2 uv;
    vec4 tint;
    vec3 rest_m;
} surface;
flat in uint item_of;
layout(binding = 0) uniform sampler2D picture;
uniform vec4 base_colour;
uniform float alpha_cutoff;
uniform bool has_normals;
uniform bool is_card;
uniform bool is_two_sided;
layout(location = 0) out vec4 colour;

// SHADING_ROUNDS: so many lights more, all round, each with a highlight: a shader that is dear.
#if SHADING_ROUNDS > 0
float further_light(vec3 normal, vec3 to_eye) {
    float sum = 0.0;
    for (int i = 0; i < SHADING_ROUNDS; ++i) {
        float turn = 2.399963 * float(i), height = (float(i) + 0.5) / float(SHADING_ROUNDS);
        vec3 light = vec3(sqrt(1.0 - height * height) * vec2(cos(turn), sin(turn)), height);
        sum += max(0.0, dot(normal, light)) + pow(max(0.0, dot(reflect(-light, normal), to_eye)), 8.0 + float(i));
    }
    return sum / float(SHADING_ROUNDS);
}
#endif

vec3 unlit_colour(bool is_plain) {
    vec4 own = base_colour * surface.tint;
    vec4 texel = texture(picture, surface.uv);
    if (!is_plain) own *= texel;
    if (own.a < alpha_cutoff) discard;
    return own.rgb;
}

// Light from the upper left, and a little from the eye.
vec3 own_colour(bool is_plain) {
    vec3 own = unlit_colour(is_plain);
    vec3 flat_normal = normalize(cross(dFdx(surface.relative_m), dFdy(surface.relative_m)));
    if (dot(flat_normal, surface.relative_m) > 0.0) flat_normal = -flat_normal;
    vec3 normal = has_normals && !is_plain ? normalize(surface.normal) : flat_normal;
    // What is seen from behind: of a surface its other side; of a card the thing itself, to which its normals belong.
    if (dot(normal, flat_normal) < 0.0) normal = is_card ? reflect(normal, flat_normal) : -normal;
    float light = 0.25 + 0.6 * max(0.0, dot(normal, normalize(vec3(-0.5, -0.3, 0.8))));
#if SHADING_ROUNDS > 0
    light = 0.5 * light + 0.5 * further_light(normal, -normalize(surface.relative_m));
#endif
    return own * (light + 0.15 * max(0.0, dot(normal, -normalize(surface.relative_m))));
}
)";

// The paper's routine, and a volume: which places come first, 0..1.
inline constexpr char kVisibility[] = R"(
struct Visibility {
    uint lookup, width, height, depth;
    float period_m;
    uint first, pad0, pad1;   // of its values, one a byte
};
layout(std430, binding = 2) readonly buffer Visibilities { Visibility visibilities[]; };
layout(std430, binding = 3) readonly buffer Values { uint values[]; };
float visibility_of(Item item, vec3 rest_m) {
    Visibility one = visibilities[item.change];
    uvec3 size = uvec3(one.width, one.height, one.depth), at;
    if (one.lookup == 0u) {
        vec2 turns = vec2(rest_m.x + rest_m.z, rest_m.y + rest_m.z) / (one.period_m * item.grain) + item.shift;
        at = uvec3(min(uvec2((turns - floor(turns)) * vec2(size.xy)), size.xy - 1u), 0u);
    } else {
        at = min(uvec3(max(rest_m / one.period_m, vec3(0.0)) * vec3(size)), size - 1u);
    }
    uint place = one.first + (at.z * size.y + at.y) * size.x + at.x;
    return float(values[place >> 2] >> (8u * (place & 3u)) & 255u) / 255.0;
}
)";

// One picture: what is whole, behind a screen door or translucent. The door is Bayer's 8 x 8 (Bayer 1973).
inline constexpr char kOnePictureMain[] = R"(
float door() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    uint x = p.x ^ p.y, y = p.y, order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) order = order << 2 | (x >> bit & 1u) << 1 | (y >> bit & 1u);
    return (float(order) + 0.5) / 64.0;
}
void main() {
    Item item = items[item_of];
    vec3 own = own_colour(item.is_plain != 0u);
    if (item.show == 2u && door() >= item.share) discard;
    if (item.show == 3u && door() < item.share) discard;
    colour = vec4(encoded(own), item.show == 4u ? item.share : 1.0);
}
)";

// A buffer of frame-sequential interpolation. KEEPS_HIDDEN: alpha says how early the place appears, 1 at once, and nothing is
// left out.
inline constexpr char kTurnMain[] = R"(
layout(location = 1) out uvec2 ids;  // instance + 1, level
void main() {
    Item item = items[item_of];
    bool is_along = dot(item.line, vec3(gl_FragCoord.xy, 1.0)) >= 0.0;
    if (item.side != 0u && is_along != (item.side == 1u)) discard;
    vec3 own = own_colour(item.is_plain != 0u);
    float appears = item.show == 1u ? visibility_of(item, surface.rest_m) : 0.0;
#if !KEEPS_HIDDEN
    if (appears > item.share) discard;
#endif
    colour = vec4(encoded(own), 1.0 - appears);
    ids = uvec2(item.id, item.level);
}
)";

// The same as printed: depth, from 0 near to 1 far, and the id, 0 of all that is not under way.
inline constexpr char kPaperTurnMain[] = R"(
layout(location = 1) out vec2 depth_and_id;
void main() {
    Item item = items[item_of];
    vec3 own = own_colour(item.is_plain != 0u);
    if (item.show == 1u && visibility_of(item, surface.rest_m) > item.share) discard;
    colour = vec4(encoded(own), 1.0);
    depth_and_id = vec2(1.0 - gl_FragCoord.z, item.show == 1u ? float(item.id) : 0.0);
}
)";

}  // namespace overlook::discrete::shaders
