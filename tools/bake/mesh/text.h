// Numbers and words of a text file, line by line, without copying.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace overlook::mesh {

// Walks a text that may be hostile. Lines end with \n, \r\n or \r.
class Text {
  public:
    explicit Text(std::span<const std::byte> bytes)
        : at_(reinterpret_cast<const char*>(bytes.data())), end_(at_ + bytes.size()) {}

    // Of the place where the next word is read, from 1.
    uint64_t line() const { return line_; }
    bool is_at_end() const { return at_ == end_; }
    size_t bytes_left() const { return size_t(end_ - at_); }
    // Goes past bytes, which are left, and gives where they begin.
    const char* take(size_t count) {
        at_ += count;
        return at_ - count;
    }
    // The next character, 0 at the end.
    char peek() const { return at_ == end_ ? '\0' : *at_; }

    // Whether nothing but spaces is left of this line; goes past the spaces. A backslash before the line's end joins the next.
    bool is_at_line_end();
    // Goes to the beginning of the next line.
    void next_line();
    // Goes to the next line that holds more than spaces and a comment; false at the end of the text. From within a line that
    // still holds something it stays.
    bool find_line(char comment);

    // The next word of this line; empty at its end.
    std::string_view word();
    // The rest of this line without spaces at its ends.
    std::string_view rest();
    // The next word as a number, whole. False, and nothing is read, if there is none. "nan" and "inf" are numbers.
    bool number(double& value);
    bool integer(int64_t& value);
    // Whether a space, a line's end or the text's end is next.
    bool is_at_word_end() const;
    // Goes past one character if it is next.
    bool skip(char c);

  private:
    const char* at_;
    const char* end_;
    uint64_t line_ = 1;
};

// A whole word as a number.
bool number_from(std::string_view word, double& value);

}  // namespace overlook::mesh
