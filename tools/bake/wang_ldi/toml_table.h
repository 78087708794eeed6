// A table of a TOML file, key by key, every mistake named with file, line and key. Its parser stays behind toml_table.cpp.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook::wang_ldi {

class TomlTable {
  public:
    // Exit::bad_input: "meadow.toml:3: ...", "meadow.toml: No such file or directory".
    static Result<TomlTable> open(const std::string& path);

    // The value of a key, or `otherwise` where there is none. The first mistake is kept for finish(), whatever is asked after it.
    double number(const std::string& key, double otherwise, double least, double most);
    uint64_t count(const std::string& key, uint64_t otherwise, uint64_t least, uint64_t most);
    bool flag(const std::string& key, bool otherwise);
    std::string text(const std::string& key, const std::string& otherwise);
    // A text, or a whole number as text.
    std::string word(const std::string& key, const std::string& otherwise);
    // [low, high], ascending, or one number for both.
    std::array<double, 2> range(const std::string& key, std::array<double, 2> otherwise, double least, double most);
    std::vector<double> numbers(const std::string& key, double least, double most);
    // [[key]], in order; each says "KEY 2: " before what it says.
    std::vector<TomlTable> tables(const std::string& key);

    bool has(const std::string& key) const;
    // A mistake of a key's value: "FILE:LINE: KEY: TEXT". Kept if it is the first.
    void refuse(const std::string& key, const std::string& text);
    // The first mistake; else a key that nobody has asked for, and the nearest that somebody has.
    Result<void> finish();

  private:
    struct Node;
    TomlTable() = default;
    void need(const std::string& key);

    std::shared_ptr<const Node> node_;
    std::string path_, place_;
    std::vector<std::string> known_;
    std::optional<Error> error_;
};

}  // namespace overlook::wang_ldi
