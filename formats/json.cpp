// The seam to nlohmann-json: its parser's events become values with places.
#include "formats/json.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/mapped_file.h"
#include "formats/numbers.h"

namespace overlook::json {
namespace {

using Theirs = nlohmann::json;

// Lets the parser read a text and tells how far it is.
struct Counting {
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at = nullptr;
    size_t* consumed = nullptr;

    reference operator*() const { return *at; }
    Counting& operator++() {
        ++at;
        ++*consumed;
        return *this;
    }
    Counting operator++(int) {
        Counting before = *this;
        ++*this;
        return before;
    }
    bool operator==(const Counting& other) const { return at == other.at; }
    bool operator!=(const Counting& other) const { return at != other.at; }
};

// Builds the values. Where a token begins follows from where the one before it ended: only white space, commas and colons stand
// between them.
class Builder {
  public:
    Builder(std::string_view text, const size_t& consumed, std::string name)
        : text_(text), consumed_(consumed), name_(std::move(name)) {
        if (text_.starts_with("\xef\xbb\xbf")) end_ = scanned_ = 3;
    }

    // What the parser calls; false stops it.
    bool null() { return add(Kind::null, end_of_word()) != nullptr; }
    bool boolean(bool given) {
        Value* value = add(Kind::boolean, end_of_word());
        if (value != nullptr) value->boolean = given;
        return value != nullptr;
    }
    bool number_integer(Theirs::number_integer_t given) { return number(double(given)); }
    bool number_unsigned(Theirs::number_unsigned_t given) { return number(double(given)); }
    bool number_float(Theirs::number_float_t given, const std::string&) { return number(given); }
    bool string(std::string& given) {
        Value* value = add(Kind::text, consumed_);
        if (value != nullptr) value->text = std::move(given);
        return value != nullptr;
    }
    bool binary(Theirs::binary_t&) { return false; }
    bool start_object(size_t) { return open(Kind::object); }
    bool start_array(size_t) { return open(Kind::array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& given) {
        Place place = place_of(begin_of_next());
        end_ = consumed_;
        Value& object = *open_.back();
        for (const std::string& name : object.names) {
            if (object.names.size() > kMostNames) return fail(place, "more than 100 names in one object");
            if (name == given) return fail(place, "the name " + given + " stands twice");
        }
        object.names.push_back(std::move(given));
        object.name_places.push_back(place);
        return true;
    }
    template <class Exception>
    bool parse_error(size_t, const std::string&, const Exception& exception) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing value - invalid ..."
        std::string reason = exception.what();
        for (const char* lead : {"] ", " - ", "parse error at line"}) {
            size_t found = reason.find(lead);
            if (found == std::string::npos) continue;
            if (lead[0] != 'p') reason = reason.substr(found + std::strlen(lead));
        }
        return fail(place_of(consumed_ > 0 ? consumed_ - 1 : 0), "is not JSON: " + printable(reason));
    }

    const std::string& mistake() const { return mistake_; }
    Value take() { return std::move(root_); }

  private:
    static constexpr size_t kMostNames = 100;

    static std::string printable(std::string text) {
        for (char& c : text) {
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
        }
        return text;
    }
    bool fail(Place place, const std::string& what) {
        if (mistake_.empty()) mistake_ = fmt::format("{}:{}:{}: {}", name_, place.line, place.column, printable(what));
        return false;
    }
    size_t begin_of_next() const {
        size_t at = text_.find_first_not_of(" \t\r\n,:", end_);
        return at == std::string_view::npos ? text_.size() : at;
    }
    // Numbers and words end where their letters do; the parser has looked one further.
    size_t end_of_word() const {
        size_t at = text_.find_first_not_of("+-.0123456789abcdefghijklmnopqrstuvwxyzE", begin_of_next());
        return at == std::string_view::npos ? text_.size() : at;
    }
    // Asked for in order, so that the text is gone through once.
    Place place_of(size_t offset) {
        for (; scanned_ < offset && scanned_ < text_.size(); ++scanned_) {
            if (text_[scanned_] == '\n') {
                ++line_;
                line_begin_ = scanned_ + 1;
            }
        }
        return {line_, uint32_t(std::max(offset, line_begin_) - line_begin_ + 1)};
    }
    bool number(double given) {
        Value* value = add(Kind::number, end_of_word());
        if (value != nullptr) value->number = given;
        return value != nullptr;
    }
    Value* add(Kind kind, size_t end) {
        Place place = place_of(begin_of_next());
        end_ = end;
        if (++count_ > kMostValues) {
            fail(place, "more than " + with_commas(kMostValues) + " values");
            return nullptr;
        }
        Value* value = &root_;
        if (!open_.empty()) value = &open_.back()->items.emplace_back();
        value->kind = kind;
        value->place = place;
        return value;
    }
    bool open(Kind kind) {
        Value* value = add(kind, consumed_);
        if (value == nullptr) return false;
        if (open_.size() >= kMostDepth) {
            return fail(value->place, fmt::format("more than {} arrays and objects within each other", kMostDepth));
        }
        open_.push_back(value);
        return true;
    }
    bool close() {
        end_ = consumed_;
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    const size_t& consumed_;
    std::string name_;
    size_t end_ = 0;  // of the token before
    size_t scanned_ = 0, line_begin_ = 0;
    uint32_t line_ = 1;
    size_t count_ = 0;
    Value root_;
    std::vector<Value*> open_;  // stable: an array grows only while none of its items is open
    std::string mistake_;
};

}  // namespace

Result<Value> parse(std::string_view text, const std::string& name) {
    if (text.size() > kMostBytes) {
        return bad_input("{}: {} bytes; at most {} are read", name, with_commas(text.size()), with_commas(kMostBytes));
    }
    size_t consumed = 0;
    Builder builder(text, consumed, name);
    bool is_whole = Theirs::sax_parse(Counting{text.data(), &consumed}, Counting{text.data() + text.size(), &consumed}, &builder);
    if (!builder.mistake().empty()) return tl::unexpected(Error{Exit::bad_input, builder.mistake()});
    if (!is_whole) return bad_input("{}:1:1: is not JSON", name);
    return builder.take();
}

Result<Value> read(const std::string& path) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    std::span<const std::byte> bytes = file->bytes();
    return parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

std::string quoted(std::string_view text) {
    return Theirs(std::string(text)).dump(-1, ' ', false, Theirs::error_handler_t::replace);
}

}  // namespace overlook::json
