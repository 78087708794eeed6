// A module of another version is refused before any of its functions is called.
#include <gtest/gtest.h>

#include "tools/bake/image_module.h"

namespace overlook::test {
namespace {

TEST(ImageModule, OfAnotherVersionIsRefused) {
    const Result<const ImageLibrary*> other = open_image_library(OVERLOOK_OTHER_MODULE_FOLDER);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().exit, Exit::impossible);
    EXPECT_NE(other.error().message.find("overlook_images.so is of Overlook 0.0.0-other, this is "), std::string::npos)
        << other.error().message;
}

TEST(ImageModule, OpensOncePerProcess) {
    const Result<const ImageLibrary*> first = image_library(), second = image_library();
    ASSERT_TRUE(first) << first.error().message;
    ASSERT_TRUE(second);
    EXPECT_EQ(*first, *second);
}

}  // namespace
}  // namespace overlook::test
