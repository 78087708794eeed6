// The player of planted ground.
#include "runtime/gl/png.h"
#include "tests/gl/planting_file.h"
#include "tests/gl/player_fixture.h"

namespace overlook {
namespace {

class PlantingPlayer : public test::Player {
  protected:
    void SetUp() override {
        Player::SetUp();
        mounds_ = in_folder("mounds.ovl");
        wang_ldi::write_mounds(mounds_);
    }
    std::string drawn(const std::string& file, const std::string& picture) const {
        return file + " --headless --samples 1 --size 160x120 --report " + in_folder("report.json") + " --image " +
               in_folder(picture) + " ";
    }
    void write_scene(const std::string& planting) const {
        write("scene.json", R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "terrain"},
          {"asset": "mounds.ovl", "method": "wang-ldi")" +
                                planting + "}]}");
    }
    // Fails, in one line that ends so.
    void expect_refused(int exit, const std::string& options, const std::string& end) {
        EXPECT_EQ(play(in_folder("scene.json") + " --headless --size 8x8 " + options), exit);
        EXPECT_TRUE(is_one_line() && output_.ends_with(end + "\n")) << output_;
    }
    std::string mounds_;
};

TEST_F(PlantingPlayer, DrawsABakedPlantingOnAPlain) {
    ASSERT_EQ(play(drawn(mounds_, "own.png")), 0) << output_;
    nlohmann::json json = report(), frame = json["frames"][0];
    EXPECT_EQ(json["method"], "wang-ldi");
    EXPECT_GT(frame["samples_warped"].get<int>(), 1000);
    EXPECT_GT(frame["tiles"].get<int>(), 20);
    EXPECT_EQ(frame["missing_images"], 0);
    EXPECT_EQ(frame["stand_in_images"], 0);
    EXPECT_EQ(frame["latency_frames"], 0);
    EXPECT_GE(frame["warp_threads"].get<int>(), 1);
    EXPECT_NE(output_.find(" samples of "), std::string::npos) << output_;
    ASSERT_EQ(play(drawn(mounds_, "paper.png") + "--method wang-ldi:paper"), 0) << output_;
    EXPECT_EQ(report()["frames"][0]["far_blocks"], 0);
    ASSERT_EQ(play(drawn(mounds_, "rings.png") + "--rings"), 0) << output_;
    ASSERT_EQ(play(drawn(mounds_, "one.png") + "--threads 1"), 0) << output_;
    EXPECT_TRUE(bytes("own.png") == bytes("one.png"));
    EXPECT_FALSE(bytes("own.png") == bytes("rings.png"));
    EXPECT_FALSE(bytes("own.png") == bytes("paper.png"));
}

TEST_F(PlantingPlayer, SaysWhereImagesWereNotSampledFor) {
    ASSERT_EQ(play(drawn(mounds_, "in.png") + "--camera 0,0,1.7,0,-4"), 0) << output_;
    EXPECT_EQ(report()["frames"][0]["eye_outside_cell"], false);
    EXPECT_EQ(output_.find("not sampled for"), std::string::npos) << output_;
    int inside = report()["frames"][0]["outside_cell_tiles"], tiles = report()["frames"][0]["tiles"];
    EXPECT_LT(inside, tiles / 4);  // those at the eye's feet, and behind the farthest
    ASSERT_EQ(play(drawn(mounds_, "above.png") + "--camera 0,0,9,0,-30"), 0) << output_;
    EXPECT_EQ(report()["frames"][0]["eye_outside_cell"], true);
    EXPECT_GT(report()["frames"][0]["outside_cell_tiles"].get<int>(), 4 * inside);
    EXPECT_NE(output_.find("1 from heights that images were not sampled for"), std::string::npos) << output_;
}

TEST_F(PlantingPlayer, PlantsATerrainWhereTheSceneSays) {
    write_scene(R"(, "planting": {"steepest": 50})");
    std::string scene = in_folder("scene.json");
    ASSERT_EQ(play(drawn(scene, "all.png")), 0) << output_;
    EXPECT_GT(report()["frames"][0]["tiles"].get<int>(), 10);
    EXPECT_GT(report()["frames"][0]["triangles"].get<int>(), 50);
    write_scene(R"(, "planting": {"steepest": 50, "lowest_m": 5000})");
    ASSERT_EQ(play(drawn(scene, "none.png")), 0) << output_;
    EXPECT_EQ(report()["frames"][0]["tiles"], 0);
    EXPECT_FALSE(bytes("all.png") == bytes("none.png"));

    // Half of it painted.
    ASSERT_TRUE(write_png(in_folder("mask.png"), {2, 1, {0, 0, 0, 255, 255, 255}}));
    write_scene(R"(, "planting": {"steepest": 50, "mask": "mask.png"})");
    ASSERT_EQ(play(drawn(scene, "half.png")), 0) << output_;
    EXPECT_FALSE(bytes("half.png") == bytes("none.png"));
    EXPECT_FALSE(bytes("half.png") == bytes("all.png"));
}

TEST_F(PlantingPlayer, FliesAsWithoutADelayButAFrameLate) {
    std::string flown = " --frames 3 --camera 0,0,1.7,0,-4 --camera 0,2,1.7,0,-4 ";
    ASSERT_EQ(play(drawn(mounds_, "now%d.png") + flown), 0) << output_;
    ASSERT_EQ(play(drawn(mounds_, "late%d.png") + flown + "--pipelined"), 0) << output_;
    EXPECT_EQ(report()["frames"][2]["latency_frames"], 1);
    EXPECT_TRUE(bytes("late0.png") == bytes("now0.png"));
    EXPECT_TRUE(bytes("late2.png") == bytes("now1.png"));
    EXPECT_FALSE(bytes("now1.png") == bytes("now2.png"));
}

TEST_F(PlantingPlayer, KeepsABudgetOfTrianglesByTheErrorThatItAsks) {
    write_scene(R"(, "planting": {"steepest": 50})");
    std::string flown =
        drawn(in_folder("scene.json"), "a.png") + "--frames 6 --camera 300,-560,240,0,-20 --camera 320,-500,240,0,-20 ";
    ASSERT_EQ(play(flown + "--error-px 0.2"), 0) << output_;
    nlohmann::json free = report()["frames"];
    int budget = free[0]["triangles"].get<int>() / 2;
    ASSERT_GT(budget, 400);
    ASSERT_EQ(play(flown + "--error-px 0.2 --triangles " + std::to_string(budget)), 0) << output_;
    for (const nlohmann::json& frame : report()["frames"]) {
        EXPECT_LE(frame["triangles"].get<int>(), budget);
        EXPECT_GE(frame["triangles"].get<int>(), 0.9 * budget);
        EXPECT_GT(frame["asked_error_px"].get<double>(), 0.2);
        EXPECT_LE(frame["times_listed"].get<int>(), 24);
    }
    ASSERT_EQ(play(flown + "--error-px 0.2 --triangles 1"), 0) << output_;
    EXPECT_NEAR(report()["frames"][5]["asked_error_px"].get<double>(), 256, 0.01) << "as much as can be";
    EXPECT_EQ(report()["frames"][5]["times_listed"], 1) << "and it is not searched for again";
    ASSERT_EQ(play(flown + "--error-px 0.2 --triangles 100000000"), 0) << output_;
    EXPECT_EQ(report()["frames"][5]["triangles"], free[5]["triangles"]);
    EXPECT_EQ(report()["frames"][5]["asked_error_px"], 0.2);
    ASSERT_EQ(play(flown + "--frame-ms 100000"), 0) << output_;
}

TEST_F(PlantingPlayer, StreamsItsImages) {
    std::string flown = " --frames 8 --camera 0,0,1.7,0,-4 --camera 0,0.1,1.7,0,-4 ";
    ASSERT_EQ(play(drawn(mounds_, "a%d.png") + flown), 0) << output_;
    ASSERT_EQ(play(drawn(mounds_, "b%d.png") + flown + "--stream-memory 64M --stream-latency 2"), 0) << output_;
    nlohmann::json frames = report()["frames"];
    EXPECT_GT(frames[0]["stand_in_images"].get<int>(), 0);
    EXPECT_EQ(frames[7]["stand_in_images"], 0);
    EXPECT_FALSE(bytes("a0.png") == bytes("b0.png"));
    EXPECT_TRUE(bytes("a7.png") == bytes("b7.png"));
    EXPECT_EQ(play(drawn(mounds_, "c.png") + "--stream-memory 64"), 5);
    EXPECT_TRUE(is_one_line()) << output_;
}

TEST_F(PlantingPlayer, RefusesWhatItCannotPlant) {
    const std::string folder = folder_.string();
    write_scene(R"(, "planting": {"mask": "mask.png"})");
    EXPECT_EQ(play(in_folder("scene.json") + " --headless"), 3);
    EXPECT_TRUE(is_one_line() && output_.find("mask.png") != std::string::npos) << output_;
    write("mask.png", "no picture");
    expect_refused(3, "", "PNG is wanted");
    write_scene(R"(, "transform": {"scale": 2})");
    expect_refused(3, "", "/layers/1/transform: a planting stands where its ground is; move the terrain");
    write_scene(R"(, "settings": {"fad": 1})");
    expect_refused(3, "", "/layers/1/settings/fad: wang-ldi has no such setting; did you mean fade?");
    write_scene("");
    expect_refused(2, "--wireframe", "--wireframe: wang-ldi does not take it; --method terrain does");
    expect_refused(2, "--method terrain",
                   "--method terrain: it draws terrains, and " + in_folder("scene.json") +
                       " holds a planting; that takes wang-ldi, wang-ldi:paper");
    EXPECT_EQ(play(file_ + " --headless --rings"), 2);
    EXPECT_EQ(output_, "player: --rings: terrain does not take it; --method wang-ldi does\n");
    write("scene.json", R"({"version": 1, "layers": [{"asset": "mounds.ovl", "method": "wang-ldi"},
      {"asset": "mounds.ovl", "method": "wang-ldi"}]})");
    expect_refused(5, "", "mounds.ovl is a planting; the player draws one planting, on one terrain or a plain");
    write("scene.json", R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "lod-sprite"},
      {"asset": "mounds.ovl", "method": "wang-ldi"}]})");
    expect_refused(3, "", "/layers/0/method: lod-sprite; the ground of a planting is drawn by terrain");
    write("scene.json", R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "wang-ldi"}]})");
    expect_refused(3, "", "/layers/0/method: wang-ldi draws plantings, and " + folder + "/hills.ovl is a terrain");
}

}  // namespace
}  // namespace overlook
