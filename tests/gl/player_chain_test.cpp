// The player of chains of levels and their instances.
#include "formats/discrete.h"
#include "tests/gl/player_fixture.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook {
namespace {

using test::kPlayer;

class ChainPlayer : public test::Player {
  protected:
    void SetUp() override {
        Player::SetUp();
        chain_ = in_folder("chain.ovl");
        auto writer = container::Writer::create(chain_, discrete::kKind);
        ASSERT_TRUE(writer);
        auto written = discrete::write(*writer, discrete::made::simple_chain());
        ASSERT_TRUE(written) << written.error().message;
        ASSERT_TRUE(writer->add_provenance({"test", "0", {}, {}}));
        ASSERT_TRUE(writer->commit());
        write("scene.json", scene("chain.ovl", R"("method": "discrete", )"));
        write("flight.json", R"({"version": 1, "step_s": 0.125, "interpolation": "linear", "keys": [
          {"time_s": 0, "position_m": [4, -6, 4], "heading_deg": 0, "pitch_deg": -8},
          {"time_s": 4, "position_m": [4, -206, 4], "heading_deg": 0, "pitch_deg": -1}]})");
    }
    // Nine of it in a row, beyond each other.
    static std::string scene(const std::string& asset, const std::string& members) {
        std::string instances;
        for (int i = 0; i < 9; ++i)
            instances += fmt::format("{}{{\"translation_m\": [{}, {}, 0]}}", i == 0 ? "" : ", ", i, 2.8 * i);
        return fmt::format(R"({{"version": 1, "layers": [{{"asset": "{}", {}"instances": [{}]}}]}})", asset, members, instances);
    }
    std::string flown(const std::string& method, const std::string& picture) const {
        return in_folder("scene.json") + " --method " + method + " --flight " + in_folder("flight.json") +
               " --samples 1 --size 128x96 --report " + in_folder("report.json") + " --image " + in_folder(picture);
    }
    std::string chain_;
};

TEST_F(ChainPlayer, DrawsItsInstancesByEveryMethodWithinTheErrorAsked) {
    for (const char* method : {"discrete", "discrete:fsi", "discrete:fsi-paper", "discrete:switch", "discrete:blend",
                               "discrete:dither", "discrete:late"}) {
        SCOPED_TRACE(method);
        ASSERT_EQ(play(flown(method, "chain.png") + " --headless"), 0) << output_;
        nlohmann::json json = report();
        EXPECT_EQ(json["method"], method);
        ASSERT_GE(json["frames"].size(), 16u);
        uint64_t begun = 0;
        for (const auto& frame : json["frames"]) {
            begun += frame["changes_begun"].get<uint64_t>();
            EXPECT_GT(frame["draw_calls"].get<int>(), 0);
            EXPECT_LE(frame["predicted_error_px"].get<double>(), 1);
        }
        EXPECT_GE(begun, 9u);  // each once at least on the way from 6 to 28 m to 206
        const auto &first = json["frames"].front(), &last = json["frames"].back();
        EXPECT_EQ(last["instances_in_view"], 9);
        EXPECT_LT(last["triangles"].get<int>(), first["triangles"].get<int>() / 2);
    }
}

TEST_F(ChainPlayer, DrawsDiscreteAsFsi) {
    ASSERT_EQ(play(flown("discrete", "a.png") + " --headless"), 0) << output_;
    ASSERT_EQ(play(flown("discrete:fsi", "b.png") + " --headless"), 0) << output_;
    ASSERT_EQ(play(flown("discrete:switch", "c.png") + " --frames 6 --headless"), 0) << output_;
    ASSERT_EQ(play(flown("discrete:fsi", "d.png") + " --frames 6 --headless"), 0) << output_;
    EXPECT_TRUE(bytes("a.png") == bytes("b.png"));
    EXPECT_TRUE(bytes("c.png") != bytes("d.png"));  // on the way between levels
}

TEST_F(ChainPlayer, DrawsInAWindowAsWithoutOne) {
    OVERLOOK_NEEDS_A_DISPLAY();
    ASSERT_EQ(run("xvfb-run -a " + kPlayer + " " + flown("discrete", "window.png") + " --frames 9"), 0) << output_;
    ASSERT_EQ(play(flown("discrete", "headless.png") + " --frames 9 --headless"), 0) << output_;
    EXPECT_TRUE(bytes("window.png") == bytes("headless.png"));
}

TEST_F(ChainPlayer, ShowsTheWholeOfItWhereNobodySaysWhereFrom) {
    ASSERT_EQ(
        play(chain_ + " --headless --size 96x64 --image " + in_folder("whole.png") + " --report " + in_folder("report.json")), 0)
        << output_;
    EXPECT_EQ(report()["frames"].back()["instances_in_view"], 1);
}

TEST_F(ChainPlayer, DrawsSeveralChainsAsTheyStandInTheScene) {
    // The same nine in one layer, and in two that are moved back to where they were.
    ASSERT_EQ(play(flown("discrete", "one.png") + " --frames 6 --headless"), 0) << output_;
    uint64_t triangles = report()["frames"].back()["triangles"];
    std::string near, far;
    for (int i = 0; i < 9; ++i)
        (i < 4 ? near : far) +=
            fmt::format("{}{{\"translation_m\": [{}, {}, 0]}}", i % 4 == 0 && i < 8 ? "" : ", ", i < 4 ? i : i - 100, 2.8 * i);
    std::string asset = R"({"asset": "chain.ovl", "method": "discrete", )";
    write("scene.json", fmt::format(R"({{"version": 1, "layers": [{}"instances": [{}]}},
            {}"transform": {{"translation_m": [100, 0, 0]}}, "instances": [{}]}}]}})",
                                    asset, near, asset, far));
    ASSERT_EQ(play(flown("discrete", "two.png") + " --frames 6 --headless"), 0) << output_;
    EXPECT_EQ(report()["frames"].back()["triangles"], triangles);
    EXPECT_EQ(report()["frames"].back()["instances_in_view"], 9);
    EXPECT_TRUE(bytes("one.png") == bytes("two.png"));

    write("mixed.json", R"({"version": 1, "layers": [{"asset": "chain.ovl", "method": "discrete"},
      {"asset": "hills.ovl", "method": "discrete"}]})");
    EXPECT_EQ(play(in_folder("mixed.json") + " --headless"), 5);
    EXPECT_NE(output_.find("/layers/1: "), std::string::npos) << output_;
    EXPECT_NE(output_.find("the player draws chains of levels alone"), std::string::npos) << output_;
    write("mixed.json", R"({"version": 1, "layers": [{"asset": "chain.ovl", "method": "discrete"},
      {"asset": "chain.ovl", "method": "discrete:switch"}]})");
    EXPECT_EQ(play(in_folder("mixed.json") + " --headless"), 5);
    EXPECT_NE(output_.find("/layers/1: asks for another method"), std::string::npos) << output_;
}

TEST_F(ChainPlayer, MovesItsInstancesWithTheFlight) {
    // The fifth frame is at 0.5 s.
    auto scene_of = [](const char* instance) {
        return fmt::format(
            R"({{"version": 1, "layers": [{{"asset": "chain.ovl", "method": "discrete:switch", "instances": [{}]}}]}})",
            instance);
    };
    auto draw = [&](const char* instance, const char* picture) {
        write("scene.json", scene_of(instance));
        ASSERT_EQ(play(flown("discrete:switch", picture) + " --frames 5 --headless"), 0) << output_;
    };
    draw(R"({"translation_m": [2, 3, 1], "velocity_m_s": [4, 2, -1], "spin_deg_s": 60})", "moved.png");
    draw(R"({"translation_m": [4, 4, 0.5], "rotation_z_deg": 30})", "there.png");
    draw(R"({"translation_m": [2, 3, 1]})", "before.png");
    EXPECT_TRUE(bytes("moved.png") == bytes("there.png"));
    EXPECT_TRUE(bytes("moved.png") != bytes("before.png"));
}

// Five of the nine are spheres without a budget.
constexpr char kNear[] = R"({"version": 1, "step_s": 0.03125, "interpolation": "linear", "keys": [
  {"time_s": 0, "position_m": [4, -14, 4], "heading_deg": 0, "pitch_deg": -8},
  {"time_s": 1.5, "position_m": [4, -12, 4], "heading_deg": 0, "pitch_deg": -8}]})";

// Half of what is taken without a budget: kept in every frame once the changes that it asked for are over, at an error that says
// so.
TEST_F(ChainPlayer, KeepsABudgetOfTriangles) {
    write("flight.json", kNear);
    for (const char* method : {"discrete", "discrete:blend", "discrete:late"}) {
        SCOPED_TRACE(method);
        std::string line = flown(method, "chain.png") + " --headless";
        ASSERT_EQ(play(line), 0) << output_;
        uint64_t free = report()["frames"].back()["triangles"];
        for (double share : {0.5, 0.25}) {
            auto budget = uint64_t(share * double(free));
            ASSERT_EQ(play(line + " --triangles " + std::to_string(budget)), 0) << output_;
            nlohmann::json frames = report()["frames"];
            for (const auto& frame : frames) {
                EXPECT_LE(frame["settled_triangles"].get<uint64_t>(), budget);
                EXPECT_GT(frame["asked_error_px"].get<double>(), 1);
                EXPECT_LE(frame["predicted_error_px"].get<double>(), frame["asked_error_px"].get<double>());
            }
            EXPECT_LE(frames.back()["triangles"].get<uint64_t>(), budget);
        }
        ASSERT_EQ(play(line + " --triangles " + std::to_string(2 * free)), 0) << output_;
        EXPECT_EQ(report()["frames"].back()["triangles"], free);
        EXPECT_EQ(report()["frames"].back()["asked_error_px"], 1);
    }
}

// A time that no frame keeps takes the fewest triangles that there are; one that all keep changes nothing.
TEST_F(ChainPlayer, KeepsATimeByTriangles) {
    write("flight.json", kNear);
    std::string line = flown("discrete", "chain.png") + " --headless";
    ASSERT_EQ(play(line), 0) << output_;
    nlohmann::json free = report()["frames"];
    ASSERT_EQ(play(line + " --frame-ms 600000"), 0) << output_;
    EXPECT_EQ(report()["frames"].back()["triangles"], free.back()["triangles"]);
    EXPECT_EQ(report()["frames"].front()["asked_error_px"], 1);
    ASSERT_EQ(play(line + " --frame-ms 0.001"), 0) << output_;
    nlohmann::json frames = report()["frames"];
    EXPECT_EQ(frames[12]["triangles"], 9 * 12);  // cubes
    EXPECT_GT(free[12]["triangles"].get<uint64_t>(), 9 * 12);
    EXPECT_GT(frames[12]["asked_error_px"].get<double>(), 1);
}

TEST_F(ChainPlayer, RefusesInOneLine) {
    write("hills.json", scene("hills.ovl", R"("method": "discrete", )"));
    EXPECT_EQ(play(in_folder("hills.json") + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_NE(output_.find("discrete draws meshes and chains of levels, and"), std::string::npos) << output_;
    EXPECT_EQ(play(chain_ + " --headless --method caveclod"), 2);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_NE(output_.find("discrete, discrete:fsi-paper"), std::string::npos) << output_;
    EXPECT_EQ(play(file_ + " --headless --method discrete:blend"), 2);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_EQ(play(chain_ + " --headless --stream-memory 4M"), 5);
    EXPECT_NE(output_.find("a chain of levels is read whole"), std::string::npos) << output_;
    write("scene.json", scene("chain.ovl", R"("method": "discrete", "settings": {"transition-s": -1}, )"));
    EXPECT_EQ(play(in_folder("scene.json") + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
}

}  // namespace
}  // namespace overlook
