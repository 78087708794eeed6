// bake-wang-ldi makes layered depth images: the same bytes whatever threads, goes on after kill -9, in parts; one line for bad
// options. They become points and pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "formats/wang_ldi.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/mesh/soup.h"

namespace overlook::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// A bush of one model: a cone of 24 triangles, 0.6 m high, green.
void write_bushes(const ScratchFolder& folder) {
    std::string obj = "v 0 0 0.6\n";
    for (int i = 0; i < 24; ++i) {
        double angle = 6.283185307179586 * i / 24;
        obj += fmt::format("v {} {} {}\n", 0.25 * std::cos(angle), 0.25 * std::sin(angle), i % 2 ? 0.0 : 0.1);
    }
    for (int i = 0; i < 24; ++i) obj += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % 24 + 2);
    write_text(folder / "bush.obj", obj);
    write_text(folder / "bushes.toml",
               "tile_size_m = 3\n\n[[model]]\nfile = \"bush.obj\"\npacking_radius_m = 0.3\ntight_radius_m = 0.26\n");
}

Words words_of(const ScratchFolder& folder, const std::string& output, const Words& more = {}) {
    Words words{"bake-wang-ldi",
                folder / "bushes.toml",
                "-o",
                folder / output,
                "--tiles",
                "1",
                "--variants",
                "3",
                "--height-px",
                "160",
                "--error-px",
                "2",
                "--sky-rays",
                "8",
                "--sun-rays",
                "2",
                "--direction-px",
                "52",
                "--farthest-m",
                "30",
                "--textures",
                "4"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::string read_ldis(const std::string& path, uint64_t& samples) {
    auto file = container::Reader::open(path);
    if (!file) return file.error().message;
    auto images = wang_ldi::ImageReader::open(*file);
    if (!images) return images.error().message;
    for (uint64_t i = 0; i < images->set().ldi_count(); ++i) {
        auto ldi = images->read(i);
        if (!ldi) return ldi.error().message;
        samples += ldi->sample_count();
    }
    return "";
}

TEST(BakeWangImages, SaysWhatItHasMadeAndCanBeRead) {
    ScratchFolder folder;
    write_bushes(folder);
    Ran ran = run(words_of(folder, "a.ovl", {"--json", "--judge", "60"}));
    expect_done(ran);
    nlohmann::json report = nlohmann::json::parse(ran.out)["images"];
    EXPECT_GE(report["levels"].size(), 2u);
    EXPECT_EQ(report["images"], 3 * report["levels"].size() * report["directions"].get<size_t>());
    EXPECT_LE(report["unseen_share_most"], 0.02);
    EXPECT_GT(report["among_foreign_neighbours"]["pixels"], 100);
    EXPECT_LT(report["bytes_per_sample"], 3.5);
    for (const auto& level : report["levels"]) EXPECT_EQ(level["by_direction"].size(), report["directions"]);
    uint64_t samples = 0;
    EXPECT_EQ(read_ldis(folder / "a.ovl", samples), "");
    EXPECT_EQ(samples, report["samples"]);
    EXPECT_FALSE(fs::exists(folder / "a.ovl.parts"));
    expect_done(run({"baked", "info", folder / "a.ovl"}));
}

TEST(BakeWangImages, OnTrialMakesNoFileAndSaysTheSameOfItsTiles) {
    ScratchFolder folder;
    write_bushes(folder);
    auto before = contents_of(folder.path());
    Ran ran = run(words_of(folder, "a.ovl", {"--json", "--trial", "2", "--judge", "40"}));
    expect_done(ran);
    EXPECT_EQ(contents_of(folder.path()), before);
    nlohmann::json trial = nlohmann::json::parse(ran.out)["images"];
    EXPECT_EQ(trial["trial_tiles"], 2);
    EXPECT_EQ(trial["images"], 2 * trial["levels"].size() * trial["directions"].get<size_t>());
    EXPECT_GT(trial["among_its_neighbours"]["e_mean"], 0);
    EXPECT_GE(trial["among_its_neighbours"]["e_p99"], trial["among_its_neighbours"]["e_mean"]);
    EXPECT_LE(trial["among_its_neighbours"]["filled_hole_share"], trial["among_its_neighbours"]["hole_share"]);
    // Threads change none of it but the time.
    Ran alone = run(words_of(folder, "a.ovl", {"--json", "--trial", "2", "--judge", "40", "--threads", "1"}));
    nlohmann::json again = nlohmann::json::parse(alone.out)["images"];
    trial.erase("seconds"), again.erase("seconds");
    EXPECT_TRUE(trial == again);
    // What is timed besides changes none of it either, and every ray is shot again.
    Ran timed = run(words_of(folder, "a.ovl", {"--json", "--trial", "2", "--judge", "40", "--rate"}));
    nlohmann::json with_rate = nlohmann::json::parse(timed.out)["images"], rate = with_rate["rate"];
    EXPECT_EQ(rate["rays"], with_rate["rays"]);
    EXPECT_GT(rate["shadow_rays"], with_rate["samples"]);
    for (const char* share : {"sampling_share", "share"}) EXPECT_GT(rate[share], 0);
    with_rate.erase("rate"), with_rate.erase("seconds");
    EXPECT_TRUE(with_rate == again);
    expect_refusal(run(words_of(folder, "a.ovl", {"--rate"})), 2, "bake-wang-ldi", {"--rate: times a trial"});
    expect_refusal(run(words_of(folder, "a.ovl", {"--trial", "1", "--part", "1/2"})), 2, "bake-wang-ldi",
                   {"--trial 1 and --part"});
}

TEST(BakeWangImages, OfGlossyModelsHaveOtherColours) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "a.ovl")));
    std::string recipe = text_of_file(folder / "bushes.toml");
    write_text(folder / "bushes.toml", recipe + "roughness = 0.3\n");
    expect_done(run(words_of(folder, "b.ovl")));
    expect_done(run(words_of(folder, "c.ovl", {"--gloss", "none"})));
    std::array<std::vector<wang_ldi::Ldi>, 3> ldis;
    for (size_t i = 0; i < 3; ++i) {
        auto file = container::Reader::open(folder / (std::string(1, char('a' + i)) + ".ovl"));
        auto images = wang_ldi::ImageReader::open(*file);
        for (uint64_t index : {0u, 1u}) ldis[i].push_back(*images->read(index));
    }
    EXPECT_TRUE(ldis[0] == ldis[2]);
    EXPECT_FALSE(ldis[0] == ldis[1]);
    EXPECT_TRUE(ldis[0][0].heights == ldis[1][0].heights);
    write_text(folder / "bushes.toml", recipe + "roughness = 1.5\n");
    expect_refusal(run(words_of(folder, "b.ovl")), 3, "bake-wang-ldi",
                   {"bushes.toml:7", "model 1", "roughness: 1.5 is not a number"});
}

TEST(BakeWangImages, AreVerifiedByThemselvesAndTold) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "a.ovl")));
    Ran ran = run({"baked", "verify", folder / "a.ovl", "--json"});
    expect_done(ran);
    nlohmann::json proof = nlohmann::json::parse(ran.out);
    EXPECT_EQ(proof["holds"], true);
    ran = run({"baked", "info", folder / "a.ovl", "--json"});
    expect_done(ran);
    nlohmann::json info = nlohmann::json::parse(ran.out);
    EXPECT_EQ(info["textures"]["side_px"], 4);
    EXPECT_GT(proof["textures"], 0);
    EXPECT_EQ(info["textures"]["count"], proof["textures"]);
    EXPECT_EQ(info["images"]["images"], proof["images"]);
    EXPECT_GT(info["textures"]["opacity_mean"], 0.05);
    expect_done(run({"baked", "info", folder / "a.ovl"}));
    expect_refusal(run({"baked", "verify", folder / "a.ovl", "--source", folder / "bush.obj"}), 2, "baked verify",
                   {"is verified by itself"});
    std::string bytes = text_of_file(folder / "a.ovl");
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    write_text(folder / "b.ovl", bytes);
    EXPECT_EQ(run({"baked", "verify", folder / "b.ovl"}).exit, 3);
}

TEST(BakeWangImages, WritesSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    write_bushes(folder);
    std::string first;
    for (const char* threads : {"1", "2", "3"}) {
        expect_done(run(words_of(folder, "a.ovl", {"--threads", threads})));
        std::string bytes = text_of_file(folder / "a.ovl");
        if (first.empty()) first = bytes;
        EXPECT_TRUE(bytes == first) << threads;
    }
}

// That are whole; of a folder that comes and goes meanwhile.
size_t parts_in(const std::string& folder) {
    size_t count = 0;
    std::error_code problem;
    for (fs::directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem))
        count += at->path().extension() == ".part";
    return count;
}

TEST(BakeWangImages, GoesOnWhereItWasKilled) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "whole.ovl")));
    write_text(folder / "a.ovl", "an older file");
    bool was_killed = false;
    for (int attempt = 0; attempt < 5 && !was_killed; ++attempt) {
        Running bake(words_of(folder, "a.ovl", {"--threads", "2"}));
        auto begin = std::chrono::steady_clock::now();
        while (parts_in(folder / "a.ovl.parts") < 3 && std::chrono::steady_clock::now() - begin < std::chrono::seconds(60))
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        bake.send(SIGKILL);
        was_killed = bake.wait().signal == SIGKILL && parts_in(folder / "a.ovl.parts") >= 3;
    }
    ASSERT_TRUE(was_killed) << "the bake was never seen while it sampled";
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "an older file");
    Ran ran = run(words_of(folder, "a.ovl", {"--json"}));
    expect_done(ran);
    EXPECT_GE(nlohmann::json::parse(ran.out)["images"]["taken_from_parts"], 3);
    EXPECT_TRUE(text_of_file(folder / "a.ovl") == text_of_file(folder / "whole.ovl"));
    EXPECT_FALSE(fs::exists(folder / "a.ovl.parts"));  // nor what the killed writers had begun
}

TEST(BakeWangImages, InPartsGivesTheSameBytes) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "whole.ovl")));
    for (const char* part : {"2/2", "1/2"}) {
        expect_done(run(words_of(folder, "none.ovl", {"--part", part, "--parts", folder / "parts"})));
        EXPECT_FALSE(fs::exists(folder / "none.ovl"));
    }
    Ran ran = run(words_of(folder, "a.ovl", {"--parts", folder / "parts", "--json"}));
    expect_done(ran);
    EXPECT_EQ(nlohmann::json::parse(ran.out)["images"]["baked"], 0);
    EXPECT_TRUE(text_of_file(folder / "a.ovl") == text_of_file(folder / "whole.ovl"));
}

// As the meshes' own reader gives them: positions, normals.
mesh::Soup points_of(const std::string& path) {
    std::string bytes = text_of_file(path);
    auto soup = mesh::read_ply({std::as_bytes(std::span(bytes)), path, "", {}});
    EXPECT_TRUE(soup) << soup.error().message;
    return soup ? std::move(*soup) : mesh::Soup{};
}

TEST(BakeWangImages, PointsThatAreExportedAreTheSamplesOfAnImage) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "a.ovl", {"--light", "later"})));
    auto file = container::Reader::open(folder / "a.ovl");
    auto images = wang_ldi::ImageReader::open(*file);
    ASSERT_TRUE(images);
    const wang_ldi::ImageSet& set = images->set();
    Words words{"baked", "export", folder / "a.ovl", "--tile", "2", "--level", "1", "-o", folder / "x.ply", "--json"};
    Words one = words;
    one.insert(one.end(), {"--direction", "1"});
    Ran ran = run(one);
    expect_done(ran);
    auto ldi = images->read(index_of(set, {0, 2, 1, 1}));
    ASSERT_TRUE(ldi);
    mesh::Soup soup = points_of(folder / "x.ply");
    EXPECT_EQ(nlohmann::json::parse(ran.out)["points"], ldi->sample_count());
    ASSERT_EQ(soup.positions.size(), ldi->sample_count());
    ASSERT_EQ(soup.mesh.normals.size(), ldi->sample_count());
    ASSERT_EQ(soup.mesh.colours.size(), ldi->sample_count());
    double pixel_m = set.tile_m / set.levels[1].side_px;
    for (uint32_t p = 0, s = 0; p + 1 < ldi->first.size(); ++p)
        for (; s < ldi->first[p + 1]; ++s) {
            EXPECT_DOUBLE_EQ(soup.positions[s].x, (p % ldi->side_px + 0.5) * pixel_m);
            EXPECT_DOUBLE_EQ(soup.positions[s].y, (p / ldi->side_px + 0.5) * pixel_m);
            EXPECT_DOUBLE_EQ(soup.positions[s].z, set.low_m + double(set.levels[1].height_step_m) * ldi->heights[s]);
            EXPECT_NEAR(double(glm::length(soup.mesh.normals[s])), 1, 1e-5);
            for (size_t c = 0; c < 3; ++c) EXPECT_EQ(soup.mesh.colours[s][c], ldi->palette[ldi->colours[s]][c]);
        }
    // Of all directions each place once.
    ran = run(words);
    expect_done(ran);
    soup = points_of(folder / "x.ply");
    std::set<std::array<double, 3>> places;
    for (const glm::dvec3& at : soup.positions) places.insert({at.x, at.y, at.z});
    EXPECT_EQ(places.size(), soup.positions.size());
    EXPECT_GT(soup.positions.size(), ldi->sample_count());
    EXPECT_EQ(nlohmann::json::parse(ran.out)["directions"], set.direction_count);
}

TEST(BakeWangImages, PointsThatAreNotThereAreRefusedInOneLine) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "a.ovl")));
    auto before = contents_of(folder.path());
    auto expect = [&](const std::vector<std::string>& parts, const Words& more, const std::string& output = "x.ply") {
        Words words{"baked", "export", folder / "a.ovl", "-o", folder / output};
        words.insert(words.end(), more.begin(), more.end());
        expect_refusal(run(words), 2, "baked export", parts);
        EXPECT_EQ(contents_of(folder.path()), before);
    };
    expect({"a.ovl", "give --tile and --level"}, {"--tile", "0"});
    expect({"a.ovl", "has tiles 0 to 2, --tile 3 is none"}, {"--tile", "3", "--level", "0"});
    expect({"a.ovl", "--level 31 is none"}, {"--tile", "0", "--level", "31"});
    expect({"a.ovl", "--direction 63 is none"}, {"--tile", "0", "--level", "0", "--direction", "63"});
    expect({"a.ovl", "leave --error-m out"}, {"--tile", "0", "--level", "0", "--error-m", "1"});
    expect({"a.ovl", "leave --alone out"}, {"--tile", "0", "--level", "0", "--alone"});
    expect({"x.glb", "written as .ply"}, {"--tile", "0", "--level", "0"}, "x.glb");
}

TEST(BakeWangImages, ShowsItsTilesAsPictures) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_done(run(words_of(folder, "a.ovl", {"--border-images"})));
    Ran ran = run({"baked", "info", folder / "a.ovl", "--sheet", folder / "sheet", "--json"});
    expect_done(ran);
    for (const char* name : {"tiles-above.png", "tiles-aside.png", "directions.png", "levels.png", "planting.png",
                             "textures-above.png", "textures-aside.png"})
        EXPECT_GE(fs::file_size(folder / ("sheet/" + std::string(name))), 1000u) << name;
    nlohmann::json images = nlohmann::json::parse(ran.out)["images"];
    EXPECT_EQ(images["contexts"], 2);
    uint64_t samples = 0;
    EXPECT_EQ(read_ldis(folder / "a.ovl", samples), "");
    EXPECT_EQ(images["samples"], samples);
    expect_done(run({"baked", "export", folder / "a.ovl", "--tile", "0", "--level", "0", "--alone", "-o", folder / "x.ply"}));
}

TEST(BakeWangImages, RefusesOptionsThatMakeNoSenseInOneLine) {
    ScratchFolder folder;
    write_bushes(folder);
    auto before = contents_of(folder.path());
    auto expect = [&](int exit, const std::vector<std::string>& parts, const Words& more) {
        expect_refusal(run(words_of(folder, "a.ovl", more)), exit, "bake-wang-ldi", parts);
        EXPECT_EQ(contents_of(folder.path()), before);
    };
    expect(2, {"--part 3/2", "K/N is wanted"}, {"--part", "3/2"});
    expect(2, {"--part x", "K/N is wanted"}, {"--part", "x"});
    expect(2, {"--eye-high-m 1", "--eye-low-m 1.5"}, {"--eye-high-m", "1"});
    expect(2, {"--farthest-m 30", "--nearest-m 40"}, {"--nearest-m", "40"});
    expect(2, {"--level-ratio", "nan"}, {"--level-ratio", "nan"});
    expect(2, {"--unseen"}, {"--unseen", "0"});
    for (const char* side : {"0", "33", "512", "-1", "x", "32x"}) {
        Words words = words_of(folder, "a.ovl");
        words.back() = side;  // of --textures
        expect_refusal(run(words), 2, "bake-wang-ldi", {std::string("--textures ") + side, "1, 2, 4 .. 256"});
    }
}

TEST(BakeWangImages, RefusesTilesThatAreTooNear) {
    ScratchFolder folder;
    write_bushes(folder);
    expect_refusal(run(words_of(folder, "a.ovl", {"--nearest-m", "1"})), 2, "bake-wang-ldi",
                   {"within a tile of 3 m", "--nearest-m 2.25"});
    expect_refusal(run(words_of(folder, "a.ovl", {"--fov-y-deg", "1", "--nearest-m", "3"})), 2, "bake-wang-ldi",
                   {"4,096 are possible"});
    // Nearer than the default of 2.5 tiles, in parts too; nothing is left behind.
    Words near = words_of(folder, "a.ovl");
    *std::next(std::find(near.begin(), near.end(), "--farthest-m")) = "5";
    for (const Words& more : {Words{}, Words{"--part", "1/2"}}) {
        Words words = near;
        words.insert(words.end(), more.begin(), more.end());
        expect_refusal(run(words), 2, "bake-wang-ldi", {"5 m from the eye at most, 7.5 m at least", "--farthest-m 7.5"});
    }
    EXPECT_FALSE(fs::exists(folder / "a.ovl"));
    EXPECT_FALSE(fs::exists(folder / "a.ovl.parts"));
}

TEST(BakeWangImages, RefusesModelsThatStandOutOfTheirTightRadius) {
    ScratchFolder folder;
    write_bushes(folder);
    write_text(folder / "bush.obj", "v 0 0 2\nv 1.2 0.5 0\nv -0.2 0.1 0\nf 1 2 3\n");
    auto before = contents_of(folder.path());
    expect_refusal(run(words_of(folder, "a.ovl")), 3, "bake-wang-ldi",
                   {"bush.obj", "1.3 m from its middle", "tight_radius_m is 0.26"});
    expect_refusal(run(words_of(folder, "a.ovl", {"--part", "1/2"})), 3, "bake-wang-ldi", {"bush.obj"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

}  // namespace
}  // namespace overlook::cli
