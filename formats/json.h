// JSON documents that people write (scenes, flights, cases): read into plain values of which each knows its place, so that every
// mistake can be named by line, column and JSON pointer (RFC 6901).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"

namespace overlook::json {

constexpr size_t kMostBytes = 16 << 20;
constexpr size_t kMostValues = 1'000'000;
constexpr uint32_t kMostDepth = 32;  // arrays and objects within each other

enum class Kind : uint8_t { null, boolean, number, text, array, object };

// Where a value begins: both from 1; columns count bytes.
struct Place {
    uint32_t line = 1, column = 1;
};

struct Value {
    Kind kind = Kind::null;
    bool boolean = false;
    double number = 0;  // finite
    std::string text;   // UTF-8
    // Of an array its items; of an object its values, item i under names[i]. No name stands twice.
    std::vector<Value> items;
    std::vector<std::string> names;
    std::vector<Place> name_places;
    Place place;
};

// Parses a whole document, which may be hostile. name: the file's, for messages. Fails with Exit::bad_input:
//   "a.json:3:14: is not JSON: unexpected ',', a value was expected"     (the reason in the parser's words)
//   "a.json:3:14: the name version stands twice"
//   "a.json:3:14: more than 32 arrays and objects within each other"
//   "a.json: 20,000,000 bytes; at most 16,777,216 are read"
//   "a.json:3:14: more than 1,000,000 values"
//   "a.json:3:14: more than 100 names in one object"
// Cost O(bytes), memory at most some 110 bytes a value beside the text's own. Numbers that a double cannot hold are not JSON.
Result<Value> parse(std::string_view text, const std::string& name);

// Reads and parses a file. Fails further as MappedFile::open.
Result<Value> read(const std::string& path);

// What an object may hold under one name.
struct Member {
    std::string_view name;
    Kind kind = Kind::null;
    bool is_required = false;
    double least = 0, most = 0;  // of a number, of each number of an array of numbers, or of an array's other items their count
    uint32_t count = 0;          // of an array of numbers how many, exactly; 0 = any array
};

// A value and the way to it from the document's root: "/layers/0/method".
struct Node {
    const Value* value = nullptr;
    std::string pointer;
};

// Walks a document and keeps the first mistake; after it everything it gives is a default, so that callers ask once, at the end.
class Form {
  public:
    Form(const Value& root, std::string name) : root_{&root, ""}, name_(std::move(name)) {}

    const Node& root() const { return root_; }
    bool is_right() const { return mistake_.empty(); }
    // The first mistake as Exit::bad_input, or what was read.
    template <class T>
    Result<T> finish(T&& read) const {
        if (!is_right()) return tl::unexpected(Error{Exit::bad_input, mistake_});
        return std::forward<T>(read);
    }

    // Checks that a node is an object of nothing but these members, each of its kind and range:
    //   "a.json:2:3: /layers/0/metod: is not known here; did you mean method?"
    //   "a.json:2:3: /layers/0: has no asset"
    //   "a.json:2:3: /error_px: is text; a number from 0.01 to 10000 is wanted"
    //   "a.json:2:3: /error_px: 0 is outside 0.01..10000"
    void expect(const Node& object, std::span<const Member> members);

    // A member of an object that was checked; Node{} with no value if it is not there.
    Node member(const Node& object, std::string_view name) const;
    // Items of an array, or values of an object; none of anything else.
    std::vector<Node> items(const Node& node) const;
    double number(const Node& object, std::string_view name, double otherwise) const;
    std::string text(const Node& object, std::string_view name, const std::string& otherwise) const;

    // Names a mistake at a node.
    void fail(const Node& node, const std::string& what);

  private:
    void fail_at(Place place, const std::string& pointer, const std::string& what);
    void check_member(const Node& node, const Member& member);

    Node root_;
    std::string name_;
    std::string mistake_;
};

// The version that stands in every document: a whole number, of which this program knows `known`.
//   "a.json:1:13: /version: 2 is newer than this program, which reads up to 1"
void check_version(Form& form, int known);

// Of these the one that needs the fewest single-letter edits to become `wrong` (Levenshtein); the first of equals; "" of none.
std::string_view nearest(std::string_view wrong, std::span<const std::string_view> known);

// A JSON string of any bytes that are UTF-8, with its quotes.
std::string quoted(std::string_view text);

}  // namespace overlook::json
