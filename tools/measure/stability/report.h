// The suite's verdicts as JSON and as a page.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/stability/suite.h"
#include "tools/measure/tables.h"

namespace overlook::measure {

// stability.json: schema samples/schema/stability.schema.json.
std::string stability_json(const SuiteResult& result, const RunSetup& setup, const Stage& stage);

// index.html: one file without scripts or anything from elsewhere; links are relative to its folder.
std::string stability_html(const SuiteResult& result, const RunSetup& setup, const Stage& stage);

// Writes both, and the pictures they name, into a folder that is there. Fails with Exit::cannot_write.
Result<void> write_report(const SuiteResult& result, const RunSetup& setup, const Stage& stage, const std::string& folder);

}  // namespace overlook::measure
