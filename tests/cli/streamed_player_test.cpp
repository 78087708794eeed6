// player --stream-memory: a terrain flown over with a part of it in memory.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/container.h"
#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

std::string make_streamed(const ScratchFolder& folder) {
    std::string dem = make_dem(folder.path(), 1025);
    expect_done(run({"bake-lod", "terrain", dem, "-o", folder / "a.ovl", "--streamed", "--quiet"}));
    return folder / "a.ovl";
}

Words pictures(const std::string& file, const std::string& image, const std::string& report, Words more) {
    Words words{"player", file,      "--headless", "--size", "320x200",  "--frames",
                "6",      "--quiet", "--image",    image,    "--report", report};
    for (const char* camera : {"0,-9000,3000,45,-20", "9000,-9000,2500,0,-25", "15000,-1000,3000,200,-20"})
        words.insert(words.end(), {"--camera", camera});
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

nlohmann::json report_of(const std::string& path) {
    return nlohmann::json::parse(text_of_file(path));
}

TEST(StreamedPlayer, DrawsTheSamePicturesWhereMemorySufficesAndVerifiesItsFile) {
    ScratchFolder folder;
    std::string file = make_streamed(folder);
    expect_done(run({"baked", "info", file, "--quiet"}));
    expect_done(run(pictures(file, folder / "whole%d.png", folder / "whole.json", {})));
    expect_done(run(pictures(file, folder / "parts%d.png", folder / "parts.json", {"--stream-memory", "1G"})));
    for (int frame = 0; frame < 6; ++frame) {
        std::string number = std::to_string(frame) + ".png";
        EXPECT_EQ(text_of_file(folder / ("parts" + number)), text_of_file(folder / ("whole" + number))) << frame;
    }
    nlohmann::json report = report_of(folder / "parts.json");
    ASSERT_EQ(report["frames"].size(), 6u);
    for (const auto& frame : report["frames"]) EXPECT_EQ(frame["stopped_triangles"], 0);
}

TEST(StreamedPlayer, KeepsItsMemorySaysWhichErrorAndDrawsTheSameAgain) {
    ScratchFolder folder;
    std::string file = make_streamed(folder);
    Words little{"--stream-memory", "500K", "--upload-budget", "240K", "--error-px", "0.02"};
    expect_done(run(pictures(file, folder / "a%d.png", folder / "a.json", little)));
    expect_done(run(pictures(file, folder / "b%d.png", folder / "b.json", little)));
    uint64_t stopped = 0;
    nlohmann::json report = report_of(folder / "a.json");
    ASSERT_EQ(report["frames"].size(), 6u);
    for (const auto& frame : report["frames"]) {
        EXPECT_LE(frame["resident_bytes"].get<uint64_t>(), 500u * 1024);
        uint64_t count = frame["stopped_triangles"];
        stopped += count;
        if (count > 0) {
            EXPECT_GT(frame["predicted_error_px"].get<double>(), 0.02);
        } else {
            EXPECT_LE(frame["predicted_error_px"].get<double>(), 0.02);
        }
    }
    EXPECT_GT(stopped, 0u);
    for (int frame = 0; frame < 6; ++frame)
        EXPECT_EQ(text_of_file(folder / fmt::format("a{}.png", frame)), text_of_file(folder / fmt::format("b{}.png", frame)));
}

TEST(StreamedPlayer, RefusesInOneLine) {
    ScratchFolder folder;
    std::string file = make_streamed(folder), plain = make_baked(folder.path(), 65), image = folder / "x.png";
    auto refused = [&](int exit, const Words& more, const std::vector<std::string>& parts) {
        Words words{"player"};
        words.insert(words.end(), more.begin(), more.end());
        words.insert(words.end(), {"--headless", "--image", image});
        expect_refusal(run(words), exit, "player", parts);
    };
    refused(2, {file, "--upload-budget", "1M"}, {"--upload-budget", "--stream-memory"});
    refused(2, {file, "--stream-memory", "64M", "--method", "lod-sprite"}, {"--stream-memory", "lod-sprite"});
    refused(2, {file, "--stream-memory", "lots"}, {"--stream-memory", "lots"});
    refused(3, {plain, "--stream-memory", "64M"}, {plain, "--streamed"});
    refused(5, {file, "--stream-memory", "100K"}, {file, "budget of 102,400"});

    std::string bytes = text_of_file(file);
    Result<container::Reader> reader = container::Reader::open(file);
    ASSERT_TRUE(reader);
    const container::Section& blocks = *reader->find(container::tag("TBLK"));
    for (uint64_t at = blocks.offset + blocks.stored_bytes / 2; at < blocks.offset + blocks.stored_bytes; at += 1000)
        bytes[size_t(at)] ^= 1;
    write_text(folder / "damaged.ovl", bytes);
    refused(3, {folder / "damaged.ovl", "--stream-memory", "64M", "--error-px", "0.2"}, {"damaged.ovl: T11: block", "damaged?"});
    refused(3, {folder / "damaged.ovl"}, {"damaged.ovl: T11: block", "damaged?"});
}

}  // namespace
}  // namespace overlook::cli
