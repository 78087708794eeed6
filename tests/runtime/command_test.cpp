#include "runtime/command/command.h"

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::command {
namespace {

struct Ran {
    int exit = -1;
    std::string out, err;
    Common common;
    double tolerance = 0;
};

// A command "tool terrain" with an option of its own, run with these arguments.
Ran run_with(
    std::vector<std::string> arguments, const std::function<int()>& body = [] { return 0; }) {
    Ran ran;
    CLI::App app("A tool", "tool");
    CLI::App* verb = app.add_subcommand("terrain", "A verb");
    app.require_subcommand(1);
    verb->add_option("--tolerance", ran.tolerance, "A length");
    add_common(*verb, ran.common, Uses::seed | Uses::memory);
    arguments.insert(arguments.begin(), "tool");
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    ran.exit = run(app, ran.common, int(pointers.size()), pointers.data(), body);
    ran.out = testing::internal::GetCapturedStdout();
    ran.err = testing::internal::GetCapturedStderr();
    return ran;
}

bool is_one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
}

TEST(Command, PrintsHelpAndVersionOnStandardOutput) {
    for (const char* word : {"--help", "--version"}) {
        Ran ran = run_with({"terrain", word});
        EXPECT_EQ(ran.exit, 0);
        EXPECT_FALSE(ran.out.empty());
        EXPECT_EQ(ran.err, "");
    }
    EXPECT_EQ(run_with({"--version"}).exit, 0);
}

TEST(Command, RefusesNonsenseInOneLineAndExits2) {
    const std::vector<std::vector<std::string>> wrong{{},
                                                      {"terain"},
                                                      {"terrain", "--tolerence", "3"},
                                                      {"terrain", "--threads", "-1"},
                                                      {"terrain", "--threads", "x"},
                                                      {"terrain", "--memory", "5Q"},
                                                      {"terrain", "--memory", "-1"},
                                                      {"terrain", "--memory", "99999999999T"},
                                                      {"terrain", "--progress", "often"},
                                                      {"terrain", "--quiet", "--verbose"},
                                                      {"terrain", "--tolerance"}};
    for (const auto& arguments : wrong) {
        Ran ran = run_with(arguments);
        EXPECT_EQ(ran.exit, 2) << testing::PrintToString(arguments);
        EXPECT_TRUE(is_one_line(ran.err)) << ran.err;
        EXPECT_EQ(ran.out, "");
    }
}

TEST(Command, NamesTheNearestOption) {
    EXPECT_NE(run_with({"terrain", "--tolerence", "3"}).err.find("did you mean --tolerance?"), std::string::npos);
    EXPECT_NE(run_with({"terain"}).err.find("tool: "), std::string::npos);
}

TEST(Command, ReadsSizesWithSuffixes) {
    EXPECT_EQ(run_with({"terrain", "--memory", "1000"}).common.memory_bytes, 1000u);
    EXPECT_EQ(run_with({"terrain", "--memory", "3K"}).common.memory_bytes, 3u << 10);
    EXPECT_EQ(run_with({"terrain", "--memory", "512m"}).common.memory_bytes, 512u << 20);
    EXPECT_EQ(run_with({"terrain", "--memory", "4GiB"}).common.memory_bytes, uint64_t(4) << 30);
    EXPECT_EQ(run_with({"terrain", "--memory", "16777215T"}).common.memory_bytes, uint64_t(16777215) << 40);
    EXPECT_EQ(run_with({"terrain", "--memory", "16777216T"}).exit, 2);
}

TEST(Command, TakesAConfigurationBehindTheCommandLine) {
    ScratchFolder folder;
    std::string file = folder / "c.toml";
    ASSERT_TRUE(write_file(file, std::string_view("tolerance = 2.5\nseed = 7\nquiet = true\n[terrain]\nthreads = 3\n")));
    Ran ran = run_with({"terrain", "--config", file, "--seed", "9"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.tolerance, 2.5);
    EXPECT_EQ(ran.common.seed, 9u);
    EXPECT_EQ(ran.common.threads, 3u);
    EXPECT_TRUE(ran.common.quiet);

    ASSERT_TRUE(write_file(file, std::string_view("tolerence = 2.5\n")));
    ran = run_with({"terrain", "--config", file});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_NE(ran.err.find("did you mean \"tolerance\"?"), std::string::npos) << ran.err;
    EXPECT_EQ(run_with({"terrain", "--config", folder / "none.toml"}).exit, 3);
}

TEST(Command, SaysWhatEscapedAsABugAndLackOfMemoryAsALimit) {
    Ran ran = run_with({"terrain"}, []() -> int { throw std::runtime_error("first line\nsecond"); });
    EXPECT_EQ(ran.exit, 70);
    EXPECT_TRUE(is_one_line(ran.err));
    EXPECT_EQ(ran.err.rfind("tool terrain: internal error: first line", 0), 0u) << ran.err;
    EXPECT_EQ(run_with({"terrain"}, []() -> int { throw std::bad_alloc(); }).exit, 5);
    EXPECT_EQ(run_with({"terrain"}, [] { return fail("tool", Error{Exit::cannot_write, "full"}); }).exit, 4);
}

TEST(Command, SaysOnlyErrorsWhenQuiet) {
    Common common;
    common.quiet = true;
    testing::internal::CaptureStderr();
    note(common, "talk");
    detail(common, "talk");
    Progress(common, "work").set(0.5);
    fail("tool", Error{Exit::bad_input, "wrong"});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "tool: wrong\n");
}

TEST(CommandDeathTest, SaysWhenStandardOutputCannotBeWritten) {
    auto prints_into_a_full_device = [] {
        std::freopen("/dev/full", "w", stdout);
        Common common;
        CLI::App app("A tool", "tool");
        char name[] = "tool";
        char* arguments[] = {name, nullptr};
        std::exit(run(app, common, 1, arguments, [] { return std::fputs("data\n", stdout), 0; }));
    };
    EXPECT_EXIT(prints_into_a_full_device(), testing::ExitedWithCode(4), "tool: standard output: cannot write: No space left");
}

TEST(CommandDeathTest, EndsByTheSignalItWasSentAndLeavesNothingHalfWritten) {
    ScratchFolder folder;
    for (int signal_number : {SIGINT, SIGTERM, SIGPIPE}) {
        auto is_told_to_end = [&] {
            Common common;
            CLI::App app("A tool", "tool");
            char name[] = "tool";
            char* arguments[] = {name, nullptr};
            run(app, common, 1, arguments, [&] {
                auto file = AtomicFile::create(folder / "a.ovl");
                std::byte byte{1};
                file->append({&byte, 1});
                return std::raise(signal_number);
            });
            std::exit(0);
        };
        EXPECT_EXIT(is_told_to_end(), testing::KilledBySignal(signal_number), "");
        EXPECT_TRUE(std::filesystem::is_empty(folder / "")) << signal_number;
    }
}

}  // namespace
}  // namespace overlook::command
