// A C++ source as the rules see it: its includes, and its words outside comments and strings.
#include <cctype>

#include "tests/layering/layering.h"

namespace overlook::layering {
namespace {

bool is_word_start(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool is_word_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

class Scanner {
  public:
    Scanner(std::string path, std::string_view text) : text_(text) { source_.path = std::move(path); }

    Source scan() {
        while (at_ < text_.size()) step();
        return std::move(source_);
    }

  private:
    char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool starts_with(std::string_view what) const { return text_.substr(at_, what.size()) == what; }
    void advance(size_t count) {
        for (; count > 0 && at_ < text_.size(); --count, ++at_) {
            if (text_[at_] == '\n') ++line_, line_is_blank_ = true;
        }
    }
    void advance_past(std::string_view end, size_t from) {
        size_t found = text_.find(end, at_ + from);
        advance(found == std::string_view::npos ? text_.size() : found + end.size() - at_);
    }

    void step() {
        char c = peek();
        if (starts_with("//")) return advance_past("\n", 2);
        if (starts_with("/*")) return advance_past("*/", 2);
        if (c == '#' && line_is_blank_) return directive();
        if (std::isspace(static_cast<unsigned char>(c))) return advance(1);
        line_is_blank_ = false;
        if (c == '"' || c == '\'') return quoted(c);
        if (std::isdigit(static_cast<unsigned char>(c))) return number();
        if (is_word_start(c)) return word();
        before_ = {before_.empty() ? '\0' : before_.back(), c};
        advance(1);
    }

    void directive() {
        size_t end = text_.find('\n', at_);
        std::string_view line = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
        size_t keyword = line.find_first_not_of(" \t", 1);
        if (keyword != std::string_view::npos && line.substr(keyword, 7) == "include") {
            size_t open = line.find_first_of("<\"", keyword);
            size_t close = open == std::string_view::npos ? open : line.find_first_of(">\"", open + 1);
            if (close != std::string_view::npos) {
                source_.includes.push_back({std::string(line.substr(open + 1, close - open - 1)), line_});
            }
            return advance(line.size());
        }
        advance(1);  // What a macro expands to is read like everything else.
    }

    void quoted(char quote) {
        advance(1);
        while (at_ < text_.size() && peek() != quote && peek() != '\n') advance(peek() == '\\' ? 2 : 1);
        advance(1);
        before_.clear();
    }

    void number() {
        while (is_word_part(peek()) || peek() == '.' || (peek() == '\'' && is_word_part(peek(1)))) advance(1);
        before_.clear();
    }

    void word() {
        size_t begin = at_;
        while (is_word_part(peek())) ++at_;
        std::string text(text_.substr(begin, at_ - begin));
        if (peek() == '"' && !text.empty() && text.back() == 'R') {
            size_t open = text_.find('(', at_);
            if (open == std::string_view::npos) return advance(1);
            return advance_past(")" + std::string(text_.substr(at_ + 1, open - at_ - 1)) + "\"", 1);
        }
        size_t next = text_.find_first_not_of(" \t\r\n", at_);
        Word found{text, line_, before_ == "->" || (!before_.empty() && before_.back() == '.'),
                   next != std::string_view::npos && text_[next] == '(', ""};
        if (before_ == "::") found.scope = last_word_;
        source_.words.push_back(found);
        last_word_ = text;
        before_.clear();
    }

    std::string_view text_;
    Source source_;
    size_t at_ = 0;
    int line_ = 1;
    bool line_is_blank_ = true;
    std::string before_;  // the last two signs since the last word
    std::string last_word_;
};

}  // namespace

Source scan_source(std::string path, std::string_view text) {
    return Scanner(std::move(path), text).scan();
}

}  // namespace overlook::layering
