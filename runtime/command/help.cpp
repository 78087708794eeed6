#include "runtime/command/help.h"

#include <sstream>

namespace overlook::command {
namespace {

constexpr size_t kColumns = 100;
constexpr size_t kDescriptionColumn = 30;

// Where a line of at most kColumns ends; npos if no blank after `indent` lets it.
size_t break_of(const std::string& line, size_t indent) {
    size_t at = line.rfind(' ', kColumns);
    return at != std::string::npos && at > indent ? at : std::string::npos;
}

}  // namespace

std::string wrapped_help(const std::string& help) {
    std::istringstream lines(help);
    std::string line, all;
    while (std::getline(lines, line)) {
        size_t indent = line.rfind(' ', 0) == 0 ? kDescriptionColumn : 0;
        while (line.size() > kColumns) {
            size_t at = break_of(line, indent);
            if (at == std::string::npos) break;
            all += line.substr(0, at) + "\n";
            line = std::string(indent, ' ') + line.substr(at + 1);
        }
        all += line + "\n";
    }
    return all;
}

}  // namespace overlook::command
