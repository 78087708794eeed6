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
    EXPECT_EQ(output_, "player: --method discrete: it draws meshes and chains of levels, and " + file_ +
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

// Of a mesh in parts.
class StreamedMeshPlayer : public MeshPlayer {
  protected:
    std::string streamed(const std::string& image, const std::string& more) const {
        return flown("caveclod") + in_folder(image) + " --headless " + more;
    }
    // Changes a byte of the last block.
    std::string damaged() const {
        std::string file = bytes("sphere.ovl");
        auto reader = container::Reader::open_bytes(std::as_bytes(std::span(file)), "sphere.ovl");
        const container::Section& blocks = *reader->find(container::tag("MBLK"));
        file[size_t(blocks.offset + blocks.stored_bytes - 50)] ^= 1;
        write("damaged.ovl", file);
        return in_folder("damaged.ovl");
    }
};

TEST_F(StreamedMeshPlayer, DrawsTheSamePicturesWhereMemorySuffices) {
    ASSERT_EQ(play(streamed("whole%d.png", "--error-px 0.2")), 0) << output_;
    ASSERT_EQ(play(streamed("parts%d.png", "--error-px 0.2 --stream-memory 1G")), 0) << output_;
    for (int frame = 0; frame < 12; ++frame) {
        std::string number = std::to_string(frame) + ".png";
        EXPECT_EQ(bytes("parts" + number), bytes("whole" + number)) << frame;
    }
    for (const auto& frame : report()["frames"]) {
        EXPECT_EQ(frame["resident_blocks"], frame["blocks"]);
        EXPECT_EQ(frame["missing_error_px"], 0);
        EXPECT_LE(frame["predicted_error_px"].get<double>(), 0.2);
    }
}

TEST_F(StreamedMeshPlayer, KeepsItsMemorySaysWhichErrorAndDrawsTheSameAgain) {
    const std::string little = "--error-px 0.2 --stream-memory 2M";
    ASSERT_EQ(play(streamed("a%d.png", little)), 0) << output_;
    for (const auto& frame : report()["frames"]) {
        EXPECT_LE(frame["resident_bytes"].get<uint64_t>(), 2u << 20);
        EXPECT_LT(frame["resident_blocks"], frame["blocks"]);
        EXPECT_GE(frame["predicted_error_px"], frame["missing_error_px"]);
        EXPECT_GT(frame["missing_error_px"].get<double>(), 0.2);
    }
    ASSERT_EQ(play(streamed("b%d.png", little)), 0) << output_;
    for (int frame = 0; frame < 12; ++frame)
        EXPECT_EQ(bytes("a" + std::to_string(frame) + ".png"), bytes("b" + std::to_string(frame) + ".png")) << frame;
}

TEST_F(StreamedMeshPlayer, GrowsFromFrameToFrameWherePicturesDoNotWait) {
    std::string still = mesh_ +
                        " --headless --samples 1 --size 160x120 --frames 12 --camera 0,-30,5,4,-10 --error-px 0.2 --report " +
                        in_folder("report.json") + " --image ";
    ASSERT_EQ(play(still + in_folder("whole.png")), 0) << output_;
    ASSERT_EQ(play(still + in_folder("parts%d.png") + " --stream-memory 1G --stream-latency 2"), 0) << output_;
    double error_px = 1e300;
    uint64_t triangles = 0, grown = 0, uploaded = 0;
    nlohmann::json json = report();
    for (const auto& frame : json["frames"]) {
        EXPECT_LE(frame["predicted_error_px"].get<double>(), error_px);
        grown += frame["triangles"].get<uint64_t>() > triangles;
        error_px = frame["predicted_error_px"], triangles = frame["triangles"];
        if (frame["streamed_bytes"] == 0) continue;
        EXPECT_GT(frame["resident_blocks"].get<int>(), 1);
        ++uploaded;
    }
    EXPECT_GE(grown, 3u);
    EXPECT_GE(uploaded, 2u);
    EXPECT_LE(error_px, 0.2);
    EXPECT_NE(bytes("parts0.png"), bytes("whole.png"));
    EXPECT_EQ(bytes("parts11.png"), bytes("whole.png"));
}

TEST_F(StreamedMeshPlayer, RefusesInOneLine) {
    auto refused = [&](int exit, const std::string& options, const std::vector<std::string>& parts) {
        EXPECT_EQ(play(options + " --headless --image " + in_folder("x.png")), exit) << options;
        EXPECT_TRUE(is_one_line()) << output_;
        for (const std::string& part : parts) EXPECT_NE(output_.find(part), std::string::npos) << output_;
    };
    for (const char* method : {"discrete", "caveclod:paper", "caveclod:shared"})
        refused(2, mesh_ + " --stream-memory 64M --method " + method, {"--stream-memory", method, "terrain, caveclod and wang-ldi"});
    refused(2, mesh_ + " --stream-latency 2", {"--stream-latency", "--stream-memory"});
    refused(2, mesh_ + " --stream-memory 1M --stream-latency 5000", {"--stream-latency 5000", "1000"});
    refused(5, mesh_ + " --stream-memory 1K", {mesh_, "residency budget of 1,024"});
    refused(5, mesh_ + " --stream-memory 64M --upload-budget 1K", {mesh_, "upload budget of 1,024"});
    std::string broken = damaged();
    refused(3, broken + " --stream-memory 64M", {"damaged.ovl: M9: block", "damaged?"});
    // Where no picture waits it stays coarser, and says why once.
    EXPECT_EQ(play(broken + " --headless --size 64x48 --frames 8 --stream-memory 64M --stream-latency 1 --image " +
                   in_folder("x.png") + " --report " + in_folder("report.json")),
              0);
    size_t at = output_.find("damaged.ovl: M9: block");
    EXPECT_NE(at, std::string::npos) << output_;
    EXPECT_EQ(output_.find("M9", at + 20), std::string::npos) << output_;
    nlohmann::json json = report();
    EXPECT_EQ(json["frames"].back()["resident_blocks"].get<int>() + 1, json["frames"].back()["blocks"].get<int>());
}

}  // namespace
}  // namespace overlook
