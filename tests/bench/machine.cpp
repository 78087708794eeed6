#include "tests/bench/machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

namespace overlook::bench {
namespace {

std::string without(std::string text, const std::string& part) {
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part)) text.erase(at, part.size());
    return text;
}

}  // namespace

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

unsigned core_count() {
    return std::max(1u, std::thread::hardware_concurrency());
}

std::string machine_kind(const std::string& processor, unsigned cores) {
    std::string small;
    for (char c : processor) small += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    for (const char* mark : {"(r)", "(tm)", "(c)"}) small = without(small, mark);

    std::string kind;
    for (char c : small + " " + std::to_string(cores) + " cores") {
        bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (is_plain) kind += c;
        if (!is_plain && !kind.empty() && kind.back() != '-') kind += '-';
    }
    return kind;
}

void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) * 1024 / 1e6;
    return 0;
}

}  // namespace overlook::bench
