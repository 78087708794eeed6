#include "runtime/wang_ldi/plant_sift_lanes.h"

namespace overlook::wang_ldi {

const PlantLoops kPlantLoopsAnywhere{place_lanes, sift_lanes};

const PlantLoops& best_plant_loops() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return kPlantLoopsAvx2;
#endif
    return kPlantLoopsAnywhere;
}

}  // namespace overlook::wang_ldi
