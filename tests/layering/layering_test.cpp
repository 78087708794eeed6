// The rules of the house hold in the real tree and in the programs built from it, and each fixture breaks exactly its own.
#include "tests/layering/layering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace overlook::layering {
namespace {

const std::string kRoot = OVERLOOK_SOURCE_DIR;
const std::string kFixtures = kRoot + "/tests/layering/fixtures";

// All that a program which reads or draws baked files may ask for by itself.
constexpr std::array<std::string_view, 21> kLean = {
    "libepoxy.so",  "libglfw.so",          "libEGL.so",  "libGL.so",  "libOpenGL.so", "libspng.so",  // OpenGL, window, pictures
    "libstb.so",                                                                                     // the overlay's letters
    "libzstd.so",   "libxxhash.so",        "libtbb.so",  "libfmt.so",              // codecs, checksums, threads, text
    "libdraco.so",  "libmeshoptimizer.so",                                         // codecs of meshes
    "libstdc++.so", "libgcc_s.so",         "libm.so",    "libc.so",   "ld-linux",  // the language
    "libasan.so",   "libubsan.so",         "libtsan.so",                           // in sanitized builds
};

std::string lines_of(const std::vector<Finding>& findings) {
    std::string lines;
    for (const Finding& finding : findings) lines += "\n  " + text_of(finding);
    return lines;
}

std::vector<std::string> fixtures_of_trees() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kFixtures)) {
        std::string name = entry.path().filename().string();
        if (name.starts_with("rule") && name != "rule2_program_loads_image_library") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

TEST(Layering, HoldsInTheRealTree) {
    Tree tree = read_tree(kRoot);
    ASSERT_GT(tree.sources.size(), 20u);
    ASSERT_GT(tree.targets.size(), 3u);
    auto findings = check(tree);
    EXPECT_TRUE(findings.empty()) << lines_of(findings);
}

TEST(Layering, FindsNothingInAHouseThatKeepsTheRules) {
    Tree tree = read_tree(kFixtures + "/clean");
    ASSERT_EQ(tree.sources.size(), 4u);
    ASSERT_EQ(tree.targets.size(), 2u);
    auto findings = check(tree);
    EXPECT_TRUE(findings.empty()) << lines_of(findings);
}

TEST(Layering, HasAFixtureForEachRule) {
    std::set<char> rules;
    for (const std::string& name : fixtures_of_trees()) rules.insert(name[4]);
    EXPECT_EQ(rules, (std::set<char>{'1', '2', '3', '4', '5'}));
}

TEST(Layering, NamesOneSeamToARoom) {
    for (const Seam& seam : seams()) {
        std::set<std::string> rooms;
        for (const std::string& file : seam.files) {
            EXPECT_TRUE(rooms.insert(room_of(file)).second) << seam.dependency << ": two seams in " << room_of(file);
            EXPECT_TRUE(file.ends_with(".cpp")) << file;
            EXPECT_TRUE(std::filesystem::exists(kRoot + "/" + file)) << seam.dependency << ": no such seam: " << file;
        }
    }
}

class LayeringFixture : public testing::TestWithParam<std::string> {};

TEST_P(LayeringFixture, BreaksItsOwnRuleAlone) {
    auto findings = check(read_tree(kFixtures + "/" + GetParam()));
    ASSERT_FALSE(findings.empty());
    for (const Finding& finding : findings) EXPECT_EQ(finding.rule, GetParam()[4] - '0') << text_of(finding);
    EXPECT_EQ(findings.size(), 1u) << lines_of(findings);
}

INSTANTIATE_TEST_SUITE_P(Rules, LayeringFixture, testing::ValuesIn(fixtures_of_trees()),
                         [](const auto& parameter) { return parameter.param; });

TEST(LeanPrograms, ProgramThatReadsAndDecidesLoadsNoLibraryOfTheBakers) {
    Libraries libraries = libraries_of(OVERLOOK_LEAN_PROBE);
    ASSERT_FALSE(libraries.needed.empty());
    ASSERT_GE(libraries.loaded.size(), libraries.needed.size());
    auto findings = check_lean("lean_probe", libraries, kLean);
    EXPECT_TRUE(findings.empty()) << lines_of(findings);
}

#ifdef OVERLOOK_PLAYER_PROGRAM
TEST(LeanPrograms, PlayerLoadsNoLibraryOfTheBakers) {
    Libraries libraries = libraries_of(OVERLOOK_PLAYER_PROGRAM);
    ASSERT_FALSE(libraries.needed.empty());
    ASSERT_GE(libraries.loaded.size(), libraries.needed.size());
    auto findings = check_lean("player", libraries, kLean);
    EXPECT_TRUE(findings.empty()) << lines_of(findings);
}
#endif

#ifdef OVERLOOK_BAKER_PROBE
TEST(BakerPrograms, LoadNoImageLibraryUntilTheyMeetAPicture) {
    Libraries libraries = libraries_of(OVERLOOK_BAKER_PROBE);
    ASSERT_FALSE(libraries.needed.empty());
    for (const std::string& library : libraries.loaded)
        for (const char* name : {"OpenImageIO", "opencv", "gdal"})
            EXPECT_EQ(library.find(name), std::string::npos) << "a baker without pictures loads " << library;

    std::vector<std::string> needed = libraries_needed_by(OVERLOOK_IMAGE_MODULE);
    EXPECT_TRUE(std::any_of(needed.begin(), needed.end(), [](const std::string& n) {
        return n.starts_with("libOpenImageIO.so");
    })) << "one with pictures loads them by the module";
}
#endif

#ifdef OVERLOOK_FAT_PROBE
TEST(LeanPrograms, ProgramThatLoadsTheImageLibraryIsFound) {
    auto findings = check_lean("fat_probe", libraries_of(OVERLOOK_FAT_PROBE), kLean);
    auto names = lines_of(findings);
    EXPECT_NE(names.find("loads libOpenImageIO.so"), std::string::npos) << names;
    EXPECT_NE(names.find("loads libgdal.so"), std::string::npos) << "what comes along by way of another: " << names;
}
#endif

TEST(LeanPrograms, LibraryThatIsNotOnTheListIsFound) {
    auto findings = check_lean("program", {{"libc.so.6", "libsurprise.so.1"}, {"libc.so.6", "libsurprise.so.1"}}, kLean);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(text_of(findings[0]), "program: rule 2: asks for libsurprise.so.1, which is not on the list");
}

}  // namespace
}  // namespace overlook::layering
