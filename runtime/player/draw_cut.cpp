#include "runtime/player/draw_cut.h"

#include "runtime/gl/timer.h"

namespace overlook::player {

void draw_cut(terrain::Drawing& drawing, const gl::Target& target, const terrain::Cut& cut, const view::Camera& camera,
              const terrain::DrawOptions& look, FrameRecord& record) {
    gl::Timer timer;
    drawing.draw(target, cut, camera, look);
    record.draw_ms = timer.finished_ms();
    record.triangle_count = cut.triangle_count();
    record.void_rim_triangle_count = cut.void_rim_triangle_count;
    record.tested_count = cut.tested_count;
    record.predicted_error_px = cut.predicted_error_px;
    record.uploaded_bytes = drawing.uploaded_bytes();
}

}  // namespace overlook::player
