// How much of what is under way is there, and where it was in the older of two frames: between kCombinationInputs and
// kCombinationMain of draw_combination_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

inline constexpr char kCombinationParts[] = R"(
// The orders of appearance before which places are there, and those up to `softness` before it are on their way: such that over
// evenly spread orders the mean that is there is `share`, which changes as evenly as time goes.
float front_of(float share) {
    float edge = min(softness, 1.0), edge_share = edge * edge / (2.0 * softness);
    if (share < edge_share) return sqrt(2.0 * softness * share);
    if (share > 1.0 - edge_share) return 1.0 + softness - sqrt(2.0 * softness * (1.0 - share));
    return edge + (share - edge_share) * softness / edge;
}
// How much of what is seen of an instance under way is there, 0..1.
float presence(Way one, uint level, float appears) {
#if KEEPS_HIDDEN
#if HAS_LONG_RAMPS
    float share = level == one.to ? one.phase : 1.0 - one.phase;
#else
    float share = level == one.to ? min(2.0 * one.phase, 1.0) : min(2.0 - 2.0 * one.phase, 1.0);
#endif
    if (share >= 1.0) return 1.0;
    if (softness <= 0.0) return appears <= share ? 1.0 : 0.0;
    return clamp((front_of(share) - appears) / softness, 0.0, 1.0);
#else
    return 1.0;
#endif
}
// Both levels at one place; in the same order whichever of them is the newer one, so that the two frames round alike. older:
// colour and order of appearance.
vec3 both(Way one, Seen newer, vec4 older, uint older_level) {
    if (newer.level == older_level) return newer.colour;
#if WEIGHS_BY_PHASE
    bool is_newer_to = newer.level == one.to;
    return mix(is_newer_to ? older.rgb : newer.colour, is_newer_to ? newer.colour : older.rgb, one.phase);
#else
    float newer_share = presence(one, newer.level, newer.appears), older_share = presence(one, older_level, older.a);
    vec3 whole = newer_share >= older_share ? newer.colour : older.rgb;
    return mix(whole, 0.5 * (newer.colour + older.rgb), min(newer_share, older_share));
#endif
}

// Where in its pixel each sample lies, and the sample of a picture that is nearest to a place.
#if SAMPLES == 1
#define sample_at(index) vec2(0.5)
void nearest_sample(vec2 at_px, out ivec2 pixel, out int index) {
    pixel = ivec2(floor(at_px));
    index = 0;
}
#else
uniform vec2 sample_px[SAMPLES];
#define sample_at(index) sample_px[index]
void nearest_sample(vec2 at_px, out ivec2 pixel, out int index) {
    float least = 4.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 whole = floor(at_px - sample_px[i] + 0.5), off = at_px - sample_px[i] - whole;
        float apart = dot(off, off);
        if (apart >= least) continue;
        least = apart;
        pixel = ivec2(whole);
        index = i;
    }
}
#endif

// A sample of the older buffer, and where between samples that what it shows lies that is seen here now, at depth z.
struct Hit {
    ivec2 pixel;
    int index;
    vec2 at_px;
    uint id, level;
    float z;
};
// The older buffer's colour between pixels, of the same thing in a level; and the sample's own order of appearance. is_there: some
// of the pixels round the place show that.
vec4 older_colour(Hit hit, uint level, out bool is_there) {
    vec2 at = hit.at_px - sample_at(gl_SampleID), base = floor(at + 1.0 / 256.0), share = max(at - base, 0.0);
    if (share.x < 1.0 / 128.0) share.x = 0.0;
    if (share.y < 1.0 / 128.0) share.y = 0.0;
    vec4 own = fetch_sample(old_colour, hit.pixel, hit.index);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1), from = ivec2(base) + corner;
        float weight = (corner.x == 1 ? share.x : 1.0 - share.x) * (corner.y == 1 ? share.y : 1.0 - share.y);
        if (weight <= 0.0 || !is_inside(from)) continue;
        uvec2 ids = fetch(old_ids, from).xy;
        if (stored_id(ids.x) != hit.id || ids.y != level) continue;
        sum += weight * fetch(old_colour, from).rgb;
        weights += weight;
    }
    is_there = weights > 0.0;
    return vec4(is_there ? sum / weights : own.rgb, 1.0 - own.a);
}
// Goes after a surface: from a first guess of the depth here to a sample of the older buffer that is seen at this place now. id: the
// only thing that counts, or ~0: anything. Iterative image warping (Yang et al. 2011; Bowles et al. 2012).
bool follow(mat4 old_from_new, mat4 new_from_old, vec2 at_px, float z, uint id, out Hit hit) {
    vec2 clip = clip_of(at_px);
    for (int i = 0; i < 4; ++i) {
        nearest_sample(moved(old_from_new, clip, z).xy, hit.pixel, hit.index);
        if (!is_inside(hit.pixel)) return false;
        uvec2 ids = fetch_sample(old_ids, hit.pixel, hit.index).xy;
        hit.id = stored_id(ids.x);
        hit.level = ids.y;
        if (id != ~0u && hit.id != id) return false;
        float there_z = stored_z(fetch_sample(old_depth, hit.pixel, hit.index).r);
        vec3 here = moved(new_from_old, clip_of(vec2(hit.pixel) + sample_at(hit.index)), there_z);
        vec2 off = abs(here.xy - at_px);
        z = here.z;
        if (max(off.x, off.y) > 0.75) continue;
        hit.z = z;
        hit.at_px = moved(old_from_new, clip, z).xy;
        // There it may be past its outline, which else would reach beyond itself.
        ivec2 pixel;
        int index;
        nearest_sample(hit.at_px, pixel, index);
        bool is_past = id != ~0u && is_inside(pixel) && stored_id(fetch_sample(old_ids, pixel, index).x) != id;
        return !is_past;
    }
    return false;
}
// The same of something under way: from a guess if that is above 0, then wherever between its nearest and its farthest place it
// may be. Most starts meet something else, which one look at what is there says.
bool find(uint entry, Way one, vec2 at_px, float guess_z, out Hit hit) {
    vec2 clip = clip_of(at_px);
    mat4 back = back_of(entry);
    vec4 start = back * vec4(clip, 0.0, 1.0), along = back[2];
    uint id = stored_id(one.id);
    vec2 span = place_px(start + one.near_z * along) - place_px(start + one.far_z * along);
    int steps = clamp(int(ceil(max(abs(span.x), abs(span.y)))), 1, 8);
    for (int i = guess_z > 0.0 ? -1 : 0; i < steps; ++i) {
        float z = i < 0 ? guess_z : mix(one.near_z, one.far_z, (float(i) + 0.5) / float(steps));
        nearest_sample(place_px(start + z * along), hit.pixel, hit.index);
        if (!is_inside(hit.pixel) || stored_id(fetch_sample(old_ids, hit.pixel, hit.index).x) != id) continue;
        if (follow(back, forth_of(entry), at_px, z, id, hit)) return true;
    }
    return false;
}
)";

}  // namespace overlook::discrete::shaders
