// How fast images are sampled and lit, beside a bare loop over the very same rays by the same packets of rays::Scene: what all
// that is not tracing costs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/bake/wang_ldi/sample.h"

namespace overlook::wang_ldi {

// Seconds of processor time, of the threads that did the work. What decides which samples are kept (covering) is in none.
struct Rate {
    uint64_t rays = 0, shadow_rays = 0;
    double sampled_s = 0;      // sampled(): eyes, rays, what is met, kept by cube
    double bare_s = 0;         // the same rays against the same triangles, and nothing else
    double lit_s = 0;          // lit_samples()
    double bare_shadow_s = 0;  // its rays, and nothing else

    void add(const Rate& other);
    // Of the rate of the bare loop: 0..1, but for what is measured inexactly; 0 if nothing was shot.
    double sampling_share() const { return sampled_s > 0 ? bare_s / sampled_s : 0; }
    double share() const { return sampled_s + lit_s > 0 ? (bare_s + bare_shadow_s) / (sampled_s + lit_s) : 0; }
};

// Processor time that the calling thread has taken.
double thread_s();

// How long first_hits takes for the rays of the first `eyes` eyes of sampled() with these arguments, which are made beforehand
// and not counted.
double bare_s(std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options, uint64_t eyes);
// How long are_blocked takes for asked[s], rays of stages[s], all together.
double bare_shadow_s(std::span<const TraceStage> stages, std::span<const std::vector<rays::Ray>> asked);

}  // namespace overlook::wang_ldi
