#include "runtime/gl/png.h"

#include <spng.h>

#include <cassert>
#include <cstdlib>
#include <memory>
#include <span>

#include "formats/atomic_file.h"

namespace overlook {

Result<void> write_png(const std::string& path, const ImageRgb8& image) {
    assert(image.width > 0 && image.height > 0 && image.pixels.size() == size_t(image.width) * image.height * 3);
    std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> encoder(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
    spng_ihdr header{};
    header.width = image.width;
    header.height = image.height;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;

    int status = encoder == nullptr ? SPNG_EMEM : spng_set_option(encoder.get(), SPNG_ENCODE_TO_BUFFER, 1);
    if (status == 0) status = spng_set_ihdr(encoder.get(), &header);
    if (status == 0) status = spng_set_srgb(encoder.get(), 0);
    if (status == 0) {
        status = spng_encode_image(encoder.get(), image.pixels.data(), image.pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    }
    size_t length_bytes = 0;
    std::unique_ptr<void, void (*)(void*)> bytes(
        status == 0 ? spng_get_png_buffer(encoder.get(), &length_bytes, &status) : nullptr, std::free);
    if (status != 0 || bytes == nullptr) return cannot_write("{}: cannot write: {}", path, spng_strerror(status));
    return write_file(path, std::span(static_cast<const std::byte*>(bytes.get()), length_bytes));
}

}  // namespace overlook
