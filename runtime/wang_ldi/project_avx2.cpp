// Compiled for processors with AVX2, where those are x86-64.
#include "runtime/wang_ldi/project_lanes.h"

namespace overlook::wang_ldi {

void project_samples_avx2(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out, ProjectedCounts& counts) {
    project_lanes(frame, samples, out, counts);
}

}  // namespace overlook::wang_ldi
