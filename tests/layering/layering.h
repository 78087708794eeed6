// The rules of the house, checked on its sources, its build files and its programs. See CONTRIBUTING.md for the rooms.
//
// 1  arrows: which room may include and link which
// 2  lean: what reads and draws baked files brings none of the bakers' libraries along
// 3  deciding what to draw is apart from drawing it
// 4  a heavy dependency is visible in one named source file per room, and in no header
// 5  libraries never print, exit or abort
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace overlook::layering {

struct Finding {
    int rule = 0;      // 1..5
    std::string file;  // from the root of the tree
    int line = 0;      // from 1; 0 where a whole file or program is meant
    std::string what;
};
// "formats/x.cpp:3: rule 1: ..."
std::string text_of(const Finding& finding);

struct Include {
    std::string path;  // as written between the quotes or brackets
    int line = 0;
};
// A word of a source outside comments, strings and preprocessor lines.
struct Word {
    std::string text;
    int line = 0;
    bool is_member = false;  // after . or ->
    bool is_call = false;    // before (
    std::string scope;       // "std" in std::exit, "" where there is none
};
struct Source {
    std::string path;  // from the root
    std::vector<Include> includes;
    std::vector<Word> words;
};
Source scan_source(std::string path, std::string_view text);

struct Target {
    std::string name;
    std::string file;  // the CMakeLists.txt, from the root
    int line = 0;
    std::vector<std::string> sources;  // from the root
    std::vector<std::string> links;    // as written, without generator expressions and "overlook::"
};
// The targets that a CMakeLists.txt defines or links further: overlook_library, overlook_command, overlook_module, add_library,
// add_executable, target_sources, target_link_libraries.
std::vector<Target> scan_cmake(const std::string& path, std::string_view text);

struct Tree {
    std::vector<Source> sources;
    std::vector<Target> targets;
};
// All of formats/, runtime/, tools/ and samples/ under root, in the order of their names.
Tree read_tree(const std::string& root);

// What breaks rules 1 to 5 as far as sources and build files show it.
std::vector<Finding> check(const Tree& tree);

// Where a dependency may be included: a heavy one in its seams, at most one to a room; a light one in any source file.
// Neither in a header.
struct Seam {
    std::string dependency;
    std::vector<std::string> header_prefixes;
    std::vector<std::string> files;
    bool is_light = false;
};
std::span<const Seam> seams();

// The room of a path: "formats", "runtime/terrain", "tools/bake", ...
std::string room_of(std::string_view path);

// The libraries of a built program, by file name: those it asks for itself, and all that the loader brings.
struct Libraries {
    std::vector<std::string> needed;
    std::vector<std::string> loaded;
};
Libraries libraries_of(const std::string& program);
// Those that a program or a library that is opened later (a module) asks for itself.
std::vector<std::string> libraries_needed_by(const std::string& file);

// Rule 2 on a built program: none of the bakers' libraries is loaded, and what it asks for begins with a name of `allowed`.
std::vector<Finding> check_lean(const std::string& program, const Libraries& libraries,
                                std::span<const std::string_view> allowed);

}  // namespace overlook::layering
