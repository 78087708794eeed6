#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "runtime/command/command.h"

namespace overlook::command {
namespace {

bool is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

bool is_wanted(const Common& common) {
    if (common.quiet || common.progress == "never") return false;
    return common.progress == "always" || is_terminal();
}

constexpr double kRedrawEvery_s = 0.1;

// A file or a pipe gets a line now and then, a terminal the same line again and again.
constexpr double kNewLineEvery_s = 1;

std::string time_left_text(double elapsed_s, double done) {
    double left_s = elapsed_s * (1 - done) / done;
    if (left_s >= 5940) return fmt::format("{:.1f} h left", left_s / 3600);
    if (left_s >= 99) return fmt::format("{:.0f} min left", left_s / 60);
    return fmt::format("{:.0f} s left", left_s);
}

}  // namespace

Progress::Progress(const Common& common, std::string what)
    : shown_(is_wanted(common)), what_(std::move(what)), begin_(std::chrono::steady_clock::now()), last_(begin_) {}

Progress::~Progress() {
    if (shown_ && is_terminal()) std::fputs("\r\x1b[K", stderr);
}

void Progress::set(double done) {
    if (!shown_) return;
    auto now = std::chrono::steady_clock::now();
    double since_last_s = std::chrono::duration<double>(now - last_).count();
    bool in_place = is_terminal();
    if (since_last_s < (in_place ? kRedrawEvery_s : kNewLineEvery_s)) return;
    last_ = now;

    done = std::clamp(done, 0.0, 1.0);
    std::string line = fmt::format("{}: {:.0f} %", what_, std::min(99.0, 100 * done));
    if (done > 0) line += ", " + time_left_text(std::chrono::duration<double>(now - begin_).count(), done);
    std::string whole = in_place ? "\r" + line + "\x1b[K" : line + "\n";
    std::fputs(whole.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace overlook::command
