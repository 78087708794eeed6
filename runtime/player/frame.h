// One frame of the player: how it is to be drawn, and what it was.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/caveclod/draw_frames.h"
#include "runtime/discrete/draw_frames.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/player/method.h"
#include "runtime/stream/stream.h"
#include "runtime/terrain/draw.h"
#include "runtime/wang_ldi/draw_frames.h"

namespace overlook::player {

// Of a frame of what is streamed.
struct StreamRecord {
    stream::Counts counts;
    uint64_t budget_bytes = 0;
    uint64_t stopped_count = 0;  // of a terrain: triangles coarser than asked, because what is finer is not there
    uint32_t block_count = 0, resident_block_count = 0;  // of a mesh; what it lacks is FrameCounts::missing_px
    std::vector<Error> faults;                           // of blocks that cannot be read, each once
};

// What one frame was and what it cost.
struct FrameRecord {
    uint64_t triangle_count = 0;
    uint64_t void_rim_triangle_count = 0;
    uint64_t tested_count = 0;
    uint64_t uploaded_bytes = 0;
    double refine_ms = 0;
    double draw_ms = 0;         // submitting and waiting until it is drawn
    double asked_error_px = 0;  // above --error-px where a budget forces it
    double predicted_error_px = 0;
    // Of a frame by LOD-sprite, whose predicted error is the p99 over the pixels.
    std::optional<lod_sprite::FrameCounts> sprite;
    std::optional<caveclod::FrameCounts> mesh;      // of a mesh that is refined
    std::optional<discrete::FrameCounts> chain;     // of instances of a chain
    std::optional<wang_ldi::FrameCounts> planting;  // of planted ground
    std::optional<StreamRecord> stream;
};

// How a frame is to be drawn.
struct FrameStyle {
    Method method = Method::terrain;
    Thing thing = Thing::terrain;
    double error_px = 1;
    double morph = 0;            // of terrain, as Refiner::cut_by_pixels
    bool shows_sources = false;  // of lod-sprite: what is sprite and what is not; of wang-ldi: levels and directions
    terrain::DrawOptions look;   // lod-sprite: of the shaded picture all but the wireframe; a mesh: the wireframe alone
    double dt_s = 1.0 / 60;      // since the frame before
    // Of a frame, of methods that keep them by themselves (keeps_triangles); 0 = as many as the error takes. most_ms: of discrete.
    uint64_t most_triangles = 0;
    double most_ms = 0;
    bool is_pipelined = false;  // of wang-ldi, as FrameOptions
};

}  // namespace overlook::player
