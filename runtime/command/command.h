// What all commands share: their common options, their one-line messages, their exit codes, their progress. The only part of
// Overlook that prints or ends a process.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "formats/result.h"

// Who adds options includes <CLI/CLI.hpp>, which takes a compiler longer than most sources; who only says something need not.
namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace overlook::command {

struct Common {
    unsigned threads = 0;       // 0 = all; never changes the bytes
    uint64_t memory_bytes = 0;  // 0 = no cap
    uint64_t seed = 1;
    bool json = false;   // a report in JSON on stdout
    bool quiet = false;  // no talk; errors are still said
    bool verbose = false;
    std::string progress = "auto";
};

enum class Uses { none = 0, seed = 1, memory = 2 };
constexpr Uses operator|(Uses a, Uses b) {
    return Uses(int(a) | int(b));
}

// An option of bytes: digits, or with K, M, G, T (powers of 1024).
CLI::Option* add_bytes_option(CLI::App& app, const std::string& name, uint64_t& bytes, const std::string& help);

// Adds --threads, --json, --quiet, --verbose, --progress, --config (and --seed, --memory where used) to a command.
void add_common(CLI::App& app, Common& common, Uses uses = Uses::none);

// For CLI::Option::check: a number from least to most. Unlike CLI::Range it refuses NaN: "--error-m: nan is not a number from 0
// to 1e+06".
CLI::Validator number_in(double least, double most);

// Parses and runs: maps CLI11's errors to exit 2 with one line on stderr, --help and --version to 0; applies --threads;
// installs the signal handlers that leave nothing half-written; catches what escapes as our bug (70).
int run(CLI::App& app, Common& common, int argc, char** argv, const std::function<int()>& body);

// Of Overlook: "0.1.0".
std::string version();

// Says "NAME: MESSAGE" on stderr and returns the error's exit code.
int fail(const std::string& name, const Error& error);

// Lines to stderr unless --quiet (note), or only with --verbose (detail).
void note(const Common& common, const std::string& line);
void detail(const Common& common, const std::string& line);

// A line with share done and time left, redrawn in place on a terminal; nothing in a pipe unless --progress always.
class Progress {
  public:
    Progress(const Common& common, std::string what);
    ~Progress();
    void set(double done);  // 0..1, from one thread

  private:
    bool shown_ = false;
    std::string what_;
    std::chrono::steady_clock::time_point begin_, last_;
};

}  // namespace overlook::command
