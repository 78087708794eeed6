#include "tools/bake/wang_ldi/rate.h"

#include <ctime>

namespace overlook::wang_ldi {

void Rate::add(const Rate& other) {
    rays += other.rays, shadow_rays += other.shadow_rays;
    sampled_s += other.sampled_s, bare_s += other.bare_s, lit_s += other.lit_s, bare_shadow_s += other.bare_shadow_s;
}

double thread_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double bare_s(std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options, uint64_t eyes) {
    double seconds = 0;
    Eye one;
    std::vector<rays::Hit> found;
    for (uint64_t eye = 0; eye < eyes; ++eye) {
        set_eye(wedge, options.seed, eye, rays_per_eye(wedge, options), one);
        found.resize(one.rays.size());
        double begin = thread_s();
        stages[eye % stages.size()].scene.first_hits(one.rays, found);
        seconds += thread_s() - begin;
    }
    return seconds;
}

double bare_shadow_s(std::span<const TraceStage> stages, std::span<const std::vector<rays::Ray>> asked) {
    double seconds = 0;
    std::vector<uint8_t> blocked;
    for (size_t s = 0; s < asked.size(); ++s) {
        blocked.resize(asked[s].size());
        double begin = thread_s();
        stages[s].scene.are_blocked(asked[s], blocked);
        seconds += thread_s() - begin;
    }
    return seconds;
}

}  // namespace overlook::wang_ldi
