// A whole bake of a small set: the same bytes whatever the threads, goes on where it was stopped, and what is warped is what rays
// see.
#include "tools/bake/wang_ldi/bake_images.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "formats/parallel.h"
#include "tests/formats/scratch_folder.h"
#include "tests/tools/wang_ldi/plants.h"

namespace overlook::wang_ldi {
namespace {

ImageBake small_bake() {
    ImageBake bake;
    bake.levels.set.cell = {1.5, 1.9, 6, 30, 120, 1};
    bake.levels.direction_px = 130, bake.levels.level_ratio = 2;
    bake.sampling.rays_per_eye = 4096, bake.sampling.unseen_goal = 0.05;
    bake.light.sky_rays = 16, bake.light.sun_rays = 4;
    bake.textures.side_px = 4, bake.textures.error_goal = 0.1, bake.textures.rays_per_eye = 1024;
    return bake;
}

Result<ImageReport> baked(const std::string& path, const ImageBake& bake, size_t tiles = 1) {
    TileSet set = plants::one_tile();
    set.tiles.resize(tiles);
    auto writer = container::Writer::create(path, container::tag("WANG"));
    if (!writer) return tl::unexpected(writer.error());
    Models models = plants::models();
    auto report = bake_images(*writer, set, plants::planting(3, tiles), models, bake, [](double) {});
    if (!report) return report;
    if (auto bytes = writer->commit(); !bytes) return tl::unexpected(bytes.error());
    return report;
}

TEST(ImageBakes, WriteTheSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    std::string first;
    for (unsigned threads : {1u, 2u, 5u}) {
        set_thread_count(threads);
        auto report = baked(folder / "a.ovl", small_bake(), 2);
        ASSERT_TRUE(report) << report.error().message;
        std::string bytes = text_of_file(folder / "a.ovl");
        if (first.empty()) first = bytes;
        EXPECT_TRUE(bytes == first) << threads;
    }
    set_thread_count(0);
}

TEST(ImageBakes, CanBeReadAgainAndStateWhatWasCounted) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    bake.has_border_images = true;
    auto report = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(report) << report.error().message;
    auto file = container::Reader::open(folder / "a.ovl");
    ASSERT_TRUE(file);
    auto images = ImageReader::open(*file);
    ASSERT_TRUE(images) << images.error().message;
    ASSERT_EQ(images->set().context_count, 2u);
    ASSERT_EQ(report->rows.size(), images->set().ldi_count());
    uint64_t in_context = 0, on_border = 0;
    for (uint64_t i = 0; i < report->rows.size(); ++i) {
        auto ldi = images->read(i);
        ASSERT_TRUE(ldi) << ldi.error().message;
        const ImageRow& row = report->rows[i];
        EXPECT_EQ(ldi->sample_count(), row.samples);
        EXPECT_LE(row.unseen_share, 0.05);
        EXPECT_EQ(double(ldi->unseen_share), row.unseen_share);
        (row.which.context == 0 ? in_context : on_border) += row.samples;
    }
    EXPECT_GT(in_context, 1000u);
    EXPECT_GT(double(on_border), 1.02 * double(in_context));  // neighbours hide nothing
}

TEST(ImageBakes, SayHowManyImagesHaveMoreUnseenThanWasAsked) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    auto kept = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->above_goal, 0u);
    bake.sampling.most_rays = 20'000;
    auto missed = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(missed);
    uint64_t above = 0;
    for (const ImageRow& row : missed->rows) above += row.unseen_share > 0.05;
    EXPECT_GT(above, 0u);
    EXPECT_EQ(missed->above_goal, above);
    // Of the paper's fixed rays nothing is asked.
    bake.sampling.fixed_rays = 20'000;
    auto fixed = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(fixed);
    EXPECT_EQ(fixed->above_goal, 0u);
}

TEST(ImageBakes, HaveTexturesUnlessTheyAreNotWanted) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    bake.has_border_images = true, bake.judged_views = 2;
    auto report = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(report) << report.error().message;
    auto file = container::Reader::open(folder / "a.ovl");
    auto textures = read_textures(*file, report->set);
    ASSERT_TRUE(textures) << textures.error().message;
    EXPECT_EQ(textures->side_px, 4u);
    EXPECT_EQ(textures->nearest_m, report->set.cell.farthest_m);
    ASSERT_EQ(textures->textures.size(), report->textures.size());
    for (size_t i = 0; i < report->textures.size(); ++i) {
        const TextureRow& row = report->textures[i];
        EXPECT_EQ(double(textures->textures[i].unseen_share), row.unseen_share);
        EXPECT_LE(row.unseen_share, 0.02);
        EXPECT_GT(row.hits, 100u);
        EXPECT_GT(row.judgement.pixels, 0u);
    }
    bake.textures.side_px = 0;
    ASSERT_TRUE(baked(folder / "b.ovl", bake));
    EXPECT_FALSE(has_textures(*container::Reader::open(folder / "b.ovl")));
}

TEST(ImageBakes, GoOnWhereTheyWereStopped) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    auto whole = baked(folder / "whole.ovl", bake, 2);
    ASSERT_TRUE(whole);

    bake.parts_folder = folder / "a.ovl.parts";
    auto first = baked(folder / "a.ovl", bake, 2);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->taken_from_parts, 0u);
    // As a bake leaves them that was killed: some missing, one cut short, one damaged, one of another bake.
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(bake.parts_folder)) names.push_back(entry.path());
    std::sort(names.begin(), names.end());
    ASSERT_EQ(names.size(), whole->part_count);
    std::filesystem::remove(names[0]);
    std::filesystem::resize_file(names[1], 100);
    std::string damaged = text_of_file(names[2]);
    damaged[damaged.size() - 1] = char(damaged.back() ^ 1);
    ASSERT_TRUE(write_file(names[2], damaged));
    auto second = baked(folder / "a.ovl", bake, 2);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->taken_from_parts, names.size() - 3);
    EXPECT_TRUE(text_of_file(folder / "a.ovl") == text_of_file(folder / "whole.ovl"));

    ImageBake other = bake;
    other.light.sun.r = 0.5f;
    auto third = baked(folder / "b.ovl", other, 2);
    ASSERT_TRUE(third);
    EXPECT_EQ(third->taken_from_parts, 0u);
    second->parts.remove_all(second->part_count), third->parts.remove_all(third->part_count);
    EXPECT_FALSE(std::filesystem::exists(bake.parts_folder));
}

TEST(ImageBakes, InPartsGiveTheSameBytesAsInOnePiece) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    ASSERT_TRUE(baked(folder / "whole.ovl", bake, 2));
    bake.parts_folder = folder / "parts";
    uint64_t made = 0;
    for (bake.part = 0, bake.part_count = 3; bake.part < 3; ++bake.part) {
        auto part = baked(folder / "none.ovl", bake, 2);
        ASSERT_TRUE(part);
        EXPECT_GT(part->made, 0u);
        EXPECT_EQ(part->rows.size(), 0u);
        made += part->made;
    }
    bake.part = 0, bake.part_count = 1;
    auto whole = baked(folder / "a.ovl", bake, 2);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->made, 0u);
    EXPECT_EQ(whole->taken_from_parts, made);
    EXPECT_TRUE(text_of_file(folder / "a.ovl") == text_of_file(folder / "whole.ovl"));
}

TEST(ImageBakes, FailWhereTheirPartsCannotBeKept) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    bake.parts_folder = "/dev/null/parts";
    auto report = baked(folder / "a.ovl", bake);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().exit, Exit::cannot_write);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.ovl"));
}

// Of pixels away from outlines: nearly none is a hole, few show what is farther; what lies nearer than it should are splats a
// pixel too wide. The image of the opposite direction, which shows other sides, is far worse.
TEST(ImageBakes, WarpedShowWhatRaysSee) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    bake.levels.set.cell.focal_px = 250, bake.levels.set.cell.farthest_m = 14, bake.sampling.unseen_goal = 0.02;
    auto report = baked(folder / "a.ovl", bake);
    ASSERT_TRUE(report) << report.error().message;
    const ImageSet& set = report->set;
    auto file = container::Reader::open(folder / "a.ovl");
    auto images = ImageReader::open(*file);
    ASSERT_TRUE(images);
    Models models = plants::models();
    auto stage = stage_of(models, copies_of(plants::one_tile(), plants::planting(3), {0, 0, 0, 0, 0, 0, 0, 0, 0}), 1u << 30);
    ASSERT_TRUE(stage);
    Judging judging;
    judging.views = 3, judging.size_px = 200;
    double pixels = 0, error_pixels = 0, holes = 0, deeper = 0, nearer = 0, error = 0, error_opposite = 0, missing_opposite = 0;
    double holes_left = 0;
    for (uint32_t direction = 0; direction < set.direction_count; direction += 2) {
        Which which{0, 0, 0, direction}, opposite{0, 0, 0, (direction + set.direction_count / 2) % set.direction_count};
        Judgement right = judged(models, *stage, set, which, *images->read(index_of(set, which)), bake.light, judging);
        Judgement wrong = judged(models, *stage, set, which, *images->read(index_of(set, opposite)), bake.light, judging);
        pixels += double(right.pixels), holes += double(right.holes), holes_left += double(right.holes_left);
        deeper += double(right.deeper), nearer += double(right.nearer), error += right.error_sum,
            error_pixels += double(right.error_pixels);
        error_opposite += wrong.error_sum, missing_opposite += double(wrong.deeper + wrong.holes);
    }
    ASSERT_GT(pixels, 10'000);
    EXPECT_LT(holes, 0.002 * pixels);
    EXPECT_LT(holes_left, 0.001 * pixels);
    EXPECT_LT(deeper, 0.02 * pixels);
    EXPECT_LT(nearer, 0.12 * pixels);
    EXPECT_LT(error, 0.35 * error_pixels);
    EXPECT_GT(error_opposite, 1.3 * error);
    EXPECT_GT(missing_opposite, 5 * (deeper + holes) + 0.1 * pixels);
}

TEST(ImageBakes, RelitKeepNormalsAndUnlitColours) {
    ScratchFolder folder;
    ImageBake bake = small_bake();
    bake.is_relit = true;
    ASSERT_TRUE(baked(folder / "a.ovl", bake));
    auto file = container::Reader::open(folder / "a.ovl");
    auto images = ImageReader::open(*file);
    ASSERT_TRUE(images);
    auto ldi = images->read(0);
    ASSERT_TRUE(ldi);
    EXPECT_EQ(ldi->normals.size(), ldi->heights.size());
    // Three albedos and what a cube on the border of two mixes of them: the palette has them as they are.
    std::array<uint8_t, 3> green{srgb_from_linear(0.15f), srgb_from_linear(0.45f), srgb_from_linear(0.1f)};
    EXPECT_EQ(std::count(ldi->palette.begin(), ldi->palette.end(), green), 1);
}

}  // namespace
}  // namespace overlook::wang_ldi
