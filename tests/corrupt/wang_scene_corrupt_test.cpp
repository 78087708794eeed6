// Every rule of a scene's sections has files that break it, and each is refused by its rule; so is every damage of whole ones.
// formats/spec/wang_scene.md says what the code does.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/corrupt/laws.h"
#include "tests/corrupt/terrain_fixtures.h"
#include "tests/corrupt/wang_scene_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi::scene_fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    for (const container::Section& section : file->sections())
        if (auto intact = file->check(section); !intact) return intact;
    auto scene = read_scene(*file, kTileCount);
    return scene ? Result<void>() : tl::unexpected(scene.error());
}

const container::fixtures::Kind kKind{
    "wang_scene",    'V', wang_ldi::scene_fixtures::whole_files, wang_ldi::scene_fixtures::corrupt_files, read_bytes,
    scene_rule_count};

class CorruptScenes : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptScenes, AreRefusedByTheirRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptScenes, AreAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptScenes, StandInTheRepositoryAsTheyAreMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptScenes, testing::ValuesIn(wang_ldi::scene_fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptSceneFiles, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptSceneFiles, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeScenes, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedScenes, AreRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "two_tiles.ovl");
}
TEST(DamagedScenes, AreRefusedAtEveryBitOfEveryByteOfTheirSections) {
    expect_refused_at_every_bit(kKind, "two_tiles.ovl");
}

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/wang_scene.md");
}

TEST(SceneDocument, ShowsTheVeryBytesOfTheExample) {
    std::string text = document();
    size_t scene = text.find("## WSCN of the example"), pictures = text.find("## WSCP of the example");
    ASSERT_TRUE(scene != std::string::npos && pictures != std::string::npos);
    EXPECT_TRUE(terrain::fixtures::bytes_of_hexdump(text.substr(scene)) == bytes_of_scene(two_tiles()));
    EXPECT_TRUE(terrain::fixtures::bytes_of_hexdump(text.substr(pictures)) == bytes_of_scene_pictures(two_tiles()));
}

TEST(SceneDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= scene_rule_count(); rule++) {
        std::string row = fmt::format("\n| V{} | {} |", rule, scene_rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| V{} |", scene_rule_count() + 1)), std::string::npos);
    EXPECT_EQ(scene_rule_text(0), "");
    EXPECT_EQ(scene_rule_text(scene_rule_count() + 1), "");
}

TEST(Scenes, ComeBackAsTheyWereWritten) {
    Scene scene = two_tiles();
    uint32_t number = 1;
    auto next = [&] { return (number = number * 1664525 + 1013904223) >> 8; };
    for (PerspectiveLdi* image : {&scene.image, &scene.pictures.emplace_back()}) {
        *image = {{{1, 2, 3}, -90, 10, 45, 40, 30, 0.5, 1000}, 0.5, true, 0.5f, {0}, {}, {}, {}};
        for (int p = 0; p < 40 * 30; ++p) {
            uint32_t depth = next() % 1000;
            for (uint32_t left = p == 77 ? 400 : next() % 4; left > 0; --left, depth += 1 + next() % 160)
                image->depths.push_back(uint16_t(depth));
            image->first.push_back(image->sample_count());
        }
        for (uint32_t s = 0; s < image->sample_count(); ++s) {
            image->colours.push_back({uint8_t(next()), uint8_t(next()), uint8_t(next())});
            if (image == &scene.image)
                image->normals.push_back({int8_t(int(next() % 255) - 127), int8_t(int(next() % 255) - 127)});
        }
    }
    ScratchFolder folder;
    auto writer = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
    auto written = write_scene(*writer, scene, kTileCount);
    ASSERT_TRUE(written) << written.error().message;
    ASSERT_TRUE(writer->commit());
    auto file = container::Reader::open(folder / "a.ovl");
    ASSERT_TRUE(has_scene(*file));
    auto again = read_scene(*file, kTileCount);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_TRUE(*again == scene);
    EXPECT_GT(stored_bytes_of_scene_image(*file), scene.image.sample_count());
}

TEST(Scenes, AreNotWrittenWhereAReaderWouldRefuseThem) {
    auto refused = [](auto change) {
        ScratchFolder folder;
        auto writer = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
        Scene scene = two_tiles();
        change(scene);
        auto written = write_scene(*writer, scene, kTileCount);
        return !written && written.error().exit == Exit::our_bug;
    };
    EXPECT_FALSE(refused([](Scene&) {}));
    EXPECT_TRUE(refused([](Scene& scene) { scene.tiles.push_back(0); }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.tiles[0] = kTileCount; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.rows = 0; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.image.first.back() = 4; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.image.first.pop_back(); }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.image.normals.pop_back(); }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.image.depths[1] = 10000; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.image.view.far_m = scene.image.view.near_m; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.pictures[0].colours.clear(); }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.pictures[0].view.position_m.z = NAN; }));
    EXPECT_TRUE(refused([](Scene& scene) { scene.pictures.resize(kMostScenePictures + 1); }));
}

// Steps of equal ratio: a depth is off by half a step at most, and what is near and far is exact.
TEST(Scenes, KeepDepthsToHalfAStepOfEqualRatio) {
    PerspectiveView view;
    view.near_m = 0.1, view.far_m = 400;
    double half_step = std::log(view.far_m / view.near_m) / 65535 / 2;
    for (double depth_m = view.near_m; depth_m < view.far_m; depth_m *= 1.0137) {
        double kept_m = depth_of_code(view, code_of_depth(view, depth_m));
        EXPECT_LE(std::abs(std::log(kept_m / depth_m)), half_step * (1 + 1e-9));
    }
    for (int code = 0; code < 65536; code += 7) EXPECT_EQ(code_of_depth(view, depth_of_code(view, uint16_t(code))), code);
    EXPECT_EQ(code_of_depth(view, 0.01), 0);
    EXPECT_EQ(code_of_depth(view, 1e9), 65535);
}

}  // namespace
}  // namespace overlook::wang_ldi::scene_fixtures
