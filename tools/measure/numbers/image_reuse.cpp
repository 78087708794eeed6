#include "tools/measure/numbers/image_reuse.h"

#include <cassert>

namespace overlook::measure {

ReuseErrors reuse_errors(std::span<const uint8_t> surface, std::span<const uint8_t> used, std::span<const uint8_t> visible) {
    assert(surface.size() == used.size() && surface.size() == visible.size());
    ReuseErrors errors;
    for (size_t i = 0; i < surface.size(); ++i) {
        if (!surface[i]) continue;
        ++errors.surface_px;
        errors.ghosts_px += used[i] && !visible[i];
        errors.losses_px += !used[i] && visible[i];
    }
    if (errors.surface_px > 0) {
        errors.ghost_share = double(errors.ghosts_px) / double(errors.surface_px);
        errors.loss_share = double(errors.losses_px) / double(errors.surface_px);
    }
    return errors;
}

}  // namespace overlook::measure
