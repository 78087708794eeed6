#include "formats/compression.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/little_endian.h"

namespace overlook {
namespace {

using Bytes = std::vector<std::byte>;

TEST(Zstd, GivesBackEverySize) {
    for (size_t size : {0u, 1u, 255u, 256u, 65536u, 131072u, 131073u, 1000000u}) {
        Bytes raw(size);
        for (size_t i = 0; i < size; i++) raw[i] = std::byte(i * i >> 7);
        Result<Bytes> stored = zstd_compressed("a.ovl", raw);
        ASSERT_TRUE(stored);
        EXPECT_EQ(fault_of_zstd_frame(*stored, size), "");
        Bytes decoded(size);
        EXPECT_EQ(zstd_decode(*stored, decoded), "");
        EXPECT_EQ(decoded, raw);
    }
}

TEST(Zstd, OfOneByteRepeatedIsWithinWhatAFrameMayExpandTo) {
    Bytes raw(64 << 20);
    Result<Bytes> stored = zstd_compressed("a.ovl", raw);
    ASSERT_TRUE(stored);
    EXPECT_EQ(fault_of_zstd_frame(*stored, raw.size()), "");
}

// One block, and a stated content of 2^62 bytes: believed, it would take all memory there is.
TEST(Zstd, IsRefusedWithoutTakingMemoryIfItCannotExpandSoFar) {
    Bytes frame(13 + 4);
    store_le<uint32_t>(frame, 0, 0xfd2fb528);
    frame[4] = std::byte(0xe0);  // single segment, content size in eight bytes
    store_le<uint64_t>(frame, 5, uint64_t(1) << 62);
    store_le<uint32_t>(frame, 13, (131072u << 3) | 2u | 1u);
    EXPECT_EQ(fault_of_zstd_frame(frame, uint64_t(1) << 62),
              "states 4611686018427387904 bytes of content, more than 17 bytes of zstd can hold");
}

TEST(Zstd, IsRefusedAtEveryTruncatedLength) {
    Bytes raw(3000);
    for (size_t i = 0; i < raw.size(); i++) raw[i] = std::byte(i % 7 * 31);
    Bytes stored = *zstd_compressed("a.ovl", raw);
    for (size_t size = 0; size < stored.size(); size++) {
        Bytes cut(stored.begin(), stored.begin() + long(size));
        EXPECT_NE(fault_of_zstd_frame(cut, raw.size()), "") << size;
    }
}

}  // namespace
}  // namespace overlook
