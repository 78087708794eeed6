// All layered depth images of a tile set, into a file.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/bake/wang_ldi/judge.h"
#include "tools/bake/wang_ldi/levels.h"
#include "tools/bake/wang_ldi/rate.h"
#include "tools/bake/wang_ldi/shards.h"
#include "tools/bake/wang_ldi/textures.h"
#include "tools/bake/wang_ldi/trim.h"

namespace overlook::wang_ldi {

struct ImageBake {
    LevelOptions levels;  // the set's tile size, heights and counts are filled in from the planting
    SampleOptions sampling;
    TextureOptions textures;
    Light light;
    uint32_t neighbourhoods = 1;                // that a tile is sampled among, in turn
    bool has_border_images = false;             // besides, each tile alone
    bool has_gloss = true;                      // of samples: as seen from the middle of each image's eyes; else left out
    bool is_covering = true;                    // of samples of thin things as many as cover what they do; else all
    bool is_relit = false;                      // colours unlit, with normals
    uint32_t judged_views = 0;                  // of the cell, as views_of; of each texture one; 0: none is judged
    bool is_timed = false;                      // each image's rays are shot again for nothing else, to fill ImageReport::rate
    uint32_t trial_tiles = 0;                   // only the first so many tiles, and no sections are written; 0: all
    uint64_t memory_bytes = uint64_t(4) << 30;  // for rays: beyond it, a tile and its neighbours are kept as instances
    rays::Instructions instructions = rays::Instructions::best;  // other processors' best hit otherwise in the last bits
    uint64_t seed = 1;
    std::string version;       // of the program: parts of another are not taken
    std::string parts_folder;  // of Shards; empty: nothing is kept
    // Only images and textures, counted one after the other, whose number leaves `part` when divided by part_count; others are
    // not made, and no sections are written. For
    // several machines, which share the folder or bring its files together; their instructions are alike, or `everywhere`.
    uint64_t part = 0, part_count = 1;
};
// What the paper's constants change: levels and directions, 2.5 million rays an image, one neighbourhood, all samples.
void take_paper_constants(ImageBake& bake);

struct ImageRow {
    Which which;
    uint32_t samples = 0;
    uint64_t stored_bytes = 0, rays = 0, hits = 0, eyes = 0;
    double unseen_share = 0;
    Judgement judgement;  // among the neighbours that the tile was sampled among
    Judgement foreign;    // among others, where others fit
};
struct TextureRow {
    uint64_t rays = 0, hits = 0, eyes = 0;
    double unseen_share = 0, standard_error = 0;
    TextureJudgement judgement;
};
struct ImageReport {
    ImageSet set;
    std::vector<ImageRow> rows;        // in the order of index_of; none of a part
    std::vector<TextureRow> textures;  // in the order of TextureSet::index_of; likewise
    uint32_t texture_side_px = 0;
    uint64_t made = 0;              // images and textures that were baked anew
    uint64_t taken_from_parts = 0;  // those that were there
    uint64_t above_goal = 0;        // of rows: those with more unseen than was asked for, after the most rays that are shot
    double seconds = 0;
    Rate rate;                 // of what was made, where it is timed
    uint32_t trial_tiles = 0;  // as was asked
    TrimReport leaves;         // of the models, filled in by whoever read them
    Shards parts;              // to be removed (remove_all(part_count)) when the file is committed
    uint64_t part_count = 0;
};

// How low and how high anything stands on the tiles, at least 0.1 m apart.
glm::dvec2 heights_of(const Models& models, const Planting& planting);

// Adds the sections WLDS and WLDI, and WLDT if there are textures (unless it is a part or a trial). planting.models are
// models.meshes, one by one. A pure function of all but parts_folder, whatever the number of threads (and, of Instructions::best,
// of the processor's instruction set). `progress` is called with the share done, 0..1, from this thread. Fails as leveled() and
// stage_of() do, with Exit::impossible if memory does not suffice, and as the writer does.
Result<ImageReport> bake_images(container::Writer& writer, const TileSet& tiles, const Planting& planting, const Models& models,
                                const ImageBake& bake, const std::function<void(double)>& progress);

}  // namespace overlook::wang_ldi
