// Everything a run leaves behind: tables, charts, pictures, the page.
#pragma once

#include <string>

#include "runtime/command/command.h"
#include "tools/measure/run.h"
#include "tools/measure/tables.h"

namespace overlook::measure {

// Writes frames.csv, runs.csv, honesty.csv, runs.json, the charts, the pictures of the worst frames and index.html into `folder`,
// which must be there; prints runs.json with --json. Without gnuplot the charts are left out, which is said. Fails with
// Exit::cannot_write.
Result<void> deliver(const CourseResult& course, const RunSetup& setup, const std::string& folder, const command::Common& common);

}  // namespace overlook::measure
