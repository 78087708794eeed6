// The player of meshes.
#include <span>

#include "runtime/gl/png.h"
#include "tests/gl/player_fixture.h"

namespace overlook {
namespace {

using test::kPlayer;
using test::MeshPlayer;

TEST_F(MeshPlayer, DrawsItInEveryWayWithinTheErrorAsked) {
    for (const char* method : {"caveclod", "caveclod:paper", "caveclod:shared", "discrete"}) {
        SCOPED_TRACE(method);
        ASSERT_EQ(play(flown(method) + in_folder("sphere.png") + " --headless"), 0) << output_;
        nlohmann::json json = report();
        EXPECT_EQ(json["method"], method);
        ASSERT_EQ(json["frames"].size(), 12u);
        uint64_t operations = 0;
        for (const auto& frame : json["frames"]) {
            EXPECT_GT(frame["triangles"].get<int>(), 100);
            EXPECT_LE(frame["predicted_error_px"].get<double>(), 1);
            if (frame.contains("splits")) operations += frame["splits"].get<uint64_t>() + frame["collapses"].get<uint64_t>();
        }
        EXPECT_EQ(operations > 0, std::string(method) != "discrete");
    }
}

TEST_F(MeshPlayer, DrawsItBySprites) {
    ASSERT_EQ(play(flown("lod-sprite") + in_folder("sprite.png") + " --headless"), 0) << output_;
    nlohmann::json json = report();
    EXPECT_EQ(json["method"], "lod-sprite");
    uint32_t with_keys = 0;
    for (const auto& frame : json["frames"]) with_keys += frame["keys"].get<int>() > 0;
    EXPECT_GE(with_keys, 4u);
    EXPECT_EQ(play(mesh_ + " --method lod-sprite --haze 1 --headless"), 2);  // a mesh has none
    EXPECT_TRUE(is_one_line()) << output_;
}

TEST_F(MeshPlayer, DrawsInAWindowAsWithoutOne) {
    OVERLOOK_NEEDS_A_DISPLAY();
    ASSERT_EQ(run("xvfb-run -a " + kPlayer + " " + flown("caveclod") + in_folder("window.png")), 0) << output_;
    ASSERT_EQ(play(flown("caveclod") + in_folder("headless.png") + " --headless"), 0) << output_;
    EXPECT_EQ(bytes("window.png"), bytes("headless.png"));
}

TEST_F(MeshPlayer, ShowsTheWholeMeshWhereNobodySaysWhereFrom) {
    ASSERT_EQ(play(mesh_ + " --headless --size 96x64 --image " + in_folder("whole.png")), 0) << output_;
    std::string png = bytes("whole.png");
    auto picture = decode_png("whole.png", std::as_bytes(std::span(png)));
    ASSERT_TRUE(picture);
    auto is_background = [&](uint32_t x, uint32_t y) {  // which is blue rather than grey
        const uint8_t* at = &picture->pixels[4 * (size_t(y) * picture->width + x)];
        return at[2] > at[0] + 8;
    };
    EXPECT_FALSE(is_background(48, 32));
    for (uint32_t x = 0; x < 96; ++x) EXPECT_TRUE(is_background(x, 0) && is_background(x, 63)) << x;
}

TEST_F(MeshPlayer, RefusesMethodsOfTheOtherKind) {
    EXPECT_EQ(play(mesh_ + " --method terrain --headless"), 2);
    EXPECT_EQ(output_, "player: --method terrain: it draws terrains, and " + mesh_ +
                           " holds a mesh; that takes caveclod, caveclod:paper, caveclod:shared, discrete, lod-sprite\n");
    EXPECT_EQ(play(file_ + " --method discrete --headless"), 2);
    EXPECT_EQ(output_, "player: --method discrete: it draws meshes, and " + file_ +
                           " holds a terrain; that takes terrain, lod-sprite, lod-sprite:paper\n");
    EXPECT_EQ(play(mesh_ + " --morph 1 --headless"), 2);
    EXPECT_TRUE(is_one_line()) << output_;
    write("scene.json", R"({"version":1,"layers":[{"asset":"sphere.ovl","method":"lod-sprite:paper"}]})");
    EXPECT_EQ(play(in_folder("scene.json") + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_NE(output_.find("/layers/0/method: lod-sprite:paper draws terrains"), std::string::npos) << output_;
}

TEST_F(MeshPlayer, KeepsABudgetOfTriangles) {
    ASSERT_EQ(play(flown("caveclod") + in_folder("few.png") + " --headless --error-px 0.05 --triangles 600"), 0) << output_;
    for (const auto& frame : report()["frames"]) {
        EXPECT_LE(frame["triangles"].get<int>(), 600);
        EXPECT_GT(frame["predicted_error_px"].get<double>(), 0.05);
    }
    ASSERT_EQ(play(flown("caveclod:paper") + in_folder("few.png") + " --headless --error-px 0.05 --triangles 600"), 0) << output_;
    EXPECT_GT(report()["frames"].back()["asked_error_px"].get<double>(), 0.05);  // by the error alone
}

}  // namespace
}  // namespace overlook
