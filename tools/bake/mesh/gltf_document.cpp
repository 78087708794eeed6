// The JSON of glTF files.

#include "tools/bake/mesh/gltf_document.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "tools/bake/mesh/gltf_animation.h"
#include "tools/bake/mesh/gltf_json.h"
#include "tools/bake/mesh/gltf_material.h"

namespace overlook::mesh::gltf {
namespace {

using Json = nlohmann::json;

// Extensions without which a file cannot be shown rightly, and that are read; or that change nothing of what is baked.
bool is_read(const std::string& extension) {
    static constexpr std::string_view kRead[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                 "KHR_mesh_quantization",      "KHR_texture_transform",
                                                 "KHR_texture_basisu",         "EXT_texture_webp",
                                                 "EXT_texture_avif",           "KHR_lights_punctual",
                                                 "KHR_animation_pointer",      "MSFT_lod"};
    return std::find(std::begin(kRead), std::end(kRead), extension) != std::end(kRead) || extension.starts_with("KHR_materials_");
}

class DocumentReader {
  public:
    DocumentReader(const Json& root, const std::string& name) : root_(root), name_(name), values_(name) {}

    Result<Document> read() {
        if (auto r = check_extensions(); !r) return tl::unexpected(r.error());
        each("buffers", [&](const Json& o, const std::string& at) { read_buffer(o, at); });
        each("bufferViews", [&](const Json& o, const std::string& at) { read_view(o, at); });
        each("accessors", [&](const Json& o, const std::string& at) { read_accessor(o, at); });
        each("images", [&](const Json& o, const std::string& at) { read_image(o, at); });
        document_.materials = read_materials<Json>(root_, document_.images.size(), values_);
        each("meshes", [&](const Json& o, const std::string& at) { read_mesh(o, at); });
        node_count_ = values_.array(root_, "nodes", "").size();
        each("nodes", [&](const Json& o, const std::string& at) { read_node(o, at); });
        read_scene();
        document_.channels = read_channels<Json>(root_, node_count_, document_.accessors.size(), values_, unread_);
        note_what_is_not_read();
        if (!values_.is_right()) return values_.mistake();
        return std::move(document_);
    }

  private:
    template <class Read>
    void each(const char* key, const Read& read) {
        const Json& array = values_.array(root_, key, "");
        for (size_t i = 0; i < array.size(); ++i) read(array[i], fmt::format("/{}/{}", key, i));
    }

    Result<void> check_extensions() {
        const std::string version = values_.text(values_.member(root_, "asset"), "version");
        if (!version.starts_with("2."))
            return bad_input("{}: is glTF {}, read is glTF 2", name_, version.empty() ? "of no version" : version);
        for (const Json& extension : values_.array(root_, "extensionsRequired", "")) {
            const std::string required = extension.is_string() ? extension.get<std::string>() : "";
            if (!is_read(required)) return bad_input("{}: needs {}, which is not read; export it without", name_, required);
        }
        return {};
    }

    void read_buffer(const Json& o, const std::string& at) {
        Buffer buffer;
        buffer.uri = values_.text(o, "uri");
        buffer.byte_length = values_.whole(o, "byteLength", 0, at);
        const Json& extension = values_.member(values_.member(o, "extensions"), "EXT_meshopt_compression");
        buffer.is_fallback = values_.boolean(extension, "fallback");
        document_.buffers.push_back(buffer);
    }

    void read_view(const Json& o, const std::string& at) {
        View view;
        view.buffer = values_.needed_reference(o, "buffer", document_.buffers.size(), at);
        view.offset = values_.whole(o, "byteOffset", 0, at);
        view.length = values_.whole(o, "byteLength", 0, at);
        view.stride = values_.whole(o, "byteStride", 0, at);
        const Json& extension = values_.member(values_.member(o, "extensions"), "EXT_meshopt_compression");
        if (extension.is_object()) view.compression = read_compression(extension, at);
        document_.views.push_back(view);
    }

    Compression read_compression(const Json& o, const std::string& at) {
        Compression compression;
        compression.buffer = values_.needed_reference(o, "buffer", document_.buffers.size(), at);
        compression.offset = values_.whole(o, "byteOffset", 0, at);
        compression.length = values_.whole(o, "byteLength", 0, at);
        compression.stride = values_.whole(o, "byteStride", 0, at);
        compression.count = values_.whole(o, "count", 0, at);
        const auto one_of = [&](const char* key, std::initializer_list<std::string_view> known) {
            const std::string word = values_.text(o, key);
            for (size_t i = 0; i < known.size(); ++i)
                if (known.begin()[i] == word) return i;
            if (!(word.empty() && known.begin()[0] == "NONE")) values_.fail(at + "/" + key, word + " is not known");
            return size_t(0);
        };
        compression.mode = CompressionMode(one_of("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}));
        compression.filter = CompressionFilter(one_of("filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}));
        return compression;
    }

    Component read_component(const Json& o, const std::string& at) {
        const uint64_t component = values_.whole(o, "componentType", 0, at);
        const bool is_known = component >= 5120 && component <= 5126 && component != 5124;
        if (!is_known) values_.fail(at + "/componentType", fmt::format("{} is not known", component));
        return is_known ? Component(component) : Component::float32;
    }

    void read_accessor(const Json& o, const std::string& at) {
        Accessor accessor;
        accessor.view = values_.reference(o, "bufferView", document_.views.size(), at);
        accessor.offset = values_.whole(o, "byteOffset", 0, at);
        accessor.count = values_.whole(o, "count", 0, at);
        accessor.component = read_component(o, at);
        accessor.is_normalized = values_.boolean(o, "normalized");
        const std::string type = values_.text(o, "type");
        accessor.width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
        const Json& sparse = values_.member(o, "sparse");
        if (sparse.is_object()) accessor.sparse = read_sparse(sparse, at + "/sparse");
        document_.accessors.push_back(accessor);
    }

    Sparse read_sparse(const Json& o, const std::string& at) {
        const Json &indices = values_.member(o, "indices"), &values = values_.member(o, "values");
        Sparse sparse;
        sparse.count = values_.whole(o, "count", 0, at);
        sparse.index_view = values_.needed_reference(indices, "bufferView", document_.views.size(), at + "/indices");
        sparse.index_offset = values_.whole(indices, "byteOffset", 0, at + "/indices");
        sparse.index_component = read_component(indices, at + "/indices");
        sparse.value_view = values_.needed_reference(values, "bufferView", document_.views.size(), at + "/values");
        sparse.value_offset = values_.whole(values, "byteOffset", 0, at + "/values");
        return sparse;
    }

    void read_image(const Json& o, const std::string& at) {
        Image image;
        image.name = values_.text(o, "name");
        image.uri = values_.text(o, "uri");
        image.mime_type = values_.text(o, "mimeType");
        image.view = values_.reference(o, "bufferView", document_.views.size(), at);
        document_.images.push_back(image);
    }

    Attributes read_attributes(const Json& o, size_t count, const std::string& at) {
        Attributes attributes;
        if (!o.is_object()) return attributes;
        for (const auto& item : o.items()) {
            const uint32_t value = values_.reference(o, item.key().c_str(), count, at);
            attributes.emplace_back(item.key(), value);
        }
        return attributes;
    }

    void read_mesh(const Json& o, const std::string& at) {
        std::vector<Primitive>& primitives = document_.meshes.emplace_back();
        const Json& array = values_.array(o, "primitives", at);
        for (size_t i = 0; i < array.size(); ++i)
            primitives.push_back(read_primitive(array[i], fmt::format("{}/primitives/{}", at, i)));
    }

    Primitive read_primitive(const Json& o, const std::string& at) {
        Primitive primitive;
        primitive.mode = uint32_t(std::min<uint64_t>(values_.whole(o, "mode", 4, at), 7));
        if (primitive.mode == 7) values_.fail(at + "/mode", "is none of 0 to 6");
        primitive.indices = values_.reference(o, "indices", document_.accessors.size(), at);
        primitive.material = values_.reference(o, "material", document_.materials.size(), at);
        primitive.attributes = read_attributes(values_.member(o, "attributes"), document_.accessors.size(), at + "/attributes");
        const Json& draco = values_.member(values_.member(o, "extensions"), "KHR_draco_mesh_compression");
        if (draco.is_object()) {
            const std::string place = at + "/extensions/KHR_draco_mesh_compression";
            primitive.draco = Draco{values_.needed_reference(draco, "bufferView", document_.views.size(), place),
                                    read_attributes(values_.member(draco, "attributes"), kNone, place + "/attributes")};
        }
        has_morphs_ = has_morphs_ || !values_.member(o, "targets").is_null();
        return primitive;
    }

    void read_node(const Json& o, const std::string& at) {
        Node node;
        node.name = values_.text(o, "name");
        node.mesh = values_.reference(o, "mesh", document_.meshes.size(), at);
        node.children = read_nodes(o, "children", at);
        node.lods = read_nodes(values_.member(values_.member(o, "extensions"), "MSFT_lod"), "ids", at);
        read_transform(o, at, node);
        has_instances_ = has_instances_ || !values_.member(values_.member(o, "extensions"), "EXT_mesh_gpu_instancing").is_null();
        document_.nodes.push_back(std::move(node));
    }

    std::vector<uint32_t> read_nodes(const Json& o, const char* key, const std::string& at) {
        std::vector<uint32_t> nodes;
        for (const Json& node : values_.array(o, key, at)) {
            const bool is_there = node.is_number_unsigned() && node.get<uint64_t>() < node_count_;
            if (!is_there) values_.fail(at + "/" + key, "names a node that does not exist");
            if (is_there) nodes.push_back(node.get<uint32_t>());
        }
        return nodes;
    }

    void read_transform(const Json& o, const std::string& at, Node& node) {
        double matrix[16];
        if (values_.numbers(o, "matrix", matrix, 16, at)) {
            node.transform = glm::make_mat4(matrix);
            return;
        }
        double t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        (void)values_.numbers(o, "translation", t, 3, at);
        const bool is_rotated = values_.numbers(o, "rotation", r, 4, at);
        (void)values_.numbers(o, "scale", s, 3, at);
        node.translation = {t[0], t[1], t[2]}, node.scale = {s[0], s[1], s[2]};
        node.transform = glm::translate(glm::dmat4(1), node.translation);
        const glm::dquat rotation(r[3], r[0], r[1], r[2]);
        if (is_rotated && glm::length(rotation) > 0) {
            node.rotation = glm::normalize(rotation);
            node.transform *= glm::mat4_cast(node.rotation);
        }
        node.transform = glm::scale(node.transform, node.scale);
    }

    // The default scene, else the first; without scenes every node that is no child.
    void read_scene() {
        const Json& scenes = values_.array(root_, "scenes", "");
        if (!scenes.empty()) {
            const uint32_t named = values_.reference(root_, "scene", scenes.size(), "");
            const Json& scene = scenes[named == kNone ? 0 : named];
            for (const Json& root : values_.array(scene, "nodes", "/scenes")) {
                const bool is_there = root.is_number_unsigned() && root.get<uint64_t>() < document_.nodes.size();
                if (!is_there) values_.fail("/scenes", "names a node that does not exist");
                if (is_there) document_.roots.push_back(root.get<uint32_t>());
            }
            return;
        }
        std::vector<uint8_t> is_child(document_.nodes.size(), 0);
        for (const Node& node : document_.nodes)
            for (const std::vector<uint32_t>* below : {&node.children, &node.lods})
                for (const uint32_t child : *below) is_child[child] = 1;
        for (uint32_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) document_.roots.push_back(i);
    }

    void note_what_is_not_read() {
        const auto note = [&](bool has, const char* what) {
            if (has) document_.notes.push_back(fmt::format("{}: {}", name_, what));
        };
        for (const std::string& what : unread_) document_.notes.push_back(fmt::format("{}: its {}", name_, what));
        note(has_morphs_, "its morph targets are not read; the mesh is in its first shape");
        note(has_instances_, "its EXT_mesh_gpu_instancing is not read; each mesh stands once");
        note(!values_.array(root_, "skins", "").empty(), "its skins are not read; the mesh is in the pose that it was bound in");
    }

    const Json& root_;
    const std::string& name_;
    Values<Json> values_;
    Document document_;
    size_t node_count_ = 0;
    std::vector<std::string> unread_;
    bool has_morphs_ = false, has_instances_ = false;
};

}  // namespace

size_t size_bytes(Component component) {
    switch (component) {
        case Component::int8:
        case Component::uint8:
            return 1;
        case Component::int16:
        case Component::uint16:
            return 2;
        default:
            return 4;
    }
}

uint32_t find(const Attributes& attributes, const std::string& name) {
    for (const auto& [key, value] : attributes)
        if (key == name) return value;
    return kNone;
}

Result<Document> read_document(std::string_view text, const std::string& name) {
    try {
        const Json root = Json::parse(text);
        if (!root.is_object()) return bad_input("{}: its JSON is no object", name);
        return DocumentReader(root, name).read();
    } catch (const Json::exception& problem) {
        std::string what = problem.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        return bad_input("{}: is not JSON: {}", name, what);
    }
}

}  // namespace overlook::mesh::gltf
