// pipelines/skipped-tests: no test goes missing without a word.
#include <gtest/gtest.h>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

// What ctest prints and logs of two skipped tests and one that ran.
constexpr const char* kOutput =
    "3/3 Test #3: Dem.ReadsEverest .....................***Skipped   0.00 sec\n\n"
    "100% tests passed, 0 tests failed out of 3\n\n"
    "The following tests did not run:\n"
    "\t  2 - Window.Opens (Skipped)\n"
    "\t  3 - Dem.ReadsEverest (Skipped)\n";
constexpr const char* kLog =
    "1/3 Testing: Container.Opens\n[ RUN      ] Container.Opens\n[       OK ] Container.Opens (0 ms)\n"
    "2/3 Testing: Window.Opens\n/src/window_test.cpp:7: Skipped\nthere is no display\n[  SKIPPED ] Window.Opens (0 ms)\n"
    "3/3 Testing: Dem.ReadsEverest\n/src/dem_test.cpp:9: Skipped\nset OVERLOOK_DATA\n\n[  SKIPPED ] Dem.ReadsEverest (0 ms)\n";
constexpr const char* kAllowed = "# a comment\nwithout-data OVERLOOK_DATA\nalways ^Window[.]\n";

class SkippedTests : public testing::Test {
  protected:
    shell::Ran count(const std::string& environment, const std::string& allowed, const std::string& output = kOutput) {
        shell::write_file(scratch_.path() + "/output", output);
        shell::write_file(scratch_.path() + "/log", kLog);
        shell::write_file(scratch_.path() + "/allowed", allowed);
        return shell::run(
            "env -u CI -u OVERLOOK_DATA " + environment + " '" OVERLOOK_SOURCE_DIR "/pipelines/skipped-tests' output log allowed",
            scratch_.path());
    }
    shell::Scratch scratch_;
};

TEST_F(SkippedTests, AreNamedWithTheirReasonsAndCounted) {
    auto ran = count("CI=true", kAllowed);
    EXPECT_EQ(ran.exit, 0) << ran.output;
    EXPECT_EQ(ran.output,
              "skipped: Dem.ReadsEverest: set OVERLOOK_DATA\n"
              "skipped: Window.Opens: there is no display\n"
              "skipped: 2 in all, of them 0 that should have run\n");
}

TEST_F(SkippedTests, FailInCiWhenTheDataIsThere) {
    auto ran = count("CI=true OVERLOOK_DATA=/data", kAllowed);
    EXPECT_EQ(ran.exit, 1);
    EXPECT_NE(ran.output.find("skipped, and should have run: Dem.ReadsEverest"), std::string::npos) << ran.output;
}

TEST_F(SkippedTests, FailInCiWhenNoLineAllowsThem) {
    EXPECT_EQ(count("CI=true", "without-data OVERLOOK_DATA\n").exit, 1);
    EXPECT_EQ(count("", "without-data OVERLOOK_DATA\n").exit, 0) << "outside of CI they are only said";
}

TEST_F(SkippedTests, RefuseAConditionThatIsNone) {
    EXPECT_NE(count("CI=true", "sometimes .*\n").exit, 0);
}

TEST_F(SkippedTests, AreNoneWhereAllRan) {
    auto ran = count("CI=true", kAllowed, "100% tests passed, 0 tests failed out of 3\n");
    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.output, "skipped: none\n");
}

}  // namespace
}  // namespace overlook
