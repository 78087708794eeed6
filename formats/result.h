// How Overlook says that something went wrong: a value, never an exception, and never a print.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace overlook {

// The exit codes of every command. A library chooses one by the cause; a command only passes it on.
enum class Exit : int {
    done = 0,
    answer_is_no = 1,  // verify, diff: the question was understood and the answer is no
    bad_command = 2,   // the command line makes no sense
    bad_input = 3,     // an input is missing, unreadable or breaks its form
    cannot_write = 4,  // an output cannot be written
    impossible = 5,    // cannot be done within the limits asked
    our_bug = 70,
};

// One line for a person: what was read or written, where in it, what is wrong, and a way out where there is one.
struct Error {
    Exit exit = Exit::our_bug;
    std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

// Each makes an error of its cause from a fmt format string: `return bad_input("{}: is empty", path);`
template <class... Args>
tl::unexpected<Error> bad_input(fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected(Error{Exit::bad_input, fmt::format(text, std::forward<Args>(args)...)});
}
template <class... Args>
tl::unexpected<Error> cannot_write(fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected(Error{Exit::cannot_write, fmt::format(text, std::forward<Args>(args)...)});
}
template <class... Args>
tl::unexpected<Error> bad_command(fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected(Error{Exit::bad_command, fmt::format(text, std::forward<Args>(args)...)});
}
template <class... Args>
tl::unexpected<Error> impossible(fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected(Error{Exit::impossible, fmt::format(text, std::forward<Args>(args)...)});
}

}  // namespace overlook
