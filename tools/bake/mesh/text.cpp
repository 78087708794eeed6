// Words and numbers of text files.

#include "tools/bake/mesh/text.h"

#include <charconv>
#include <limits>

namespace overlook::mesh {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

// from_chars does not know a plus sign; too large or too small for a double is an infinity or zero, as strtod has it.
const char* read_double(const char* begin, const char* end, double& value) {
    const char* digits = begin != end && *begin == '+' ? begin + 1 : begin;
    if (digits != begin && digits != end && *digits == '-') return nullptr;
    const auto [stop, problem] = std::from_chars(digits, end, value);
    if (problem == std::errc::invalid_argument) return nullptr;
    if (problem == std::errc::result_out_of_range) {
        const std::string_view word(digits, size_t(stop - digits));
        const size_t exponent = word.find_first_of("eE");
        const bool is_small = exponent != std::string_view::npos ? word.substr(exponent).find('-') != std::string_view::npos
                                                                 : word.find_first_of("123456789") > word.find('.');
        value = is_small ? 0 : std::numeric_limits<double>::infinity();
        if (*digits == '-') value = -value;
    }
    return stop;
}

}  // namespace

bool Text::is_at_line_end() {
    for (;;) {
        while (at_ != end_ && is_space(*at_)) ++at_;
        if (at_ == end_) return true;
        if (*at_ != '\\') return is_line_end(*at_);
        const char* next = at_ + 1;
        if (next == end_ || !is_line_end(*next)) return false;
        next_line();
    }
}

void Text::next_line() {
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
    if (at_ == end_) return;
    const bool is_pair = *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n';
    at_ += is_pair ? 2 : 1;
    ++line_;
}

bool Text::find_line(char comment) {
    while (!is_at_end()) {
        if (!is_at_line_end() && *at_ != comment) return true;
        next_line();
    }
    return false;
}

std::string_view Text::word() {
    if (is_at_line_end()) return {};
    const char* begin = at_;
    while (at_ != end_ && !is_space(*at_) && !is_line_end(*at_)) ++at_;
    return {begin, size_t(at_ - begin)};
}

std::string_view Text::rest() {
    if (is_at_line_end()) return {};
    const char* begin = at_;
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
    const char* stop = at_;
    while (stop != begin && is_space(stop[-1])) --stop;
    return {begin, size_t(stop - begin)};
}

bool Text::number(double& value) {
    if (is_at_line_end()) return false;
    const char* stop = read_double(at_, end_, value);
    if (!stop || (stop != end_ && !is_space(*stop) && !is_line_end(*stop))) return false;
    at_ = stop;
    return true;
}

bool Text::integer(int64_t& value) {
    if (is_at_line_end()) return false;
    const char* digits = *at_ == '+' ? at_ + 1 : at_;
    const auto [stop, problem] = std::from_chars(digits, end_, value);
    if (problem != std::errc()) return false;
    at_ = stop;
    return true;
}

bool Text::is_at_word_end() const {
    return at_ == end_ || is_space(*at_) || is_line_end(*at_);
}

bool Text::skip(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
}

bool number_from(std::string_view word, double& value) {
    return read_double(word.data(), word.data() + word.size(), value) == word.data() + word.size() && !word.empty();
}

}  // namespace overlook::mesh
