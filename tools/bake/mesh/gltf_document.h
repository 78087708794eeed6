// What a glTF file's JSON says, as plain values. Source: Khronos Group, "glTF 2.0 Specification", 2021, sections 3 and 5.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::mesh::gltf {

// Numbers of other things are below their count, or kNone where the file does not name one; counts and offsets are as written,
// not yet checked against any bytes.
struct Buffer {
    std::string uri;  // "" is the GLB's own chunk
    uint64_t byte_length = 0;
    bool is_fallback = false;  // nothing is there: EXT_meshopt_compression's views replace it
};

enum class CompressionMode : uint8_t { attributes, triangles, indices };
enum class CompressionFilter : uint8_t { none, octahedral, quaternion, exponential };

// A view that EXT_meshopt_compression stores.
struct Compression {
    uint32_t buffer = kNone;
    uint64_t offset = 0, length = 0, stride = 0, count = 0;
    CompressionMode mode = CompressionMode::attributes;
    CompressionFilter filter = CompressionFilter::none;
};

struct View {
    uint32_t buffer = kNone;
    uint64_t offset = 0, length = 0, stride = 0;  // stride 0: tightly packed
    std::optional<Compression> compression;
};

enum class Component : uint16_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };
size_t size_bytes(Component component);

struct Sparse {
    uint64_t count = 0;
    uint32_t index_view = kNone, value_view = kNone;
    uint64_t index_offset = 0, value_offset = 0;
    Component index_component = Component::uint32;
};

struct Accessor {
    uint32_t view = kNone;
    uint64_t offset = 0, count = 0;
    Component component = Component::float32;
    uint32_t width = 1;  // components of an element: 1 to 4; 0 is a matrix, which no vertex has
    bool is_normalized = false;
    std::optional<Sparse> sparse;
};

// An attribute's name and its accessor, or in a Draco stream its identifier.
using Attributes = std::vector<std::pair<std::string, uint32_t>>;
uint32_t find(const Attributes& attributes, const std::string& name);  // kNone if it is not there

struct Draco {
    uint32_t view = kNone;
    Attributes attributes;
};

struct Primitive {
    uint32_t mode = 4;
    uint32_t indices = kNone;
    uint32_t material = kNone;
    Attributes attributes;
    std::optional<Draco> draco;
};

struct Node {
    std::string name;
    std::vector<uint32_t> children;
    uint32_t mesh = kNone;
    glm::dmat4 transform{1};
    // What transform is made of, unless the file has a matrix.
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
    std::vector<uint32_t> lods;  // MSFT_lod: nodes that stand for it, finest first
};

// What moves a node in time.
struct Channel {
    enum class Way : uint8_t { linear, step, cubic };
    uint32_t node = kNone, times = kNone, values = kNone;  // accessors
    bool is_rotation = false;                              // else its translation
    Way way = Way::linear;
};

struct Material {
    Surface surface;  // without its texture
    uint32_t texture_image = kNone;
    uint32_t uv_set = 0;
    glm::dmat3 uv_transform{1};  // KHR_texture_transform
};

struct Image {
    std::string name, uri, mime_type;
    uint32_t view = kNone;
};

struct Document {
    std::vector<Buffer> buffers;
    std::vector<View> views;
    std::vector<Accessor> accessors;
    std::vector<std::vector<Primitive>> meshes;
    std::vector<Node> nodes;
    std::vector<uint32_t> roots;    // nodes of the scene that is shown
    std::vector<Channel> channels;  // of its first animation
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<std::string> notes;  // what of the file is not read
};

// Parses the JSON of a glTF file; `name` is the file's. Fails with Exit::bad_input, among others:
//   "a.glb: is not JSON: unexpected ',', a value was expected"
//   "a.glb: /accessors/3/bufferView: 7 does not exist, there are 5"
//   "a.glb: needs KHR_something, which is not read; export it without"
Result<Document> read_document(std::string_view json, const std::string& name);

}  // namespace overlook::mesh::gltf
