// The seam to gnuplot, a program of its own.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "formats/atomic_file.h"
#include "tools/measure/charts.h"

namespace overlook::measure {
namespace {

struct Form {
    const char* kind;
    const char* suffix;
    int width_px, height_px;
};
constexpr std::array<Form, 3> kForms = {Form{"svg", ".svg", 900, 540}, Form{"svg", "-narrow.svg", 420, 520},
                                        Form{"png", ".png", 1200, 720}};
constexpr int kNotInstalled = 127;

// Runs gnuplot in a folder, silent; its exit status, kNotInstalled where it is not there.
int run_gnuplot(const std::string& folder, const std::string& settings, const std::string& script) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::array<std::string, 5> words = {"gnuplot", "-d", "-e", settings, script};
    std::array<char*, 6> arguments{};
    for (size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
    pid_t process = 0;
    int problem = posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) return kNotInstalled;
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Draws under a hidden name first, so that a chart appears whole.
Result<bool> draw(const Chart& chart, const Form& form, const std::string& folder) {
    std::string name = chart.name + form.suffix, hidden = "." + name + ".tmp", script = chart.name + ".gp";
    std::string settings =
        fmt::format("kind='{}'; width={}; height={}; to='{}'", form.kind, form.width_px, form.height_px, hidden);
    int status = run_gnuplot(folder, settings, script);
    if (status == kNotInstalled) return false;
    std::error_code problem;
    if (status == 0) std::filesystem::rename(folder + "/" + hidden, folder + "/" + name, problem);
    if (status == 0 && !problem) return true;
    std::filesystem::remove(folder + "/" + hidden, problem);
    return impossible("{}/{}: gnuplot cannot draw it (status {}); run gnuplot on it to see why", folder, script, status);
}

}  // namespace

Result<bool> draw_charts(const std::vector<Chart>& charts, const std::string& folder) {
    std::string charts_folder = folder + "/charts";
    std::error_code problem;
    std::filesystem::create_directories(charts_folder, problem);
    if (problem) return cannot_write("{}: cannot make the folder: {}", charts_folder, problem.message());
    for (const Chart& chart : charts) {
        if (Result<void> written = write_file(charts_folder + "/" + chart.name + ".gp", std::string_view(chart.script));
            !written) {
            return tl::unexpected(written.error());
        }
    }
    for (const Chart& chart : charts) {
        for (const Form& form : kForms) {
            Result<bool> drawn = draw(chart, form, charts_folder);
            if (!drawn || !*drawn) return drawn;
        }
    }
    return true;
}

}  // namespace overlook::measure
