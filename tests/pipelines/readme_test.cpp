// Every fenced block of the README does what it shows.
//
// Lines that start a pipeline would build and test all over again from within a test: `pipelines/X` is run with --dry-run and
// `make -C pipelines X` with make's -n, from the root of the repository; both then show the steps that they would take. All other
// lines are run as they stand, in an empty folder, with the commands of this build.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <vector>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

const std::string kRoot = OVERLOOK_SOURCE_DIR;

struct Block {
    std::string language;
    std::vector<std::string> lines;
    int line = 0;
};

std::vector<Block> blocks_of(const std::string& text) {
    std::vector<Block> blocks;
    std::istringstream in(text);
    bool is_inside = false;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.starts_with("```")) {
            is_inside = !is_inside;
            if (is_inside) blocks.push_back({line.substr(3), {}, number});
        } else if (is_inside) {
            blocks.back().lines.push_back(line);
        }
    }
    return blocks;
}

bool starts_pipeline(const std::string& line) {
    return line.starts_with("pipelines/") || line.starts_with("make -C pipelines");
}

TEST(Readme, ShowsTheTwoCommandsFirst) {
    auto blocks = blocks_of(shell::read_file(kRoot + "/README.md"));
    ASSERT_FALSE(blocks.empty());
    EXPECT_EQ(blocks[0].lines, (std::vector<std::string>{"pipelines/quickstart", "pipelines/test"}));
}

TEST(Readme, HasNoBlockThatCannotBeRun) {
    for (const Block& block : blocks_of(shell::read_file(kRoot + "/README.md"))) {
        EXPECT_EQ(block.language, "sh") << "README.md:" << block.line;
        EXPECT_FALSE(block.lines.empty()) << "README.md:" << block.line;
    }
}

TEST(Readme, ShowsPipelinesThatExist) {
    for (const Block& block : blocks_of(shell::read_file(kRoot + "/README.md"))) {
        for (const std::string& line : block.lines) {
            if (!starts_pipeline(line)) continue;
            // A make target either has its commands in the Makefile or calls the script of its name, which says its own steps.
            std::string script = line.starts_with("make") ? "pipelines/" + line.substr(line.rfind(' ') + 1) : line;
            bool has_script = shell::run("test -x " + script, kRoot).exit == 0;
            auto ran = shell::run(has_script ? script + " --dry-run" : line + " -n", kRoot);
            EXPECT_EQ(ran.exit, 0) << line << "\n" << ran.output;
            EXPECT_NE(ran.output.find(has_script ? "== 1/" : "bake-lod terrain"), std::string::npos)
                << line << " shows no steps:\n"
                << ran.output;
        }
    }
}

TEST(Readme, ShowsCommandsThatRun) {
    int run_count = 0;
    for (const Block& block : blocks_of(shell::read_file(kRoot + "/README.md"))) {
        shell::Scratch scratch;
        std::string script;
        for (const std::string& line : block.lines) {
            if (!starts_pipeline(line)) script += line + "\n", ++run_count;
        }
        auto ran = shell::run(script, scratch.path());
        EXPECT_EQ(ran.exit, 0) << "README.md:" << block.line << ":\n" << script << ran.output;
    }
    EXPECT_GE(run_count, 5);
}

TEST(Readme, LinksToWhatIsThere) {
    std::string text = shell::read_file(kRoot + "/README.md");
    for (size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        std::string link = text.substr(at + 2, text.find(')', at) - at - 2);
        if (link.starts_with("http")) continue;
        EXPECT_TRUE(std::filesystem::exists(kRoot + "/" + link)) << link;
    }
}

}  // namespace
}  // namespace overlook
