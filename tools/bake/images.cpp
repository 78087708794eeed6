// Pictures in and out: what can be told of a file without decoding it. The rest is the module's (image_library.cpp).

#include "tools/bake/images.h"

#include <cctype>
#include <cstring>
#include <utility>

#include "formats/mapped_file.h"
#include "formats/parallel.h"
#include "tools/bake/image_library.h"
#include "tools/bake/image_module.h"
#include "tools/bake/png_check.h"

namespace overlook {
namespace {

// Which of the library's readers a file needs: by its first bytes, so that a wrong extension does not matter, or by its
// extension. Asking for one reader by name keeps the others (some of which print) from trying.
std::string reader_of(const std::string& path, std::span<const std::byte> bytes) {
    const auto begins_with = [&](const char* text, size_t size) {
        return bytes.size() >= size && std::memcmp(bytes.data(), text, size) == 0;
    };
    if (begins_with("II*\0", 4) || begins_with("MM\0*", 4) || begins_with("II+\0", 4) || begins_with("MM\0+", 4)) return "tiff";
    if (is_png(bytes)) return "png";
    if (begins_with("\xff\xd8\xff", 3)) return "jpeg";
    const size_t dot = path.find_last_of("./");
    if (dot == std::string::npos || path[dot] == '/') return "";
    std::string extension = path.substr(dot + 1);
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

// Looks at a file before the library does.
Result<PictureFile> look_at(const std::string& path) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    PictureFile picture{path, reader_of(path, file->bytes()), int(thread_count())};
    if (picture.reader.empty()) return bad_input("{}: is no picture of a known form", path);
    if (picture.reader == "png")
        if (auto whole = check_png(file->bytes(), path); !whole) return tl::unexpected(whole.error());
    return picture;
}

// Reads a file with one of the module's functions.
template <class Read>
auto read_with_library(const std::string& path, const Read& read)
    -> decltype(read(std::declval<const ImageLibrary&>(), PictureFile{})) {
    const Result<PictureFile> file = look_at(path);
    if (!file) return tl::unexpected(file.error());
    const Result<const ImageLibrary*> library = image_library();
    if (!library) return tl::unexpected(library.error());
    return read(**library, *file);
}

}  // namespace

Result<NumberRaster> read_number_raster(const std::string& path, const ImageWindow& window) {
    return read_with_library(
        path, [&](const ImageLibrary& library, const PictureFile& file) { return library.read_numbers(file, window); });
}

Result<ImageRgb8> read_image_rgb8(const std::string& path) {
    return read_with_library(path, [](const ImageLibrary& library, const PictureFile& file) { return library.read_rgb8(file); });
}

Result<PictureRgba8> picture_rgba8(const std::string& name, std::span<const std::byte> bytes) {
    const PictureFile file{name, reader_of(name, bytes), 1};
    if (bytes.empty() || file.reader.empty()) return bad_input("{}: is no picture of a known form", name);
    if (file.reader == "png")
        if (auto whole = check_png(bytes, name); !whole) return tl::unexpected(whole.error());
    const Result<const ImageLibrary*> library = image_library();
    if (!library) return tl::unexpected(library.error());
    return (*library)->read_rgba8(file, bytes);
}

Result<std::optional<PictureSize>> picture_size(const std::string& name, std::span<const std::byte> bytes) {
    const PictureFile file{name, reader_of(name, bytes), 1};
    if (bytes.empty() || file.reader.empty() || (file.reader == "png" && !check_png(bytes, name))) return std::nullopt;
    const Result<const ImageLibrary*> library = image_library();
    if (!library) return tl::unexpected(library.error());
    return (*library)->size_of(file, bytes);
}

Result<std::vector<std::byte>> png_bytes(const ImageRgb8& image) {
    return png_bytes(image.width, image.height, 3, image.pixels);
}

Result<std::vector<std::byte>> png_bytes(uint32_t width, uint32_t height, int channels, std::span<const uint8_t> pixels) {
    const Result<const ImageLibrary*> library = image_library();
    if (!library) return tl::unexpected(library.error());
    return (*library)->write_png(width, height, channels, pixels);
}

}  // namespace overlook
