// The one source file that knows tinygltf.
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "formats/atomic_file.h"
#include "formats/srgb.h"
#include "tools/baked/mesh_file.h"

namespace overlook {
namespace {

struct Bounds {
    double low[3], high[3];
};

Bounds bounds_of(const MeshData& mesh) {
    Bounds bounds{{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        double value = mesh.positions[i];
        bounds.low[i % 3] = i < 3 ? value : std::min(bounds.low[i % 3], value);
        bounds.high[i % 3] = i < 3 ? value : std::max(bounds.high[i % 3], value);
    }
    return bounds;
}

// Bytes at the end of the one buffer, aligned to 4, as a view; returns its number.
int add_view(tinygltf::Model& model, const void* bytes, size_t size, int target) {
    std::vector<unsigned char>& data = model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    data.resize(data.size() + size);
    if (size > 0) std::memcpy(data.data() + view.byteOffset, bytes, size);
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size()) - 1;
}

int add_accessor(tinygltf::Model& model, int view, int component, int type, size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    accessor.normalized = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    model.accessors.push_back(accessor);
    return int(model.accessors.size()) - 1;
}

// glTF is right-handed with y up: (x, y, z) -> (x, z, -y), where z is height.
std::array<double, 3> gltf_axes(double x, double y, double z) {
    return {x, z, -y};
}

// About the box's middle.
std::vector<float> gltf_positions(const MeshData& mesh, const double middle[3], double& rounding_m) {
    std::vector<float> out;
    out.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
        for (double value : gltf_axes(mesh.positions[i] - middle[0], mesh.positions[i + 1] - middle[1],
                                      mesh.positions[i + 2] - middle[2])) {
            out.push_back(float(value));
            rounding_m = std::max(rounding_m, std::abs(double(float(value)) - value));
        }
    }
    return out;
}

// glTF wants colours in four bytes, linear.
std::vector<uint8_t> gltf_colours(const std::vector<uint8_t>& srgb) {
    uint8_t linear[256];
    for (int i = 0; i < 256; ++i) linear[i] = uint8_t(std::lround(255 * linear_from_srgb_code(uint8_t(i))));
    std::vector<uint8_t> out;
    for (size_t i = 0; i < srgb.size(); i += 3)
        out.insert(out.end(), {linear[srgb[i]], linear[srgb[i + 1]], linear[srgb[i + 2]], uint8_t(255)});
    return out;
}

tinygltf::Model model_of(const MeshData& mesh, MeshReport& report) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "overlook";
    model.buffers.emplace_back();
    Bounds bounds = bounds_of(mesh);
    double middle[3];
    for (int i = 0; i < 3; ++i) middle[i] = (bounds.low[i] + bounds.high[i]) / 2;

    size_t count = mesh.positions.size() / 3;
    std::vector<float> positions = gltf_positions(mesh, middle, report.rounding_m);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    int view = add_view(model, positions.data(), positions.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["POSITION"] = add_accessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count);
    for (size_t axis = 0; axis < 3; ++axis) {
        float low = 0, high = 0;
        for (size_t i = axis; i < positions.size(); i += 3)
            low = i == axis ? positions[i] : std::min(low, positions[i]),
            high = i == axis ? positions[i] : std::max(high, positions[i]);
        model.accessors.back().minValues.push_back(low);
        model.accessors.back().maxValues.push_back(high);
    }
    if (!mesh.colours.empty()) {
        std::vector<uint8_t> colours = gltf_colours(mesh.colours);
        view = add_view(model, colours.data(), colours.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
        primitive.attributes["COLOR_0"] =
            add_accessor(model, view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4, count);
    }
    view = add_view(model, mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.indices =
        add_accessor(model, view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, mesh.indices.size());

    tinygltf::Material material;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 1;
    model.materials.push_back(material);
    primitive.material = 0;
    tinygltf::Mesh gltf_mesh;
    gltf_mesh.primitives.push_back(primitive);
    model.meshes.push_back(gltf_mesh);
    tinygltf::Node node;
    node.mesh = 0;
    std::array<double, 3> centre = gltf_axes(middle[0], middle[1], middle[2]);
    node.translation.assign(centre.begin(), centre.end());
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return model;
}

}  // namespace

Result<void> write_glb(const std::string& path, const MeshData& mesh, MeshReport& report) {
    if (mesh.indices.empty()) return bad_input("{}: the cut has no triangles, and glTF cannot hold a mesh of none", path);
    tinygltf::Model model = model_of(mesh, report);
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true))
        return cannot_write("{}: the glTF writer refused the mesh", path);
    std::string bytes = std::move(stream).str();
    report.file_bytes = bytes.size();
    return write_file(path, std::string_view(bytes));
}

}  // namespace overlook
