// To be put into the fragment shader of whatever changes level (Scherzer and Wimmer 2008, 3.3). rest_m: the fragment's place on the
// thing before any animation, metres; grain_m: of the texture's repeat; share: of the level that is visible, 0..1.
uniform sampler2D visibility;
bool is_visible(vec3 rest_m, float grain_m, float share) {
    return texture(visibility, (rest_m.xy + rest_m.z) / grain_m).r < share;
}
