// To be put into a full-screen pass (the same, 3.4). Each buffer holds the colour and, in 32 bits each, depth (near 1, far 0) and the
// id of what changes level, 0 of all else. old_from_new: clip coordinates of the older frame from those of the newer one.
uniform sampler2D new_colour, old_colour;
uniform sampler2D new_depth, old_depth;
uniform usampler2D new_id, old_id;
uniform mat4 old_from_new;
vec4 combined(ivec2 at, ivec2 size) {
    vec4 newer = texelFetch(new_colour, at, 0);
    float z = texelFetch(new_depth, at, 0).r;
    vec4 there = old_from_new * vec4(2.0 * (vec2(at) + 0.5) / vec2(size) - 1.0, z, 1.0);
    ivec2 from = ivec2(floor((0.5 * there.xy / there.w + 0.5) * vec2(size)));
    if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, size))) return newer;
    uint id = texelFetch(new_id, at, 0).r, old = texelFetch(old_id, from, 0).r;
    if (id == 0u && old == 0u) return newer;
    vec4 older = texelFetch(old_colour, from, 0);
    if (id == old) return 0.5 * (newer + older);
    return texelFetch(old_depth, from, 0).r > z ? older : newer;
}
