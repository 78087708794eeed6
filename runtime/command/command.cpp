#include "runtime/command/command.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>

#include "formats/parallel.h"
#include "runtime/command/help.h"
#include "runtime/command/memory.h"
#include "runtime/command/options.h"
#include "runtime/command/signals.h"

namespace overlook::command {
namespace {

// Names come from outside; none of them breaks the rule of one line a message.
std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

void say(const std::string& line) {
    std::string whole = one_line(line) + "\n";
    std::fputs(whole.c_str(), stderr);
    std::fflush(stderr);
}

// The command as the user typed it: "bake-lod terrain".
std::string full_name(const CLI::App& app, const char* typed) {
    std::string name = app.get_name();
    if (name.empty() && typed != nullptr) name = std::string(typed).substr(std::string(typed).rfind('/') + 1);
    for (const CLI::App* chosen : app.get_subcommands()) name += " " + chosen->get_name();
    return name;
}

// A result that did not reach its reader is not a result.
int flush_output(const std::string& name, int exit_code) {
    errno = 0;
    std::cout.flush();
    bool is_whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (is_whole) return exit_code;
    std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
    return fail(name, Error{Exit::cannot_write, "standard output: cannot write" + reason});
}

// A command without its verb, or with one that is not there.
std::string missing_verb_text(const CLI::App& app) {
    std::string verbs;
    for (const CLI::App* verb : app.get_subcommands(nullptr)) verbs += (verbs.empty() ? "" : ", ") + verb->get_name();
    std::vector<std::string> extras = app.remaining(true);
    if (extras.empty()) return "a verb is wanted: " + verbs;
    return "\"" + extras.front() + "\" is not one of its verbs: " + verbs;
}

std::string parse_error_text(const CLI::App& app, const CLI::ParseError& error) {
    std::string text = error.what();
    bool wants_verb = app.get_require_subcommand_min() > 0 && app.get_subcommands().empty();
    if (wants_verb && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing_verb_text(app);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return text;
    std::vector<std::string> extras = app.remaining(true);
    if (extras.empty()) return text;
    std::string near = nearest_name(app, extras.front());
    text = "\"" + extras.front() + "\" was not expected";
    return near.empty() ? text + "; --help lists what is" : text + "; did you mean " + near + "?";
}

// Returns the exit code of a command line that is not to be run.
int answer_parse_error(CLI::App& app, const std::string& name, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::CallForHelp*>(&error) != nullptr) {
        std::cout << wrapped_help(app.help());
        return flush_output(name, int(Exit::done));
    }
    if (dynamic_cast<const CLI::CallForVersion*>(&error) != nullptr) {
        std::cout << error.what() << "\n";
        return flush_output(name, int(Exit::done));
    }
    bool file_is_missing = dynamic_cast<const CLI::FileError*>(&error) != nullptr;
    return fail(name, Error{file_is_missing ? Exit::bad_input : Exit::bad_command, parse_error_text(app, error)});
}

}  // namespace

int run(CLI::App& app, Common& common, int argc, char** argv, const std::function<int()>& body) {
    install_signal_handlers();
    std::string name = full_name(app, argc > 0 ? argv[0] : nullptr);
    try {
        if (app.get_version_ptr() == nullptr) app.set_version_flag("--version", version_line());
        app.parse(argc, argv);
        name = full_name(app, argv[0]);
        set_thread_count(common.threads);
        if (common.memory_bytes != 0) {
            if (Result<void> kept = keep_memory_cap(common.memory_bytes); !kept) return fail(name, kept.error());
        }
        return flush_output(name, body());
    } catch (const CLI::ParseError& error) {
        return answer_parse_error(app, full_name(app, argc > 0 ? argv[0] : nullptr), error);
    } catch (const std::bad_alloc&) {
        return fail(name,
                    Error{Exit::impossible, common.memory_bytes != 0 ? "needs more than --memory allows" : "out of memory"});
    } catch (const std::exception& error) {
        return fail(name, Error{Exit::our_bug, std::string("internal error: ") + error.what()});
    } catch (...) {
        return fail(name, Error{Exit::our_bug, "internal error: an exception of an unknown kind"});
    }
}

std::string version() {
    return OVERLOOK_VERSION;
}

int fail(const std::string& name, const Error& error) {
    say(name + ": " + error.message);
    return int(error.exit);
}

void note(const Common& common, const std::string& line) {
    if (!common.quiet) say(line);
}

void detail(const Common& common, const std::string& line) {
    if (common.verbose && !common.quiet) say(line);
}

}  // namespace overlook::command
