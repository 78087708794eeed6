// Planted ground, measured: beside its own plants, with counters that repeat.
#include <fstream>

#include "formats/discrete.h"
#include "formats/wang_ldi_layout.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/planting_file.h"
#include "tests/runtime/discrete/chains.h"
#include "tools/measure/magenta.h"
#include "tools/measure/methods.h"
#include "tools/measure/run.h"

namespace overlook::measure {
namespace {

class MeasuredPlanting : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string reason;
        context_ = test::software_context(reason);
        if (!context_) GTEST_SKIP() << "no software renderer: " << reason;
        wang_ldi::write_mounds(folder_ / "mounds.ovl", true, true);
        auto writer = container::Writer::create(folder_ / "plant.ovl", discrete::kKind);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(discrete::write(*writer, discrete::made::simple_chain()));
        ASSERT_TRUE(writer->add_provenance({"test", "0", {}, {}}));
        ASSERT_TRUE(writer->commit());
    }
    Result<World> world_of(const std::string& planting) {
        std::string text = R"({"version": 1, "layers": [{"asset": "mounds.ovl", "method": "wang-ldi")" + planting + "}]}";
        EXPECT_TRUE(write_file(folder_ / "scene.json", std::string_view(text)));
        return read_world(folder_ / "scene.json");
    }
    static std::vector<view::Camera> walk(World& world, int frames) {
        std::vector<view::Camera> cameras;
        for (int frame = 0; frame < frames; ++frame) {
            view::Camera camera = wang_ldi::head_camera({0.7, 0.9 + 0.4 * frame, 1.7}, 12);
            camera.width_px = 96, camera.height_px = 64;
            cameras.push_back(world.local(camera));
        }
        return cameras;
    }

    ScratchFolder folder_;
    std::optional<gl::Context> context_;
};

TEST_F(MeasuredPlanting, StandsBesideItsOwnPlantsWithCountersThatRepeat) {
    auto world = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_TRUE(upload(*world));
    Course course;
    for (const char* method :
         {"wang-ldi@samples=1@geometry=0", "wang-ldi:paper@samples=1", "wang-ldi@samples=1@geometry=0@exact=1@fill=0"})
        course.specs.push_back(*parse_method(method));
    add_floors(course.specs);
    course.cameras = walk(*world, 3);
    ASSERT_TRUE(check_draws(course.specs, *world));
    gl::Renderer renderer = context_->renderer();
    auto first = run_course(*world, course, renderer, "", [](double) {});
    auto again = run_course(*world, course, renderer, "", [](double) {});
    ASSERT_TRUE(first && again);
    ASSERT_EQ(first->runs.size(), 4u);
    for (size_t run = 0; run < 4; ++run)
        for (size_t frame = 0; frame < 3; ++frame) {
            const FrameRecord &one = first->runs[run].frames[frame], &other = again->runs[run].frames[frame];
            EXPECT_TRUE(one.counters == other.counters);
            EXPECT_EQ(one.numbers.w, other.numbers.w);
            bool is_planting = run < 3;
            EXPECT_EQ(one.counters.sample_count > 0, is_planting);
            EXPECT_EQ(one.counters.tile_count > 10, is_planting);
            EXPECT_EQ(one.counters.missing_count, 0u);
        }
    // The floor draws the plants: it is nearer to them than pictures of mounds are.
    double floor_e = *first->runs[3].frames[0].numbers.e_mean;
    for (size_t run = 0; run < 3; ++run) EXPECT_GT(*first->runs[run].frames[0].numbers.e_mean, 2 * floor_e);
    EXPECT_GT(first->runs[3].frames[0].counters.triangle_count, first->runs[0].frames[0].counters.triangle_count + 1000);
}

TEST_F(MeasuredPlanting, DrawsNearTilesAsGeometryUnlessItIsForbidden) {
    auto world = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_TRUE(upload(*world));
    auto triangles_of = [&](const char* method) {
        auto made = make_method(*parse_method(method), *world);
        auto target = gl::Target::make(96, 64, 1);
        EXPECT_TRUE(target);
        made->decide(walk(*world, 1).front(), 0);
        return made->draw(*target);
    };
    Counters images = triangles_of("wang-ldi@samples=1@geometry=0"), near = triangles_of("wang-ldi@samples=1"),
             wide = triangles_of("wang-ldi@samples=1@geometry-m=20");
    EXPECT_GT(near.triangle_count, images.triangle_count + 100);
    EXPECT_LT(near.sample_count, images.sample_count);
    EXPECT_GT(wide.triangle_count, near.triangle_count);
    // Images alone do not keep what is asked near the eye, and say so.
    EXPECT_LE(near.predicted_error_px, 1);
    EXPECT_GT(images.predicted_error_px, 4);
}

// Counted before it is drawn: in the very frame from which it holds, and by what is drawn, not by what was foretold.
TEST_F(MeasuredPlanting, KeepsABudgetOfTrianglesFromTheFrameOnThatItHolds) {
    auto world = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_TRUE(upload(*world));
    auto target = gl::Target::make(96, 64, 1);
    ASSERT_TRUE(target);
    std::vector<view::Camera> cameras = walk(*world, 24);
    auto flown = [&](const std::function<double(uint32_t)>& budget_at) {
        auto method = make_method(*parse_method("wang-ldi@samples=1@geometry-m=12"), *world);
        std::vector<Counters> frames;
        for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
            EXPECT_TRUE(method->set_triangles(budget_at(frame)));
            method->decide(cameras[frame], frame);
            frames.push_back(method->draw(*target));
            EXPECT_TRUE(method->draw(*target) == frames.back()) << "drawn again";
        }
        return frames;
    };
    std::vector<Counters> free = flown([](uint32_t) { return 0; });
    double least = INFINITY;
    for (const Counters& frame : free) least = std::min(least, double(frame.triangle_count));
    ASSERT_GT(least, 20000) << "plants enough that one of them is no share of it";
    auto budget_at = [&](uint32_t frame) { return frame < 8 ? 0.8 * least : frame < 16 ? 0.4 * least : 0; };
    std::vector<Counters> kept = flown(budget_at);
    for (uint32_t frame = 0; frame < kept.size(); ++frame) {
        double budget = budget_at(frame), triangles = double(kept[frame].triangle_count);
        if (budget == 0) {
            EXPECT_EQ(kept[frame].triangle_count, free[frame].triangle_count) << frame;
            EXPECT_EQ(kept[frame].sample_count, free[frame].sample_count) << frame;
            EXPECT_EQ(kept[frame].predicted_error_px, free[frame].predicted_error_px) << frame;
            continue;
        }
        EXPECT_LE(triangles, budget) << frame;
        EXPECT_GE(triangles, 0.9 * budget) << frame;
        EXPECT_GT(kept[frame].predicted_error_px, 1) << "and it is said what that costs, in frame " << frame;
    }
    std::vector<Counters> more = flown([&](uint32_t) { return 1e9; });
    for (uint32_t frame = 0; frame < more.size(); ++frame) EXPECT_TRUE(more[frame] == free[frame]) << frame;
}

TEST_F(MeasuredPlanting, ShowsMagentaWhereItHasHolesAndNoneWhereItIsThePlants) {
    auto world = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(world) << world.error().message;
    paint_magenta(*world);
    ASSERT_TRUE(upload(*world));
    std::vector<MethodSpec> specs;
    for (const char* method : {"wang-ldi@samples=1@geometry-m=1000@radius-m=500", "wang-ldi@samples=1@radius-m=0.5@geometry=0"})
        specs.push_back(*parse_method(method));
    auto found = gaps_over_magenta(*world, specs, walk(*world, 2));
    ASSERT_TRUE(found) << found.error().message;
    const Gaps &plants = (*found)[0].anywhere, &nothing = (*found)[1].anywhere;
    EXPECT_GT(plants.covered_px, 100u);
    EXPECT_EQ(plants.covered_px, nothing.covered_px);
    EXPECT_LE(plants.share(), 0.01) << "the same plants at another level";
    EXPECT_GT(nothing.share(), 0.9) << "nothing is drawn, so all of them are holes";
    EXPECT_GT(nothing.widest_px, 2u);
}

TEST_F(MeasuredPlanting, NeedsItsModels) {
    auto world = world_of("");
    ASSERT_FALSE(world);
    EXPECT_TRUE(world.error().message.ends_with("mounds.ovl plants; they are chains of levels (bake-lod discrete)"))
        << world.error().message;
    auto two = world_of(R"(, "planting": {"models": ["plant.ovl", "plant.ovl"]})");
    ASSERT_FALSE(two);
    EXPECT_NE(two.error().message.find("names 2 models, and "), std::string::npos) << two.error().message;
    auto one = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(one) << one.error().message;
    auto refused = check_draws(std::vector<MethodSpec>{*parse_method("terrain")}, *one);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "--method terrain: it draws terrains, and scene.json holds a planting");
}

TEST_F(MeasuredPlanting, RefusesImagesThatCannotBeReadAndTooLittleMemoryBeforeItBegins) {
    auto whole = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_TRUE(check_draws(std::vector<MethodSpec>{*parse_method("wang-ldi@memory-mib=64")}, *whole));
    auto tight = check_draws(std::vector<MethodSpec>{*parse_method("wang-ldi@memory-mib=1")}, *whole);
    ASSERT_FALSE(tight);
    EXPECT_EQ(tight.error().exit, Exit::impossible);
    EXPECT_TRUE(tight.error().message.starts_with("--method wang-ldi: ")) << tight.error().message;
    EXPECT_NE(tight.error().message.find("mounds.ovl: its coarsest blocks take "), std::string::npos) << tight.error().message;
    // The last image's last byte: nothing but its own check tells.
    uint64_t damaged = 0;
    {
        auto file = container::Reader::open(folder_ / "mounds.ovl");
        ASSERT_TRUE(file);
        const container::Section* section = file->find(wang_ldi::kImagesTag);
        ASSERT_NE(section, nullptr);
        damaged = section->offset + section->stored_bytes - 1;
    }
    std::fstream bytes(folder_ / "mounds.ovl", std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(std::streamoff(damaged));
    int byte = bytes.get();
    bytes.seekp(std::streamoff(damaged)), bytes.put(char(byte ^ 1)), bytes.close();
    auto broken = world_of(R"(, "planting": {"models": ["plant.ovl"]})");
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().exit, Exit::bad_input);
    EXPECT_NE(broken.error().message.find("mounds.ovl"), std::string::npos) << broken.error().message;
}

}  // namespace
}  // namespace overlook::measure
