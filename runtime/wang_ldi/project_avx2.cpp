// Compiled for processors with AVX2, where those are x86-64.
#include "runtime/wang_ldi/project_lanes.h"

namespace overlook::wang_ldi {

void project_samples_avx2(const RowFrame& row, const uint32_t* places, const uint8_t* splats, uint32_t count, const Projected& out, ProjectedCounts& counts) {
    project_lanes(row, places, splats, count, out, counts);
}

}  // namespace overlook::wang_ldi
