// reproduce lod-sprite: flies what section 4 of the LOD-sprite paper flies, and writes its figures anew.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"
#include "runtime/command/command.h"

namespace overlook::measure::paper::sprite {

struct PaperOptions {
    std::string folder, out, size = "512x512";
    std::vector<std::string> methods{"lod-sprite:paper", "lod-sprite"};
    std::vector<double> thresholds_px{0.25, 0.5, 1, 2, 4, 8};
    uint32_t frames = 600, remedy_frames = 90, held_parts = 5;
    bool has_no_sweeps = false;
};

// Adds "lod-sprite" to `app`.
CLI::App* add_verb(CLI::App& app, PaperOptions& options);

// words: the command as it was typed. Says what it measured on stderr. Fails as what it reads and writes.
Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common);

}  // namespace overlook::measure::paper::sprite
