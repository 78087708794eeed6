// reproduce wang-ldi: makes what the figures of the paper on tiling layered depth images show, from baked plants.
#pragma once

#include <string>
#include <vector>

#include "formats/result.h"
#include "runtime/command/command.h"
#include "tools/measure/paper/wang_ldi/flown_fields.h"

namespace overlook::measure::paper::wang {

struct PaperOptions {
    FieldOptionsAsked fields;
    bool is_coarse = false;  // what was baked: said on the page
    std::string size = "640x480", judged_size = "320x240";
    std::vector<std::string> folders;
    std::string out;
};

// Adds "wang-ldi" to `app`.
CLI::App* add_verb(CLI::App& app, PaperOptions& options);

// words: the command as it was typed. Says what it measured on stderr. Needs OpenGL where a folder has scenes. Fails as what it
// reads and writes.
Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common);

}  // namespace overlook::measure::paper::wang
