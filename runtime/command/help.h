// How --help is laid out.
#pragma once

#include <string>

namespace overlook::command {

// CLI11 leaves long descriptions on one line; this breaks them at blanks so that no line is longer than 100 columns. What goes on
// stands under where it began: in the column of descriptions (30) for options and subcommands, in the first column elsewhere.
std::string wrapped_help(const std::string& help);

}  // namespace overlook::command
