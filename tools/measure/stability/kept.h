// Findings kept from an earlier run: one that was broken off goes on where it was, and one that is repeated is done at once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/measure/stability/stage.h"

namespace overlook::measure {

// Of this program's own file, by which a rebuilt one is told from it. Fails as MappedFile::open.
Result<std::string> program_hash();

// The file's name, made from the content of all that decides what is found: program, renderer, scene, flight, the case's
// settings, sizes, and the specs, which are run together.
std::string name_of_findings(const Stage& stage, const Case& each, const scene::Flight& flight,
                             std::span<const MethodSpec> specs);

// Nothing if there is no file, or not one that was kept whole, of `count` findings.
std::optional<std::vector<Finding>> read_findings(const std::string& path, size_t count);
// Fails with Exit::cannot_write.
Result<void> keep_findings(const std::string& path, const std::vector<Finding>& findings);

}  // namespace overlook::measure
