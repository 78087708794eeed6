// What all commands share: help, version, refusals of command lines, reports, silence.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string name_of(const Words& verb) {
    return verb.size() == 1 ? verb[0] : verb[0] + " " + verb[1];
}

const std::vector<Words> kVerbs = {{"bake-lod", "terrain"},
                                   {"baked", "info"},
                                   {"baked", "verify"},
                                   {"baked", "diff"},
                                   {"baked", "export"},
                                   {"make-sample", "dem"},
                                   {"make-sample", "lod-sprite"},
                                   {"make-sample", "slopes"},
                                   {"make-sample", "vase"},
                                   {"make-sample", "masts"},
                                   {"make-sample", "sunflowers"},
                                   {"make-sample", "grass"},
                                   {"reproduce", "lod-sprite"},
                                   {"reproduce", "fsi"},
                                   {"player"}};
const std::vector<Words> kCommands = {{"bake-lod"}, {"bake-wang-ldi"}, {"baked"},     {"make-sample"},
                                      {"measure"},  {"player"},        {"reproduce"}, {"stability"}};

// Of every option and argument something is said: after its name in the column of descriptions, or on the next line.
void expect_described(const std::string& help) {
    std::istringstream lines(help);
    std::string line, undescribed;
    while (std::getline(lines, line)) {
        EXPECT_LE(line.size(), 100u) << line;
        bool goes_on = line.rfind(std::string(30, ' '), 0) == 0;
        EXPECT_TRUE(undescribed.empty() || goes_on) << undescribed;
        bool is_entry = line.rfind("  ", 0) == 0 && !goes_on;
        bool has_text = line.size() > 30 && line[29] == ' ' && line[30] != ' ';
        undescribed = is_entry && !has_text ? line : "";
    }
    EXPECT_EQ(undescribed, "");
}

TEST(Help, OfEveryCommandAndVerbSaysWhatEverythingIs) {
    for (const auto* list : {&kCommands, &kVerbs})
        for (const Words& verb : *list) {
            SCOPED_TRACE(name_of(verb));
            Ran ran = run(verb + Words{"--help"});
            expect_done(ran);
            EXPECT_EQ(ran.err, "");
            EXPECT_NE(ran.out.find("Usage: " + name_of(verb)), std::string::npos) << ran.out;
            expect_described(ran.out);
        }
}

TEST(Version, IsTheSameOfEveryCommand) {
    for (const auto* list : {&kCommands, &kVerbs})
        for (const Words& verb : *list) {
            Ran ran = run(verb + Words{"--version"});
            expect_done(ran);
            EXPECT_EQ(ran.out, "overlook " OVERLOOK_VERSION "\n");
            EXPECT_EQ(ran.err, "");
        }
}

TEST(CommandLine, RefusesAnUnknownOptionAndKnowsTheNearest) {
    for (const Words& verb : kVerbs) {
        expect_refusal(run(verb + Words{"--no-such-thing-at-all"}), 2, name_of(verb), {});
        Words with_files = verb == Words{"player"} || verb[1] == "info" ? verb + Words{"a.ovl"} : verb;
        if (with_files.back() == "a.ovl")
            expect_refusal(run(with_files + Words{"--thread=3"}), 2, name_of(verb), {"--thread", "did you mean --threads?"});
    }
}

TEST(CommandLine, RefusesAMissingOrUnknownVerb) {
    for (const char* command : {"bake-lod", "baked", "make-sample", "reproduce"}) {
        expect_refusal(run({command}), 2, command, {"a verb is wanted: "});
        expect_refusal(run({command, "frobnicate"}), 2, command, {"\"frobnicate\" is not one of its verbs: "});
    }
    expect_refusal(run({"player"}), 2, "player", {"file"});
}

TEST(CommandLine, RefusesAnAbsurdTolerance) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65), dem = folder / "sample/dem.tif";
    auto before = contents_of(folder.path());
    for (const char* number : {"-1", "nan", "-nan", "inf", "1e30", "ten", ""}) {
        SCOPED_TRACE(number);
        expect_refusal(run({"baked", "export", baked, "-o", folder / "a.ply", "--error-m", number}), 2, "baked export",
                       {"--error-m", number});
        expect_refusal(run({"baked", "verify", baked, "--source", dem, "--error-m", number}), 2, "baked verify",
                       {"--error-m", number});
        expect_refusal(run({"player", baked, "--headless", "--image", folder / "a.png", "--error-px", number}), 2, "player",
                       {"--error-px"});
        expect_refusal(run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--height-step-m", number}), 2,
                       "bake-lod terrain", {"--height-step-m", number});
        expect_refusal(run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--cell-size-m", number}), 2, "bake-lod terrain",
                       {"--cell-size-m", number});
    }
    expect_refusal(run({"player", baked, "--headless", "--image", folder / "a.png", "--error-px", "0"}), 2, "player",
                   {"--error-px 0"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(CommandLine, RefusesAToleranceThatTheFileCannotKeep) {
    ScratchFolder folder;
    std::string dem = make_dem(folder.path(), 65);
    expect_done(run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--height-step-m", "4", "--quiet"}));
    expect_refusal(run({"baked", "export", folder / "a.ovl", "-o", folder / "a.ply", "--error-m", "0.5"}), 5, "baked export",
                   {folder / "a.ovl", "--height-step-m"});
}

TEST(CommandLine, RefusesAnUnknownMesh) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    expect_refusal(run({"baked", "export", baked, "--error-m", "5", "-o", folder / "a.obj"}), 2, "baked export",
                   {"a.obj", ".ply"});
    expect_refusal(run({"baked", "export", baked, "--error-m", "5", "--space", "raster", "-o", folder / "a.glb"}), 2,
                   "baked export", {"a.glb"});
}

// Every verb at work, with `more` at its end.
std::vector<std::pair<Words, bool>> all_work(const ScratchFolder& folder, const std::string& baked, const Words& more) {
    std::string dem = folder / "sample/dem.tif";
    std::vector<std::pair<Words, bool>> work = {
        {{"bake-lod", "terrain", dem, "-o", folder / "b.ovl"}, false},
        {{"baked", "info", baked}, true},
        {{"baked", "verify", baked, "--source", dem}, true},
        {{"baked", "diff", baked, baked}, true},
        {{"baked", "export", baked, "--error-m", "5", "-o", folder / "b.ply"}, false},
        {{"make-sample", "dem", "--size", "65", "-o", folder / "new"}, false},
        {{"player", baked, "--headless", "--size", "64x64", "--image", folder / "b.png"}, false}};
    for (auto& [words, answers] : work) words = words + more;
    return work;
}

TEST(Report, IsJsonAloneOnStandardOutput) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    for (const auto& [words, answers] : all_work(folder, baked, {"--json", "--verbose"})) {
        SCOPED_TRACE(words[0] + " " + words[1]);
        Ran ran = run(words);
        expect_done(ran);
        nlohmann::json report = nlohmann::json::parse(ran.out, nullptr, false);
        EXPECT_TRUE(report.is_object()) << ran.out;
    }
}

TEST(Quiet, SaysNothingButTheAnswerAskedFor) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    for (const auto& [words, answers] : all_work(folder, baked, {"--quiet"})) {
        SCOPED_TRACE(words[0] + " " + words[1]);
        Ran ran = run(words);
        expect_done(ran);
        EXPECT_EQ(ran.err, "");
        EXPECT_EQ(!ran.out.empty(), answers) << ran.out;
    }
}

TEST(Talk, GoesToStandardErrorAndShowsNoProgressInAPipe) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    for (const auto& [words, answers] : all_work(folder, baked, {})) {
        SCOPED_TRACE(words[0] + " " + words[1]);
        Ran ran = run(words);
        expect_done(ran);
        EXPECT_EQ(!ran.out.empty(), answers) << ran.out;
        EXPECT_EQ(ran.err.find('\r'), std::string::npos) << ran.err;
        EXPECT_EQ(ran.err.find("% "), std::string::npos) << ran.err;
        EXPECT_EQ(ran.err.find("left\n"), std::string::npos) << ran.err;
    }
}

TEST(Diff, AnswersByItsExitCode) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    EXPECT_EQ(run({"baked", "diff", baked, baked}).exit, 0);
    expect_done(
        run({"bake-lod", "terrain", folder / "sample/dem.tif", "-o", folder / "b.ovl", "--window", "0,0,33,33", "--quiet"}));
    Ran ran = run({"baked", "diff", baked, folder / "b.ovl"});
    EXPECT_EQ(ran.exit, 1);
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out, "");
}

}  // namespace
}  // namespace overlook::cli
