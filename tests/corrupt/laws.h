// What is asked of the fixtures of every kind of section, and of their readers.
#pragma once

#include <string>
#include <vector>

#include "tests/corrupt/container_fixtures.h"

namespace overlook::container::fixtures {

// A kind of sections, with its fixtures.
struct Kind {
    std::string name;  // of its folders, tests/corrupt/NAME and tests/fuzz/corpus/NAME
    char letter;       // of its rules in messages
    std::vector<Fixture> (*whole_files)();
    std::vector<Fixture> (*corrupt_files)();
    Result<void> (*read)(std::span<const std::byte> bytes, const std::string& name);
    int (*rule_count)();
};

// Of a corrupt file.
void expect_refused_by_its_rule(const Kind& kind, const Fixture& fixture);
void expect_whole_container(const Fixture& fixture);
void expect_in_repository_as_made(const Kind& kind, const Fixture& fixture);
// Its name in a listing of tests.
std::string test_name(const Kind& kind, const Fixture& fixture);

// Of them all.
void expect_one_for_every_rule(const Kind& kind);
void expect_no_other_files(const Kind& kind);
void expect_whole_ones_accepted(const Kind& kind);
void expect_whole_ones_in_corpus(const Kind& kind);

// Of a whole file, by the name of its fixture: cut to any length, and with any bit of its sections another, it is refused.
void expect_refused_at_every_length(const Kind& kind, const std::string& name);
void expect_refused_at_every_bit(const Kind& kind, const std::string& name);

Bytes whole_file(const Kind& kind, const std::string& name);

}  // namespace overlook::container::fixtures
