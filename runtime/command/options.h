// What command.cpp and options.cpp share; no other room needs it.
#pragma once

#include <string>

#include "runtime/command/command.h"

namespace overlook::command {

// The version as --version prints it: "overlook 0.1.0".
std::string version_line();

// The option or subcommand of `app` and of its chosen subcommands that is spelt most like `word`; empty if none is near.
std::string nearest_name(const CLI::App& app, const std::string& word);

}  // namespace overlook::command
