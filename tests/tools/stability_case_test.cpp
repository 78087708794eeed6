#include "tools/measure/stability_case.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

namespace overlook::measure {
namespace {

const std::string kFolder = OVERLOOK_SOURCE_DIR "/samples/stability";
const std::string kCase = R"({"version": 1, "number": "S16", "what": "drops",
"scene": "a.json", "flight": "b.json",
"settings": {"drop_every": 7, "world_moves_m": [1e5], "resize_shares": [0.5, 1], "budget_share": 0.5, "goes_backwards": true},
"gates": [{"figure": "pop_index", "most": 1.1, "of": "image"}, {"figure": "silhouette_p95_px", "over_asked_px": 1}],
"methods": ["terrain", "lod-sprite"],
"runs": ["terrain"],
"note": "known & said"})";

std::string error_of(const std::string& from, const std::string& to) {
    std::string text = kCase;
    size_t found = text.find(from);
    EXPECT_NE(found, std::string::npos) << from;
    Result<Case> made = parse_case(text.replace(found, from.size(), to), "c.json");
    return made ? "(read)" : made.error().message;
}

TEST(StabilityCase, IsReadAsItIsWritten) {
    Result<Case> made = parse_case(kCase, "c.json");
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->number, "S16");
    EXPECT_EQ(made->note, "known & said");
    EXPECT_EQ(made->settings.drop_every, 7u);
    EXPECT_EQ(made->settings.world_moves_m, std::vector<double>{1e5});
    EXPECT_EQ(made->settings.resize_shares, (std::vector<double>{0.5, 1}));
    EXPECT_EQ(made->settings.budget_share, 0.5);
    EXPECT_TRUE(made->settings.goes_backwards);
    ASSERT_EQ(made->gates.size(), 2u);
    EXPECT_EQ(made->gates[0].most, 1.1);
    EXPECT_EQ(made->gates[0].of, "image");
    EXPECT_LT(made->gates[0].over_asked_px, 0);
    EXPECT_EQ(made->gates[1].over_asked_px, 1);
    EXPECT_EQ(owed_cases({&*made, 1}), std::vector<std::string>{"S16 lod-sprite"});
}

TEST(StabilityCase, NamesThePlaceOfEveryMistake) {
    EXPECT_EQ(error_of("\"known & said\"", "7"), "c.json:7:9: /note: is a number; text is wanted");
    EXPECT_EQ(error_of("S16", "S1"), "c.json:1:26: /number: S1 is no case; S01 to S20 are");
    EXPECT_EQ(error_of("pop_index", "pop_idx"), "c.json:4:22: /gates/0/figure: pop_idx is no figure; did you mean pop_index?");
    EXPECT_EQ(error_of("\"most\": 1.1, ", ""), "c.json:4:11: /gates/0: has no bound: most or over_asked_px is wanted");
    EXPECT_EQ(error_of("\"most\": 1.1,", "\"most\": 1.1, \"over_asked_px\": 1,"),
              "c.json:4:11: /gates/0: has two bounds: most or over_asked_px is wanted");
    EXPECT_EQ(error_of("\"image\"", "\"sprites\""), "c.json:4:54: /gates/0/of: geometry, image, chain, planting or all is wanted");
    EXPECT_EQ(error_of("[\"terrain\"]", "[\"discrete\"]"), "c.json:6:10: /runs/0: discrete is not among the case's methods");
    EXPECT_EQ(error_of("\"lod-sprite\"", "\"terrain\""), "c.json:5:24: /methods/1: terrain stands twice");
    EXPECT_EQ(error_of("\"flight\": \"b.json\",", ""), "c.json:6:9: /runs: a case that runs needs a scene and a flight");
    EXPECT_EQ(error_of("7", "7.5"), "c.json:3:28: /settings/drop_every: is no whole number");
    EXPECT_EQ(error_of("1e5", "1e9"), "c.json:3:49: /settings/world_moves_m/0: a number from 0 to 100000000 is wanted");
    EXPECT_EQ(error_of("drop_every", "drop_evry"),
              "c.json:3:14: /settings/drop_evry: is not known here; did you mean drop_every?");
}

TEST(StabilitySuite, HasAllItsCases) {
    Result<std::vector<Case>> cases = read_cases(kFolder);
    ASSERT_TRUE(cases) << cases.error().message;
    ASSERT_EQ(cases->size(), 20u);
    std::set<std::string> figures;
    for (const Case& each : *cases) {
        for (const CaseGate& gate : each.gates) figures.insert(gate.figure);
        if (each.scene.empty()) continue;
        Result<scene::Scene> scene = scene::read_scene(each.scene);
        EXPECT_TRUE(scene) << scene.error().message;
        Result<scene::Flight> flight = scene::read_flight(each.flight);
        EXPECT_TRUE(flight) << flight.error().message;
    }
    EXPECT_EQ(figures.size(), figure_names().size());  // each figure is some case's
}

// Who makes a case ready takes its line out of owed_cases.txt: nothing is owed without standing there.
TEST(StabilitySuite, IsOwedExactlyWhatIsListed) {
    Result<std::vector<Case>> cases = read_cases(kFolder);
    ASSERT_TRUE(cases) << cases.error().message;
    std::string owed;
    for (const std::string& line : owed_cases(*cases)) owed += line + "\n";
    std::ifstream in(OVERLOOK_SOURCE_DIR "/tests/tools/owed_cases.txt");
    EXPECT_EQ(owed, std::string(std::istreambuf_iterator<char>(in), {}));
}

}  // namespace
}  // namespace overlook::measure
