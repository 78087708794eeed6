// reproduce fsi: flies what section 4 of the paper on frame-sequential interpolation flies, and writes its figures anew.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"
#include "runtime/command/command.h"

namespace overlook::measure::paper::fsi {

struct PaperOptions {
    std::vector<std::string> folders;
    std::string out;
    uint32_t frames = 8;
    bool flies_many = false;
};

// Adds "fsi" to `app`.
CLI::App* add_verb(CLI::App& app, PaperOptions& options);

// words: the command as it was typed. Says what it measured on stderr. Fails as what it reads and writes.
Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common);

}  // namespace overlook::measure::paper::fsi
