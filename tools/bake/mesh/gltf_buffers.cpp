// Containers, buffers and views of glTF files.

#include "tools/bake/mesh/gltf_buffers.h"

#include <algorithm>

#include "formats/little_endian.h"

namespace overlook::mesh::gltf {
namespace {

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() * 3 / 4);
    uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0) return std::nullopt;
        bits = bits << 6 | uint32_t(value);
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes.push_back(std::byte(bits >> bit_count & 0xff));
    }
    return bytes;
}

// What the extension asks of a compressed view, and that the stream can hold what it says: the vertex codec stores 256 bytes in 4
// at best, the index codecs an index in a third of a byte at best.
const char* fault_of(const Compression& c) {
    const bool are_attributes = c.mode == CompressionMode::attributes;
    if (are_attributes ? c.stride == 0 || c.stride > 256 || c.stride % 4 != 0 : c.stride != 2 && c.stride != 4)
        return "has a stride that its mode does not have";
    if (c.mode == CompressionMode::triangles && c.count % 3 != 0) return "does not hold whole triangles";
    const bool is_octahedral = c.filter == CompressionFilter::octahedral;
    if (is_octahedral && c.stride != 4 && c.stride != 8) return "has a stride that its filter does not have";
    if (c.filter == CompressionFilter::quaternion && c.stride != 8) return "has a stride that its filter does not have";
    if (!are_attributes && c.filter != CompressionFilter::none) return "has a filter, which indices have none of";
    const uint64_t most = are_attributes ? (c.length * 64 + 256 * 256) / c.stride : c.length * 3;
    return c.count > most ? "says that it holds more than it can" : nullptr;
}

}  // namespace

Result<Container> open_container(Bytes file, const std::string& name) {
    Container container;
    if (file.size() < 4 || load_le<uint32_t>(file, 0) != kMagic) {
        container.json = {reinterpret_cast<const char*>(file.data()), file.size()};
        return container;
    }
    container.is_glb = true;
    if (file.size() < 20) return bad_input("{}: is {} bytes long, a GLB has 20 at least; was it cut short?", name, file.size());
    if (load_le<uint32_t>(file, 4) != 2)
        return bad_input("{}: is a GLB of version {}, read is 2", name, load_le<uint32_t>(file, 4));
    for (uint64_t at = 12; at + 8 <= file.size();) {
        const uint64_t length = load_le<uint32_t>(file, size_t(at));
        const uint32_t type = load_le<uint32_t>(file, size_t(at + 4));
        if (length > file.size() - at - 8)
            return bad_input("{}: its {} chunk ({} bytes at {}) ends after the file, which is {} bytes long; was it cut short?",
                             name, type == kJsonChunk ? "JSON" : "binary", length, at + 8, file.size());
        const Bytes chunk = file.subspan(size_t(at + 8), size_t(length));
        if (type == kJsonChunk && container.json.empty())
            container.json = {reinterpret_cast<const char*>(chunk.data()), chunk.size()};
        if (type == kBinaryChunk && container.binary.empty()) container.binary = chunk;
        at += 8 + length;
    }
    if (container.json.empty()) return bad_input("{}: has no JSON chunk", name);
    return container;
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == std::string_view::npos) return std::nullopt;
    if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(uri.substr(comma + 1));
    const std::string text = decode_percents(uri.substr(comma + 1));
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
}

std::string decode_percents(std::string_view uri) {
    const auto hex = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool is_code = uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0;
        text += is_code ? char(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i];
        if (is_code) i += 2;
    }
    return text;
}

Buffers::Buffers(const Document& document, const Container& container, const InputFile& file)
    : document_(document), container_(container), file_(file), buffers_(document.buffers.size()), views_(document.views.size()) {}

Result<Bytes> Buffers::view(uint32_t index) {
    if (views_[index]) return *views_[index];
    const View& view = document_.views[index];
    Result<Bytes> bytes =
        view.compression ? decompress(*view.compression, index) : part(view.buffer, view.offset, view.length, index);
    if (bytes) views_[index] = *bytes;
    return bytes;
}

Result<Bytes> Buffers::part(uint32_t index, uint64_t offset, uint64_t length, uint32_t view) {
    const Result<Bytes> whole = buffer(index);
    if (!whole) return whole;
    if (length > whole->size() || offset > whole->size() - length)
        return bad_input(
            "{}: buffer view {} (from byte {}, {} bytes) ends after its buffer, which has {}; was the file cut short?",
            file_.path, view, offset, length, whole->size());
    return whole->subspan(size_t(offset), size_t(length));
}

Result<Bytes> Buffers::decompress(const Compression& compression, uint32_t view) {
    if (const char* fault = fault_of(compression)) return bad_input("{}: compressed buffer view {} {}", file_.path, view, fault);
    const Result<Bytes> stream = part(compression.buffer, compression.offset, compression.length, view);
    if (!stream) return stream;
    std::vector<std::byte>& bytes = owned_.emplace_back(size_t(compression.count * compression.stride));
    if (!decode_meshopt(*stream, compression, bytes))
        return bad_input("{}: compressed buffer view {} is broken; was the file damaged?", file_.path, view);
    return Bytes(bytes);
}

Result<Bytes> Buffers::buffer(uint32_t index) {
    if (buffers_[index]) return *buffers_[index];
    const Buffer& buffer = document_.buffers[index];
    Result<Bytes> bytes = load(buffer, index);
    if (!bytes) return bytes;
    if (bytes->size() < buffer.byte_length)
        return bad_input("{}: buffer {} has {} bytes, {} are there; was the file cut short?", file_.path, index,
                         buffer.byte_length, bytes->size());
    buffers_[index] = bytes->subspan(0, size_t(buffer.byte_length));
    return *buffers_[index];
}

Result<Bytes> Buffers::load(const Buffer& buffer, uint32_t index) {
    if (buffer.is_fallback && buffer.uri.empty() && index != 0)
        return bad_input("{}: buffer {} is a place-holder for compressed views, and used by one that is not", file_.path, index);
    if (buffer.uri.empty()) return container_.binary;
    if (buffer.uri.starts_with("data:")) {
        std::optional<std::vector<std::byte>> bytes = decode_data_uri(buffer.uri);
        if (!bytes) return bad_input("{}: the data URI of buffer {} is broken", file_.path, index);
        return Bytes(owned_.emplace_back(std::move(*bytes)));
    }
    Result<MappedFile> mapped = MappedFile::open(file_.folder + bare_name(decode_percents(buffer.uri)));
    if (!mapped) return tl::unexpected(mapped.error());
    return mapped_.emplace_back(std::move(*mapped)).bytes();
}

}  // namespace overlook::mesh::gltf
