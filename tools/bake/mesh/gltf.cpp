// glTF files: the scene's nodes place the meshes' primitives.

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>

#include "tools/bake/mesh/gltf_motion.h"
#include "tools/bake/mesh/gltf_primitive.h"
#include "tools/bake/mesh/soup.h"

namespace overlook::mesh {
namespace {

using namespace gltf;

class SceneReader {
  public:
    SceneReader(const InputFile& file, const Document& document, const Container& container)
        : file_(file),
          document_(document),
          buffers_(document, container, file),
          primitives_(document, buffers_, file.path),
          motions_(document, buffers_, file.path),
          above_(document.nodes.size(), kNone),
          meshes_(document.meshes.size()) {
        soup_.report.form = container.is_glb ? "GLB" : "glTF";
        soup_.report.notes = document.notes;
    }

    Result<Soup> read() {
        for (const Material& material : document_.materials) add_surface(material);
        if (file_.options.reads_motion) {
            if (auto r = motions_.read(); !r) return tl::unexpected(r.error());
        }
        if (auto r = walk(); !r) return tl::unexpected(r.error());
        if (soup_.mesh.surfaces.empty()) soup_.mesh.surfaces.resize(1);
        drop_empty_pools();
        if (!soup_.motion.is_empty()) soup_.motion.clip_s = motions_.clip_s();
        return std::move(soup_);
    }

  private:
    struct Visit {
        uint32_t node;
        glm::dmat4 parent;
        uint32_t above, part;  // the parent, or kNone; the part that it belongs to
    };

    // Depth first, children in their order. A node has one parent at most, so each is visited once.
    Result<void> walk() {
        std::vector<uint8_t> is_visited(document_.nodes.size(), 0);
        std::vector<Visit> stack;
        const auto push = [&](const std::vector<uint32_t>& nodes, const glm::dmat4& parent, uint32_t above, uint32_t part) {
            for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, parent, above, part});
        };
        push(document_.roots, glm::dmat4(1), kNone, 0);
        while (!stack.empty()) {
            Visit visit = stack.back();
            stack.pop_back();
            const std::vector<uint32_t>& lods = document_.nodes[visit.node].lods;
            soup_.report.lod_count = std::max(soup_.report.lod_count, uint32_t(lods.size()));
            if (!lods.empty() && file_.options.lod > 0) visit.node = lods[std::min<size_t>(file_.options.lod, lods.size()) - 1];
            if (is_visited[visit.node]++ != 0)
                return bad_input("{}: node {} has two parents, or is its own ancestor", file_.path, visit.node);
            const Node& node = document_.nodes[visit.node];
            const glm::dmat4 transform = visit.parent * node.transform;
            above_[visit.node] = visit.above;
            const uint32_t part = motions_.moves(visit.node) ? part_of(visit) : visit.part;
            if (node.mesh != kNone)
                if (auto r = place_mesh(node.mesh, transform, part); !r) return r;
            push(node.children, transform, visit.node, part);
        }
        return {};
    }

    // A part of its own; what does not move rigidly goes with its parent.
    uint32_t part_of(const Visit& visit) {
        std::vector<uint32_t> ancestors;
        for (uint32_t node = visit.node; node != kNone; node = above_[node]) ancestors.push_back(node);
        std::reverse(ancestors.begin(), ancestors.end());
        std::optional<Motion::Part> part = motions_.part_of(ancestors, soup_.motion.parts.size(), soup_.report.notes);
        if (!part) return visit.part;
        soup_.motion.parts.push_back(std::move(*part));
        return uint32_t(soup_.motion.parts.size());
    }

    Result<void> place_mesh(uint32_t mesh, const glm::dmat4& transform, uint32_t part) {
        soup_.motion.ranges.emplace_back(uint32_t(soup_.report.triangle_count), part);
        if (!meshes_[mesh]) {
            std::vector<Triangles> read;
            for (size_t i = 0; i < document_.meshes[mesh].size(); ++i) {
                const Primitive& primitive = document_.meshes[mesh][i];
                if (primitive.mode < 4) {
                    ++soup_.report.other_primitive_count;
                    continue;
                }
                Result<Triangles> triangles =
                    primitives_.read(primitive, fmt::format("{}: mesh {}, primitive {}", file_.path, mesh, i));
                if (!triangles) return tl::unexpected(triangles.error());
                read.push_back(std::move(*triangles));
            }
            meshes_[mesh] = std::move(read);
        }
        for (const Triangles& triangles : *meshes_[mesh])
            if (auto r = place_triangles(triangles, transform); !r) return r;
        return {};
    }

    Result<void> place_triangles(const Triangles& triangles, const glm::dmat4& transform) {
        Mesh& mesh = soup_.mesh;
        const uint32_t source = uint32_t(soup_.report.triangle_count);
        if (auto r = count_triangles(soup_, triangles.faces.size(), file_.path); !r) return r;
        soup_.report.polygon_count += triangles.faces.size();
        soup_.report.strip_glue_count += triangles.glue_count;

        const uint32_t surface = surface_of(triangles.material);
        const glm::dmat3 linear(transform);
        const bool is_mirrored = glm::determinant(linear) < 0;
        const uint32_t first = uint32_t(soup_.positions.size());
        for (size_t f = 0; f < triangles.faces.size(); ++f) {
            mesh.faces.push_back(wound(triangles.faces[f], first, is_mirrored));
            mesh.face_source.push_back(source + uint32_t(f));
            mesh.face_surface.push_back(surface);
        }
        for (const glm::dvec3& p : triangles.positions) soup_.positions.emplace_back(transform * glm::dvec4(p, 1));
        append(placed_normals(triangles, linear), triangles.faces, is_mirrored, mesh.normals, mesh.face_normals);
        append(triangles.uvs, triangles.faces, is_mirrored, mesh.uvs, mesh.face_uvs);
        append(triangles.uvs2, triangles.faces, is_mirrored, mesh.uvs2, mesh.face_uvs2);
        append(triangles.colours, triangles.faces, is_mirrored, mesh.colours, mesh.face_colours);
        return {};
    }

    static Corners wound(const Corners& face, uint32_t first, bool is_mirrored) {
        return {first + face[0], first + face[is_mirrored ? 2 : 1], first + face[is_mirrored ? 1 : 2]};
    }

    // Normals go with the inverse transposed matrix, whose length does not matter: the cofactors, which exist for every matrix.
    static std::vector<glm::vec3> placed_normals(const Triangles& triangles, const glm::dmat3& linear) {
        if (linear == glm::dmat3(1)) return triangles.normals;
        const double sign = glm::determinant(linear) < 0 ? -1 : 1;
        const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                   glm::cross(linear[0], linear[1]));
        std::vector<glm::vec3> normals;
        for (const glm::vec3& normal : triangles.normals) {
            const glm::dvec3 placed = sign * (cofactors * glm::dvec3(normal));
            const double length = glm::length(placed);
            normals.emplace_back(length > 0 ? placed / length : placed);
        }
        return normals;
    }

    // Appends an attribute's values, and its indices of the faces that were added last.
    template <class T>
    static void append(const std::vector<T>& values, const std::vector<Corners>& faces, bool is_mirrored, std::vector<T>& pool,
                       std::vector<Corners>& rows) {
        const uint32_t first = uint32_t(pool.size());
        pool.insert(pool.end(), values.begin(), values.end());
        for (const Corners& face : faces)
            rows.push_back(values.empty() ? Corners{kNone, kNone, kNone} : wound(face, first, is_mirrored));
    }

    void drop_empty_pools() {
        Mesh& mesh = soup_.mesh;
        if (mesh.normals.empty()) mesh.face_normals.clear();
        if (mesh.uvs.empty()) mesh.face_uvs.clear();
        if (mesh.uvs2.empty()) mesh.face_uvs2.clear();
        if (mesh.colours.empty()) mesh.face_colours.clear();
    }

    // What has no material has one surface of its own, after the others.
    uint32_t surface_of(uint32_t material) {
        if (material != kNone) return material;
        if (soup_.mesh.surfaces.size() == document_.materials.size()) soup_.mesh.surfaces.emplace_back();
        return uint32_t(document_.materials.size());
    }

    void add_surface(const Material& material) {
        Surface& surface = soup_.mesh.surfaces.emplace_back(material.surface);
        if (material.texture_image == kNone) return;
        const Image& image = document_.images[material.texture_image];
        if (image.view == kNone && !image.uri.starts_with("data:")) {
            set_texture(soup_, surface, decode_percents(image.uri), file_);
            return;
        }
        surface.texture = name_of(image, material.texture_image);
        if (!file_.options.reads_textures || !soup_.textures.insert(surface.texture).second) return;
        surface.texture_bytes = embedded(image, surface.texture);
    }

    std::vector<uint8_t> embedded(const Image& image, const std::string& name) {
        std::optional<std::vector<std::byte>> data;
        Bytes bytes;
        if (image.view == kNone) {
            data = decode_data_uri(image.uri);
            if (data) bytes = *data;
        } else if (const Result<Bytes> view = buffers_.view(image.view)) {
            bytes = *view;
        }
        if (bytes.empty())
            soup_.report.notes.push_back(
                fmt::format("{}: {} is not in the file; what it covers is drawn in its plain colour", file_.path, name));
        const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
        return {begin, begin + bytes.size()};
    }

    // Embedded images have no file name: "image-3.png".
    static std::string name_of(const Image& image, uint32_t index) {
        std::string type = image.mime_type;
        if (type.empty() && image.uri.starts_with("data:")) type = image.uri.substr(5, image.uri.find_first_of(";,") - 5);
        const std::string ending = type == "image/png"    ? ".png"
                                   : type == "image/jpeg" ? ".jpg"
                                   : type == "image/webp" ? ".webp"
                                   : type == "image/ktx2" ? ".ktx2"
                                                          : "";
        return fmt::format("image-{}{}", index, ending);
    }

    const InputFile& file_;
    const Document& document_;
    Buffers buffers_;
    PrimitiveReader primitives_;
    MotionReader motions_;
    std::vector<uint32_t> above_;                                // [nodes] each visited one's parent, or kNone
    std::vector<std::optional<std::vector<Triangles>>> meshes_;  // read on first use
    Soup soup_;
};

}  // namespace

Result<Soup> read_gltf(const InputFile& file) {
    const Result<Container> container = open_container(file.bytes, file.path);
    if (!container) return tl::unexpected(container.error());
    const Result<Document> document = read_document(container->json, file.path);
    if (!document) return tl::unexpected(document.error());
    return SceneReader(file, *document, *container).read();
}

}  // namespace overlook::mesh
