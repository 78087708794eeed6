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

Result<ImageRgba8> decode_png(const std::string& name, std::span<const std::byte> bytes) {
    constexpr uint32_t kMostSide = 16384;
    std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> decoder(spng_ctx_new(0), spng_ctx_free);
    spng_ihdr header{};
    size_t size = 0;
    int status = decoder == nullptr ? SPNG_EMEM : spng_set_image_limits(decoder.get(), kMostSide, kMostSide);
    if (status == 0) status = spng_set_png_buffer(decoder.get(), bytes.data(), bytes.size());
    if (status == 0) status = spng_get_ihdr(decoder.get(), &header);
    if (status == 0) status = spng_decoded_image_size(decoder.get(), SPNG_FMT_RGBA8, &size);
    ImageRgba8 image;
    if (status == 0) {
        image = {header.width, header.height, std::vector<uint8_t>(size)};
        status = spng_decode_image(decoder.get(), image.pixels.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
    }
    if (status != 0) return bad_input("{}: is no picture that can be read: {}; PNG is wanted", name, spng_strerror(status));
    return image;
}

}  // namespace overlook
