#include "runtime/wang_ldi/project_lanes.h"

namespace overlook::wang_ldi {

void project_samples_anywhere(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out,
                              ProjectedCounts& counts) {
    project_lanes(frame, samples, out, counts);
}

ProjectSamples best_project_samples() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return project_samples_avx2;
#endif
    return project_samples_anywhere;
}

}  // namespace overlook::wang_ldi
