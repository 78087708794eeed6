// A module of pictures that another version of Overlook brought.
#include "tools/bake/image_library.h"

extern "C" [[gnu::visibility("default")]] const overlook::ImageLibrary* overlook_image_library() {
    static constexpr overlook::ImageLibrary kLibrary = {"0.0.0-other", nullptr, nullptr, nullptr, nullptr, nullptr};
    return &kLibrary;
}
