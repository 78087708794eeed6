// What the module overlook_images.so does for the bakers: OpenImageIO's part of images.h. The module and who opens it are of one
// build and agree on these types; it is opened at first use (image_module.h), since OpenImageIO brings some 260 libraries along.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"
#include "tools/bake/images.h"

namespace overlook {

// A picture to be read, already looked at.
struct PictureFile {
    std::string path;    // where it is, or its name where its bytes are given
    std::string reader;  // OpenImageIO's name of the form: "tiff", "png", "jpeg", ...; not empty
    int thread_count = 1;
};

// The module's functions. Errors are as images.h has them; the readers turn what the library throws into errors.
struct ImageLibrary {
    const char* version;  // Overlook's own; compared before anything else is touched
    Result<NumberRaster> (*read_numbers)(const PictureFile& file, const ImageWindow& window);
    Result<ImageRgb8> (*read_rgb8)(const PictureFile& file);
    Result<PictureRgba8> (*read_rgba8)(const PictureFile& file, std::span<const std::byte> bytes);
    std::optional<PictureSize> (*size_of)(const PictureFile& file, std::span<const std::byte> bytes);
    Result<std::vector<std::byte>> (*write_png)(uint32_t width, uint32_t height, int channels, std::span<const uint8_t> pixels);
};

}  // namespace overlook

// The module's only symbol; what it returns lives as long as the process.
extern "C" const overlook::ImageLibrary* overlook_image_library();
