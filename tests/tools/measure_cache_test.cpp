// Reference frames on the disk: believed only when whole.
#include "tools/measure/reference_cache.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/formats/scratch_folder.h"

namespace overlook::measure {
namespace {

Frame a_frame() {
    Frame frame;
    frame.width = 5;
    frame.height = 3;
    frame.camera.width_px = 5;
    frame.camera.height_px = 3;
    for (int i = 0; i < 15; ++i) {
        for (int channel = 0; channel < 3; ++channel) frame.rgb.push_back(uint8_t(17 * i + channel));
        frame.depth_m.push_back(i % 4 == 0 ? std::numeric_limits<float>::infinity() : 0.1f * float(i));
        frame.ids.push_back(i % 4 == 0 ? kBackground : uint32_t(i));
    }
    return frame;
}

void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST(KeptFrame, ComesBackBitForBit) {
    ScratchFolder folder;
    Frame frame = a_frame();
    ASSERT_TRUE(keep(folder / "a", frame));
    KeptFrame kept = read_kept(folder / "a", frame.camera);
    ASSERT_TRUE(kept.frame);
    EXPECT_FALSE(kept.is_damaged);
    EXPECT_EQ(kept.frame->width, 5u);
    EXPECT_EQ(kept.frame->rgb, frame.rgb);
    EXPECT_EQ(kept.frame->depth_m, frame.depth_m);
    EXPECT_EQ(kept.frame->ids, frame.ids);
    ASSERT_TRUE(keep(folder / "b", *kept.frame));
    EXPECT_EQ(text_of_file(folder / "a"), text_of_file(folder / "b"));
}

TEST(KeptFrame, IsNotThereWhereNoneWasKept) {
    ScratchFolder folder;
    KeptFrame kept = read_kept(folder / "none", a_frame().camera);
    EXPECT_FALSE(kept.frame);
    EXPECT_FALSE(kept.is_damaged);
}

TEST(KeptFrame, IsRefusedAtEveryDamagedByte) {
    ScratchFolder folder;
    Frame frame = a_frame();
    ASSERT_TRUE(keep(folder / "a", frame));
    std::string whole = text_of_file(folder / "a");
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = char(damaged[i] ^ 1);
        write_bytes(folder / "b", damaged);
        KeptFrame kept = read_kept(folder / "b", frame.camera);
        EXPECT_FALSE(kept.frame) << "byte " << i;
        EXPECT_TRUE(kept.is_damaged) << "byte " << i;
    }
}

TEST(KeptFrame, IsRefusedAtEveryOtherLengthAndSize) {
    ScratchFolder folder;
    Frame frame = a_frame();
    ASSERT_TRUE(keep(folder / "a", frame));
    std::string whole = text_of_file(folder / "a");
    for (size_t length = 0; length < whole.size(); ++length) {
        write_bytes(folder / "b", whole.substr(0, length));
        EXPECT_TRUE(read_kept(folder / "b", frame.camera).is_damaged) << length;
    }
    write_bytes(folder / "b", whole + "x");
    EXPECT_TRUE(read_kept(folder / "b", frame.camera).is_damaged);
    view::Camera wider = frame.camera;
    wider.width_px = 6;
    EXPECT_TRUE(read_kept(folder / "a", wider).is_damaged);
}

}  // namespace
}  // namespace overlook::measure
