// Compiled for processors with AVX2, where those are x86-64.
#include "runtime/wang_ldi/plant_sift_lanes.h"

namespace overlook::wang_ldi {

const PlantLoops kPlantLoopsAvx2{place_lanes, sift_lanes};

}  // namespace overlook::wang_ldi
