#include "tests/cli/run_command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace overlook::cli {
namespace {

[[noreturn]] void become(const std::vector<std::string>& words, const Limits& limits, int out, int err) {
    int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO), dup2(out, STDOUT_FILENO), dup2(err, STDERR_FILENO);
    if (limits.file_bytes > 0) {
        struct rlimit limit {};
        limit.rlim_cur = limit.rlim_max = limits.file_bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::string program = std::string(OVERLOOK_BINARY_DIR "/bin/") + words[0];
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    _exit(127);
}

// Reads both to their ends, whichever speaks first.
void read_both(int out, int err, Ran& ran) {
    pollfd ends[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* texts[2] = {&ran.out, &ran.err};
    for (int open_ends = 2; open_ends > 0;) {
        if (poll(ends, 2, -1) < 0 && errno != EINTR) throw std::runtime_error("poll");
        for (int i = 0; i < 2; ++i) {
            if (ends[i].fd < 0 || ends[i].revents == 0) continue;
            char part[65536];
            ssize_t count = read(ends[i].fd, part, sizeof part);
            if (count > 0) {
                texts[i]->append(part, size_t(count));
            } else {
                ends[i].fd = -1, --open_ends;
            }
        }
    }
}

}  // namespace

Running::Running(const std::vector<std::string>& words, const Limits& limits) {
    int out[2], err[2];
    if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("pipe2");
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("fork");
    if (process_ == 0) become(words, limits, out[1], err[1]);
    close(out[1]), close(err[1]);
    out_ = out[0], err_ = err[0];
}

Running::~Running() {
    if (!has_ended_) {
        kill(process_, SIGKILL);
        waitpid(process_, &status_, 0);
    }
    close(out_), close(err_);
}

void Running::send(int signal) {
    if (!has_ended_) kill(process_, signal);
}

bool Running::stop() {
    send(SIGSTOP);
    if (!has_ended_ && waitpid(process_, &status_, WUNTRACED) == process_) has_ended_ = !WIFSTOPPED(status_);
    return !has_ended_;
}

Ran Running::wait() {
    Ran ran;
    read_both(out_, err_, ran);
    if (!has_ended_) waitpid(process_, &status_, 0);
    has_ended_ = true;
    if (WIFSIGNALED(status_)) ran.signal = WTERMSIG(status_);
    if (WIFEXITED(status_)) ran.exit = WEXITSTATUS(status_);
    return ran;
}

Ran run(const std::vector<std::string>& words, const Limits& limits) {
    return Running(words, limits).wait();
}

void expect_refusal(const Ran& ran, int exit, const std::string& name, const std::vector<std::string>& parts) {
    EXPECT_EQ(ran.exit, exit) << ran.err;
    EXPECT_EQ(ran.signal, 0);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(!ran.err.empty() && ran.err.back() == '\n') << ran.err;
    EXPECT_EQ(ran.err.rfind(name + ": ", 0), 0u) << ran.err;
    for (const std::string& part : parts)
        EXPECT_NE(ran.err.find(part), std::string::npos) << "\"" << part << "\" is not in: " << ran.err;
}

void expect_done(const Ran& ran) {
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.signal, 0) << ran.err;
}

void write_text(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::set<std::string> contents_of(const std::string& folder) {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        std::string text;
        if (entry.is_regular_file()) {
            std::ifstream file(entry.path(), std::ios::binary);
            text.assign(std::istreambuf_iterator<char>(file), {});
        }
        all.insert(entry.path().string() + "\n" + text);
    }
    return all;
}

std::string dem_folder() {
    const char* data = std::getenv("OVERLOOK_DATA");
    return data != nullptr && *data != 0 ? std::string(data) + "/dem/" : "";
}

}  // namespace overlook::cli
