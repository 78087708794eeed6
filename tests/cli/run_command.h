// Runs Overlook's commands as a person's shell would, without a shell.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace overlook::cli {

struct Limits {
    uint64_t file_bytes = 0;  // RLIMIT_FSIZE; 0 = none
};

struct Ran {
    int exit = -1;  // -1 if a signal ended it
    int signal = 0;
    std::string out, err;
};

// A command that is running: words[0] is a name in this build's bin folder, stdin is empty, stdout and stderr are pipes.
class Running {
  public:
    explicit Running(const std::vector<std::string>& words, const Limits& limits = {});
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running();  // kills it if it was not waited for

    void send(int signal);
    // Stops it and waits until it has stopped; false if it has ended before. send(SIGCONT) lets it go on.
    bool stop();
    Ran wait();

  private:
    pid_t process_ = -1;
    int out_ = -1, err_ = -1;
    int status_ = 0;
    bool has_ended_ = false;
};

Ran run(const std::vector<std::string>& words, const Limits& limits = {});

// Fails the test unless the command ended with `exit`, silent on stdout, with exactly one line on stderr that begins with "NAME:
// " and holds all of `parts`.
void expect_refusal(const Ran& ran, int exit, const std::string& name, const std::vector<std::string>& parts);

// Fails the test unless the command ended with 0; says what it said otherwise.
void expect_done(const Ran& ran);

void write_text(const std::string& path, const std::string& text);

// Every file and folder below a folder, files with their content: equal before and after means that nothing was touched.
std::set<std::string> contents_of(const std::string& folder);

// The folder of real elevation models with '/' at its end; empty without OVERLOOK_DATA.
std::string dem_folder();

}  // namespace overlook::cli
