// Build files and whole trees as the rules see them.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/layering/layering.h"

namespace overlook::layering {
namespace {

namespace fs = std::filesystem;

struct Command {
    std::string name;
    int line = 0;
    std::vector<std::string> arguments;
};

// CMake's own grammar, as much of it as build files of one's own use: name ( words or "quoted words" ), # comments.
std::vector<Command> commands_of(std::string_view text) {
    std::vector<Command> commands;
    std::string word;
    int line = 1, depth = 0;
    bool is_quoted = false, is_comment = false;
    auto end_word = [&] {
        if (!word.empty() && depth > 0) commands.back().arguments.push_back(word);
        word.clear();
    };
    for (char c : text) {
        if (c == '\n') ++line;
        if (is_comment) {
            is_comment = c != '\n';
        } else if (c == '"') {
            is_quoted = !is_quoted;
        } else if (is_quoted) {
            word += c;
        } else if (c == '#') {
            is_comment = true;
        } else if (c == '(') {
            if (depth++ == 0) commands.push_back({word, line, {}}), word.clear();
        } else if (c == ')') {
            end_word();
            depth = std::max(0, depth - 1);
        } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ';') {
            if (depth > 0) end_word();
        } else {
            word += c;
        }
    }
    return commands;
}

bool is_keyword(const std::string& word) {
    static const std::vector<std::string> kKeywords = {"PUBLIC", "PRIVATE", "INTERFACE", "STATIC",
                                                       "SHARED", "OBJECT",  "MODULE",    "IMPORTED"};
    return std::find(kKeywords.begin(), kKeywords.end(), word) != kKeywords.end();
}

// "$<BUILD_INTERFACE:overlook::formats>" -> "formats"
std::string bare_name(std::string link) {
    if (link.starts_with("$<")) {
        size_t colon = link.find(':');
        link = colon == std::string::npos ? "" : link.substr(colon + 1, link.size() - colon - 2);
    }
    return link.starts_with("overlook::") ? link.substr(10) : link;
}

std::string read_file(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::vector<Target> scan_cmake(const std::string& path, std::string_view text) {
    std::string folder = path.substr(0, path.rfind('/') + 1);
    std::vector<Target> targets;
    for (const Command& command : commands_of(text)) {
        bool is_ours =
            command.name == "overlook_library" || command.name == "overlook_command" || command.name == "overlook_module";
        bool adds = command.name == "add_library" || command.name == "add_executable";
        bool links = command.name == "target_link_libraries";
        if (!(is_ours || adds || links || command.name == "target_sources") || command.arguments.empty()) continue;
        const auto& arguments = command.arguments;
        if (std::find(arguments.begin(), arguments.end(), "ALIAS") != arguments.end()) continue;

        Target target{arguments[0], path, command.line, {}, {}};
        bool into_links = links;
        for (size_t i = 1; i < arguments.size(); ++i) {
            if (is_ours && arguments[i] == "SOURCES")
                into_links = false;
            else if (is_ours && is_keyword(arguments[i]))
                into_links = true;
            else if (is_keyword(arguments[i]))
                continue;
            else if (into_links)
                target.links.push_back(bare_name(arguments[i]));
            else
                target.sources.push_back(folder + arguments[i]);
        }
        targets.push_back(std::move(target));
    }
    return targets;
}

Tree read_tree(const std::string& root) {
    std::vector<std::string> paths;
    for (const char* top : {"formats", "runtime", "tools", "samples"}) {
        if (!fs::is_directory(fs::path(root) / top)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / top)) {
            if (entry.is_regular_file()) paths.push_back(fs::relative(entry.path(), root).generic_string());
        }
    }
    std::sort(paths.begin(), paths.end());

    Tree tree;
    for (const std::string& path : paths) {
        std::string name = fs::path(path).filename().string(), extension = fs::path(path).extension().string();
        if (name == "CMakeLists.txt") {
            auto targets = scan_cmake(path, read_file(fs::path(root) / path));
            tree.targets.insert(tree.targets.end(), targets.begin(), targets.end());
        } else if (extension == ".h" || extension == ".cpp" || extension == ".inl") {
            tree.sources.push_back(scan_source(path, read_file(fs::path(root) / path)));
        }
    }
    return tree;
}

}  // namespace overlook::layering
