// The shaders of draw.cpp, beside those of runtime/gl/surface_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

// What vertex shaders know of an item: draw_list.h's PackedItem, an attribute each, and what they tell fragment shaders of it:
// what these do not read costs nothing.
inline constexpr char kItemInputs[] = R"(
layout(location = 4) in vec4 item_place;     // metres of the chain's origin from the eye; scale
layout(location = 5) in vec4 item_numbers;   // cosine, sine, share, grain
layout(location = 6) in uvec4 item_which;    // id, level, show, change
layout(location = 7) in vec2 item_shift;     // of the visibility's lookup; of what is dithered out up to where
layout(location = 8) in uvec2 item_more;     // first pose, is plain
layout(location = 9) in vec3 item_line;      // in gl_FragCoord: above 0 on the side that is drawn if side is 1, else if it is 2
layout(location = 10) in uint item_side;     // 0: all is drawn
flat out vec4 known_place, known_numbers;
flat out uvec4 known_which;
flat out vec2 known_shift;
flat out uint known_is_plain;
flat out vec3 known_line;
flat out uint known_side;
void tell_item() {
    known_place = item_place;
    known_numbers = item_numbers;
    known_which = item_which;
    known_shift = item_shift;
    known_is_plain = item_more.y;
    known_line = item_line;
    known_side = item_side;
}
)";

// The same in a fragment shader.
inline constexpr char kItem[] = R"(
flat in vec4 known_place, known_numbers;
flat in uvec4 known_which;
flat in vec2 known_shift;
flat in uint known_is_plain;
flat in vec3 known_line;
flat in uint known_side;
struct Item {
    vec3 place_m;
    float scale;
    float cosine, sine, share, grain;
    uint id, level, show, change;
    vec2 shift;
    bool is_plain;
    vec3 line;
    uint side;
};
Item own_item() {
    return Item(known_place.xyz, known_place.w, known_numbers.x, known_numbers.y, known_numbers.z, known_numbers.w,
                known_which.x, known_which.y, known_which.z, known_which.w, known_shift, known_is_plain != 0u, known_line,
                known_side);
}
)";

inline constexpr char kVertex[] = R"(
layout(location = 0) in uvec4 place;   // whole steps, and the part
layout(location = 1) in vec2 octahedral;
layout(location = 2) in vec2 uv_steps;
layout(location = 3) in vec4 encoded_tint;
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

vec4 linear_of(vec4 encoded) {
    vec3 low = encoded.rgb / 12.92, high = pow((encoded.rgb + 0.055) / 1.055, vec3(2.4));
    return vec4(mix(high, low, lessThanEqual(encoded.rgb, vec3(0.04045))), encoded.a);
}

vec3 turned(vec4 turn, vec3 v) {
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}

vec3 stood(vec3 v) {
    float cosine = item_numbers.x, sine = item_numbers.y;
    return vec3(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z);
}

void main() {
    vec3 own_m = vec3(place.xyz) * step_m;
    vec3 normal = vec3(octahedral, 1.0 - abs(octahedral.x) - abs(octahedral.y));
    if (normal.z < 0.0) {
        vec2 signs = vec2(octahedral.x < 0.0 ? -1.0 : 1.0, octahedral.y < 0.0 ? -1.0 : 1.0);
        normal.xy = (1.0 - abs(octahedral.yx)) * signs;
    }
    surface.rest_m = own_m;
    if (is_animated) {
        Pose pose = poses[item_more.x + place.w];
        own_m = turned(pose.turn, own_m) + pose.move_m.xyz;
        normal = turned(pose.turn, normal);
    }
    surface.relative_m = item_place.xyz + item_place.w * stood(own_m);
    surface.normal = stood(normalize(normal));
    surface.uv = uv_low + uv_steps * uv_step;
    surface.tint = linear_of(encoded_tint);
    tell_item();
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
layout(binding = 1) uniform usamplerBuffer visibilities;  // two each: lookup, width, height, depth; period, first of its values
layout(binding = 2) uniform usamplerBuffer values;        // four in one
float visibility_of(Item item, vec3 rest_m) {
    uvec4 form = texelFetch(visibilities, int(2u * item.change)), more = texelFetch(visibilities, int(2u * item.change + 1u));
    uvec3 size = form.yzw, at;
    float period_m = uintBitsToFloat(more.x);
    if (form.x == 0u) {
        vec2 turns = vec2(rest_m.x + rest_m.z, rest_m.y + rest_m.z) / (period_m * item.grain) + item.shift;
        at = uvec3(min(uvec2((turns - floor(turns)) * vec2(size.xy)), size.xy - 1u), 0u);
    } else {
        at = min(uvec3(max(rest_m / period_m, vec3(0.0)) * vec3(size)), size - 1u);
    }
    uint place = more.y + (at.z * size.y + at.y) * size.x + at.x;
    return float(texelFetch(values, int(place >> 2)).r >> (8u * (place & 3u)) & 255u) / 255.0;
}
)";

// A screen door, Bayer's 8 x 8 (Bayer 1973): from which share on it is open at a pixel.
inline constexpr char kDoor[] = R"(
float door() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    uint x = p.x ^ p.y, y = p.y, order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) order = order << 2 | (x >> bit & 1u) << 1 | (y >> bit & 1u);
    return (float(order) + 0.5) / 64.0;
}
)";

// One picture: what is whole, behind a screen door or translucent. After kDoor.
inline constexpr char kOnePictureMain[] = R"(
void main() {
    Item item = own_item();
    vec3 own = own_colour(item.is_plain);
    if (item.show == 2u && door() >= item.share) discard;
    if (item.show == 3u && (door() < item.share || door() >= item.shift.x)) discard;
    colour = vec4(encoded(own), item.show == 4u ? item.share : 1.0);
}
)";

// A buffer of frame-sequential interpolation. KEEPS_HIDDEN: alpha says how early the place appears, 1 at once, and nothing is
// left out.
inline constexpr char kTurnMain[] = R"(
layout(location = 1) out uvec2 ids;  // instance + 1, level
void main() {
    Item item = own_item();
    bool is_along = dot(item.line, vec3(gl_FragCoord.xy, 1.0)) >= 0.0;
    if (item.side != 0u && is_along != (item.side == 1u)) discard;
    vec3 own = own_colour(item.is_plain);
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
    Item item = own_item();
    vec3 own = own_colour(item.is_plain);
    if (item.show == 1u && visibility_of(item, surface.rest_m) > item.share) discard;
    colour = vec4(encoded(own), 1.0);
    depth_and_id = vec2(1.0 - gl_FragCoord.z, item.show == 1u ? float(item.id) : 0.0);
}
)";

}  // namespace overlook::discrete::shaders
