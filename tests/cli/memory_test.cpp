// --memory is a cap that is kept.

#include <gtest/gtest.h>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

// The least cap in M that the command says it would take.
std::string least_cap(const std::string& refusal) {
    size_t at = refusal.find("give it ");
    return at == std::string::npos ? "" : refusal.substr(at + 8, refusal.find('M', at) - at - 8);
}

TEST(Memory, RefusesLessThanTheProgramItselfTakesAndWorksWithWhatItNames) {
    ScratchFolder folder;
    std::string dem = make_dem(folder.path(), 65);
    auto before = contents_of(folder.path());
    Ran refused = run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--memory", "1000000"});
    expect_refusal(refused, 5, "bake-lod terrain", {"--memory 1000000", "M or more"});
    EXPECT_EQ(contents_of(folder.path()), before);

    std::string least = least_cap(refused.err);
    ASSERT_FALSE(least.empty()) << refused.err;
    expect_done(run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--memory", least + "M"}));
    expect_done(run({"bake-lod", "terrain", dem, "-o", folder / "b.ovl"}));
    EXPECT_EQ(text_of_file(folder / "a.ovl"), text_of_file(folder / "b.ovl"));  // a cap never changes the bytes
}

TEST(Memory, EndsALargeBakeUnderASmallCapInOneLine) {
    ScratchFolder folder;
    write_hgt(folder / "N10E010.hgt", 3601, hilly_m);
    write_text(folder / "out.ovl", "an older file");
    auto names = folder.names();
    std::vector<std::string> words{"bake-lod", "terrain", folder / "N10E010.hgt", "-o", folder / "out.ovl", "--threads",
                                   "2",        "--memory"};
    std::string least = least_cap(run([&] {
                                      auto tiny = words;
                                      tiny.push_back("1");
                                      return tiny;
                                  }())
                                      .err);
    ASSERT_FALSE(least.empty());
    for (int more : {0, 25, 60}) {
        auto capped = words;
        capped.push_back(std::to_string(std::stoi(least) + more) + "M");
        expect_refusal(run(capped), 5, "bake-lod terrain", {"memory"});
        EXPECT_EQ(folder.names(), names);
        EXPECT_EQ(text_of_file(folder / "out.ovl"), "an older file");
    }
}

}  // namespace
}  // namespace overlook::cli
