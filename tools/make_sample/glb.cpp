#include "tools/make_sample/glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/srgb.h"

namespace overlook::sample {
namespace {

using nlohmann::ordered_json;

constexpr int kFloat = 5126, kUint32 = 5125;

glm::vec3 gltf_axes(const glm::dvec3& v) {
    return {float(v.x), float(v.z), float(-v.y)};
}

class GlbMaker {
  public:
    explicit GlbMaker(const std::vector<mesh::Surface>& surfaces) {
        root_["asset"] = {{"version", "2.0"}, {"generator", "make-sample"}};
        for (const mesh::Surface& surface : surfaces) add_material(surface);
    }

    void add_node(const GlbNode& node, double turn_s) {
        ordered_json primitives = ordered_json::array();
        for (uint32_t surface = 0; surface < node.mesh.surfaces.size(); ++surface) add_primitive(node.mesh, surface, primitives);
        root_["meshes"].push_back({{"name", node.name}, {"primitives", primitives}});
        glm::vec3 at = gltf_axes(node.at_m);
        auto number = root_["nodes"].size();
        root_["nodes"].push_back({{"name", node.name}, {"mesh", number}, {"translation", {at.x, at.y, at.z}}});
        if (node.axis != glm::dvec3(0)) add_turn(number, gltf_axes(node.axis), turn_s);
    }

    std::string text() {
        ordered_json numbers = ordered_json::array();
        for (size_t i = 0; i < root_["nodes"].size(); ++i) numbers.push_back(i);
        root_["scene"] = 0, root_["scenes"] = ordered_json::array({{{"nodes", numbers}}});
        root_["buffers"] = ordered_json::array({{{"byteLength", binary_.size()}}});
        std::string json = root_.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        std::string text = "glTF";
        append(text, uint32_t(2)), append(text, uint32_t(28 + json.size() + binary_.size()));
        append(text, uint32_t(json.size())), text += "JSON" + json;
        append(text, uint32_t(binary_.size())), text += std::string("BIN\0", 4) + binary_;
        return text;
    }

  private:
    template <class T>
    static void append(std::string& to, T value) {
        static_assert(std::endian::native == std::endian::little && sizeof(T) == 4);
        to.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }

    size_t add_view(const std::string& bytes) {
        binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        root_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_ += bytes;
        return root_["bufferViews"].size() - 1;
    }

    size_t add_floats(const std::vector<float>& values, int width, bool has_bounds = false) {
        static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        std::string bytes;
        for (float value : values) append(bytes, value);
        ordered_json accessor{{"bufferView", add_view(bytes)},
                              {"componentType", kFloat},
                              {"type", kTypes[width]},
                              {"count", values.size() / size_t(width)}};
        if (has_bounds) {
            std::vector<float> low(values.begin(), values.begin() + width), high = low;
            for (size_t i = 0; i < values.size(); ++i) {
                low[i % size_t(width)] = std::min(low[i % size_t(width)], values[i]);
                high[i % size_t(width)] = std::max(high[i % size_t(width)], values[i]);
            }
            accessor["min"] = low, accessor["max"] = high;
        }
        root_["accessors"].push_back(accessor);
        return root_["accessors"].size() - 1;
    }

    size_t add_indices(const std::vector<uint32_t>& indices) {
        std::string bytes;
        for (uint32_t index : indices) append(bytes, index);
        size_t view = add_view(bytes);
        root_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", kUint32}, {"type", "SCALAR"}, {"count", indices.size()}});
        return root_["accessors"].size() - 1;
    }

    void add_material(const mesh::Surface& surface) {
        const glm::vec4& c = surface.base_colour;
        auto linear = [](float encoded) { return float(linear_from_srgb(encoded)); };
        ordered_json shading{{"baseColorFactor", {linear(c.r), linear(c.g), linear(c.b), c.a}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
        if (!surface.texture_bytes.empty()) {
            const auto* bytes = reinterpret_cast<const char*>(surface.texture_bytes.data());
            size_t view = add_view(std::string(bytes, surface.texture_bytes.size()));
            root_["images"].push_back({{"name", surface.texture}, {"mimeType", "image/png"}, {"bufferView", view}});
            root_["textures"].push_back({{"source", root_["images"].size() - 1}});
            shading["baseColorTexture"] = {{"index", root_["textures"].size() - 1}};
        }
        ordered_json material{{"name", surface.name}, {"pbrMetallicRoughness", shading}, {"doubleSided", surface.is_two_sided}};
        if (surface.is_alpha_masked) material["alphaMode"] = "MASK", material["alphaCutoff"] = surface.alpha_cutoff;
        root_["materials"].push_back(material);
    }

    // Corners of one surface, those that are equal made one vertex.
    void add_primitive(const mesh::Mesh& mesh, uint32_t surface, ordered_json& primitives) {
        std::map<std::array<uint32_t, 3>, uint32_t> number;
        std::vector<float> positions, normals, uvs;
        std::vector<uint32_t> indices;
        auto add = [](std::vector<float>& to, const glm::vec3& v) { to.insert(to.end(), {v.x, v.y, v.z}); };
        for (size_t f = 0; f < mesh.faces.size(); ++f) {
            if (mesh.face_surface[f] != surface) continue;
            for (size_t c = 0; c < 3; ++c) {
                uint32_t uv = mesh.face_uvs.empty() ? mesh::kNone : mesh.face_uvs[f][c];
                auto [at, is_new] = number.try_emplace({mesh.faces[f][c], mesh.face_normals[f][c], uv}, uint32_t(number.size()));
                indices.push_back(at->second);
                if (!is_new) continue;
                add(positions, gltf_axes(glm::dvec3(corner_m(mesh, f, c))));
                add(normals, gltf_axes(glm::dvec3(mesh.normals[mesh.face_normals[f][c]])));
                if (uv != mesh::kNone) uvs.insert(uvs.end(), {mesh.uvs[uv].x, mesh.uvs[uv].y});
            }
        }
        if (indices.empty()) return;
        ordered_json attributes{{"POSITION", add_floats(positions, 3, true)}, {"NORMAL", add_floats(normals, 3)}};
        if (!uvs.empty()) attributes["TEXCOORD_0"] = add_floats(uvs, 2);
        primitives.push_back({{"attributes", attributes}, {"indices", add_indices(indices)}, {"material", surface}});
    }

    // A whole turn in quarters, the shorter way each.
    void add_turn(size_t node, const glm::vec3& axis, double turn_s) {
        std::vector<float> times, turns;
        for (int quarter = 0; quarter <= 4; ++quarter) {
            double half = std::numbers::pi / 4 * quarter;
            times.push_back(float(turn_s * quarter / 4));
            for (int i = 0; i < 3; ++i) turns.push_back(float(std::sin(half)) * axis[i]);
            turns.push_back(float(std::cos(half)));
        }
        size_t input = add_floats(times, 1, true), output = add_floats(turns, 4);
        if (!root_.contains("animations")) root_["animations"] = ordered_json::array({{{"name", "turn"}}});
        ordered_json& animation = root_["animations"][0];
        animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", "rotation"}}}});
    }

    ordered_json root_;
    std::string binary_;
};

}  // namespace

std::string glb_text(const std::vector<GlbNode>& nodes, double turn_s) {
    GlbMaker maker(nodes[0].mesh.surfaces);
    for (const GlbNode& node : nodes) maker.add_node(node, turn_s);
    return maker.text();
}

}  // namespace overlook::sample
