// The bytes of a glTF file: its container, buffers and views, decompressed where they are compressed.
#pragma once

#include <deque>
#include <span>

#include "formats/mapped_file.h"
#include "tools/bake/mesh/gltf_document.h"
#include "tools/bake/mesh/soup.h"

namespace overlook::mesh::gltf {

using Bytes = std::span<const std::byte>;

// The JSON and the binary chunk of a file: a GLB's own, or the whole file and nothing.
struct Container {
    std::string_view json;
    Bytes binary;
    bool is_glb = false;
};

// Fails with Exit::bad_input: "a.glb: its JSON chunk (1000 bytes at 20) ends after the file, which is 500 bytes long; was it cut
// short?", and for a container that is none of glTF 2.
Result<Container> open_container(Bytes file, const std::string& name);

// The bytes of a data URI ("data:image/png;base64,..."), or nothing if it is none or broken.
std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);
// "%20" as a space, and so on.
std::string decode_percents(std::string_view uri);

// Gives views' bytes. Holds what had to be read or decompressed. The document and the file must outlive it.
class Buffers {
  public:
    Buffers(const Document& document, const Container& container, const InputFile& file);

    // A view's bytes, decompressed on first use.
    Result<Bytes> view(uint32_t index);

  private:
    Result<Bytes> buffer(uint32_t index);
    Result<Bytes> load(const Buffer& buffer, uint32_t index);
    Result<Bytes> part(uint32_t buffer, uint64_t offset, uint64_t length, uint32_t view);
    Result<Bytes> decompress(const Compression& compression, uint32_t view);

    const Document& document_;
    const Container& container_;
    const InputFile& file_;
    std::vector<std::optional<Bytes>> buffers_, views_;
    std::deque<std::vector<std::byte>> owned_;
    std::deque<MappedFile> mapped_;
};

// EXT_meshopt_compression. `to` has count * stride bytes. False if the stream is broken. The caller has checked what
// check_compression checks.
bool decode_meshopt(Bytes stream, const Compression& compression, std::span<std::byte> to);

}  // namespace overlook::mesh::gltf
