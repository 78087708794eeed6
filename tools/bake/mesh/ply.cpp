// PLY files. Sources: G. Turk, "The PLY Polygon File Format", 1994; tristrips as the Stanford repository's files have them
// ("VRIP", B. Curless, 1996): one list of vertex numbers, -1 begins a new strip.

#include <cmath>

#include "tools/bake/mesh/ply_rows.h"
#include "tools/bake/mesh/ply_scalars.h"
#include "tools/bake/mesh/polygons.h"

namespace overlook::mesh {
namespace {

class PlyReader {
  public:
    PlyReader(const InputFile& file, Text text, PlyHeader header)
        : file_(file), header_(std::move(header)), rows_(text, header_.form) {}

    Result<Soup> read() {
        soup_.report.form = header_.form == PlyForm::ascii ? "PLY ascii" : "PLY binary";
        for (const PlyElement& element : header_.elements) {
            if (auto r = read_element(element); !r) return tl::unexpected(r.error());
        }
        if (auto r = check_indices(); !r) return tl::unexpected(r.error());
        name_surfaces();
        if (auto r = add_polygons(polygons_, file_.path, soup_); !r) return tl::unexpected(r.error());
        if (auto r = add_strips(); !r) return tl::unexpected(r.error());
        attach();
        return std::move(soup_);
    }

  private:
    Result<void> read_element(const PlyElement& element) {
        if (element.properties.empty()) return {};
        const Scalars scalars(element);
        if (element.name == "vertex") return read_vertices(element, scalars);
        if (element.name == "face") return read_faces(element, scalars);
        if (element.name == "tristrips") return read_strips(element);
        for (uint64_t row = 0; row < element.count; ++row) {
            rows_.begin_row();
            for (const PlyProperty& property : element.properties) rows_.skip(property);
            rows_.end_row();
            if (rows_.has_failed()) return failure(element, row);
        }
        if (element.name == "edge") soup_.report.other_primitive_count += element.count;
        return {};
    }

    tl::unexpected<Error> failure(const PlyElement& element, uint64_t row) const {
        return bad_input("{}: {} {}: {}", file_.path, element.name, row, rows_.failure());
    }

    Result<void> read_vertices(const PlyElement& element, Scalars scalars) {
        if (!soup_.positions.empty()) return bad_input("{}: has two elements named vertex", file_.path);
        if (!scalars.has[kX] || !scalars.has[kY] || !scalars.has[kZ])
            return bad_input("{}: its vertices have no x, y and z", file_.path);
        soup_.positions.reserve(size_t(element.count));
        const bool has_normal = scalars.has[kNormalX] && scalars.has[kNormalY] && scalars.has[kNormalZ];
        const bool has_uv = scalars.has[kU] && scalars.has[kV];
        for (uint64_t row = 0; row < element.count; ++row) {
            rows_.begin_row();
            for (size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                property.is_list ? rows_.skip(property) : void(scalars.value[scalars.slots[i]] = rows_.value(property.type));
            }
            rows_.end_row();
            if (rows_.has_failed()) return failure(element, row);
            const auto& v = scalars.value;
            soup_.positions.emplace_back(v[kX], v[kY], v[kZ]);
            if (has_normal) soup_.mesh.normals.emplace_back(float(v[kNormalX]), float(v[kNormalY]), float(v[kNormalZ]));
            if (has_uv) vertex_uvs_.emplace_back(float(v[kU]), float(1 - v[kV]));
            if (scalars.has_colour()) vertex_colours_.push_back(scalars.colour());
        }
        return {};
    }

    Result<void> read_faces(const PlyElement& element, Scalars scalars) {
        const bool has_colour = scalars.has_colour();
        std::vector<float> uvs;
        bool has_corner_uvs = false;
        for (const PlyProperty& p : element.properties) has_corner_uvs |= p.is_list && p.name == "texcoord";
        for (uint64_t row = 0; row < element.count; ++row) {
            rows_.begin_row();
            uvs.clear();
            for (size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (!property.is_list)
                    scalars.value[scalars.slots[i]] = rows_.value(property.type);
                else if (property.name == "vertex_indices" || property.name == "vertex_index")
                    read_corners(property);
                else if (property.name == "texcoord")
                    read_floats(property, uvs);
                else
                    rows_.skip(property);
            }
            rows_.end_row();
            if (rows_.has_failed()) return failure(element, row);
            if (missing_ != 0) return missing_vertex(element, row);
            end_face(scalars, has_colour, has_corner_uvs, uvs);
        }
        return {};
    }

    void read_corners(const PlyProperty& list) {
        for (uint64_t left = rows_.list_length(list); left > 0; --left) {
            const double index = rows_.value(list.type);
            if (!(index >= 0 && index < double(kNone))) missing_ = index;
            polygons_.positions.push_back(missing_ == 0 ? uint32_t(index) : 0);
        }
    }

    void read_floats(const PlyProperty& list, std::vector<float>& values) {
        for (uint64_t left = rows_.list_length(list); left > 0; --left) values.push_back(float(rows_.value(list.type)));
    }

    void end_face(const Scalars& scalars, bool has_colour, bool has_corner_uvs, const std::vector<float>& uvs) {
        const size_t count = polygons_.positions.size() - size_t(polygons_.begin.back());
        polygons_.end_polygon();
        for (size_t i = 0; has_corner_uvs && i < count; ++i) {
            const bool is_there = uvs.size() == 2 * count;
            polygons_.uvs.push_back(is_there ? glm::vec2(uvs[2 * i], 1 - uvs[2 * i + 1]) : glm::vec2(NAN));
        }
        if (has_colour) {
            polygons_.colours.push_back(uint32_t(face_colours_.size()));
            face_colours_.push_back(scalars.colour());
        }
        const double texture = scalars.has[kTexture] ? scalars.value[kTexture] : 0;
        const bool is_known = texture >= 0 && texture < double(header_.textures.size());
        if (header_.textures.size() > 1) polygons_.surfaces.push_back(is_known ? uint32_t(texture) : 0);
    }

    Result<void> read_strips(const PlyElement& element) {
        for (uint64_t row = 0; row < element.count; ++row) {
            rows_.begin_row();
            for (const PlyProperty& property : element.properties) {
                const bool is_strip = property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
                if (!is_strip) rows_.skip(property);
                for (uint64_t left = is_strip ? rows_.list_length(property) : 0; left > 0; --left) {
                    const double index = rows_.value(property.type);
                    if (!(index >= -1 && index < double(kNone))) missing_ = index;
                    strips_.push_back(missing_ != 0 || index < 0 ? kNone : uint32_t(index));
                }
            }
            strips_.push_back(kNone);
            rows_.end_row();
            if (rows_.has_failed()) return failure(element, row);
            if (missing_ != 0) return missing_vertex(element, row);
        }
        return {};
    }

    tl::unexpected<Error> missing_vertex(const PlyElement& element, uint64_t row) const {
        return bad_input("{}: {} {}: vertex {} does not exist; was the file cut short?", file_.path, element.name, row, missing_);
    }

    // Faces may come before vertices, so indices are checked when all is read.
    Result<void> check_indices() const {
        const auto is_missing = [&](uint32_t index) { return index >= soup_.positions.size(); };
        for (size_t i = 0; i < polygons_.size(); ++i)
            for (uint64_t k = polygons_.begin[i]; k < polygons_.begin[i + 1]; ++k)
                if (is_missing(polygons_.positions[size_t(k)]))
                    return bad_input("{}: face {}: vertex {} does not exist, there are {}; was the file cut short?", file_.path,
                                     i, polygons_.positions[size_t(k)], soup_.positions.size());
        for (size_t i = 0; i < strips_.size(); ++i)
            if (strips_[i] != kNone && is_missing(strips_[i]))
                return bad_input("{}: tristrips: number {} is vertex {}, which does not exist, there are {}", file_.path, i,
                                 strips_[i], soup_.positions.size());
        return {};
    }

    void name_surfaces() {
        soup_.mesh.surfaces.resize(std::max<size_t>(1, header_.textures.size()));
        for (size_t i = 0; i < header_.textures.size(); ++i)
            set_texture(soup_, soup_.mesh.surfaces[i], header_.textures[i], file_);
    }

    // Every second triangle of a strip is wound the other way.
    Result<void> add_strips() {
        size_t begin = 0;
        for (size_t i = 0; i < strips_.size(); ++i) {
            if (strips_[i] == kNone) begin = i + 1;
            if (strips_[i] == kNone || i < begin + 2) continue;
            const bool is_odd = (i - begin) % 2 != 0;
            const uint32_t a = strips_[is_odd ? i - 1 : i - 2], b = strips_[is_odd ? i - 2 : i - 1], c = strips_[i];
            if (a == b || b == c || a == c) {
                ++soup_.report.strip_glue_count;
                continue;
            }
            soup_.mesh.faces.push_back({a, b, c});
            soup_.mesh.face_source.push_back(uint32_t(soup_.report.triangle_count));
            soup_.mesh.face_surface.push_back(0);
            if (auto r = count_triangles(soup_, 1, file_.path); !r) return r;
            ++soup_.report.polygon_count;
        }
        return {};
    }

    // Attributes by vertex are those of each corner; those by corner or face count where there are none by vertex.
    void attach() {
        Mesh& mesh = soup_.mesh;
        if (!mesh.normals.empty()) mesh.face_normals = mesh.faces;
        if (mesh.face_uvs.empty() && !vertex_uvs_.empty()) {
            mesh.uvs = std::move(vertex_uvs_);
            mesh.face_uvs = mesh.faces;
        }
        if (!vertex_colours_.empty()) {
            if (!face_colours_.empty())
                soup_.report.notes.push_back(
                    fmt::format("{}: has colours by vertex and by face; those by face are left out", file_.path));
            mesh.colours = std::move(vertex_colours_);
            mesh.face_colours = mesh.faces;
        } else {
            mesh.colours = std::move(face_colours_);
        }
        const Corners none{kNone, kNone, kNone};  // triangles of strips beside faces
        if (!mesh.face_uvs.empty()) mesh.face_uvs.resize(mesh.faces.size(), none);
        if (!mesh.face_colours.empty()) mesh.face_colours.resize(mesh.faces.size(), none);
    }

    const InputFile& file_;
    PlyHeader header_;
    PlyRows rows_;
    Soup soup_;
    Polygons polygons_;
    std::vector<uint32_t> strips_;  // kNone ends one
    std::vector<glm::vec2> vertex_uvs_;
    std::vector<std::array<uint8_t, 4>> vertex_colours_, face_colours_;
    double missing_ = 0;  // an index that no vertex can have
};

}  // namespace

Result<Soup> read_ply(const InputFile& file) {
    Text text(file.bytes);
    Result<PlyHeader> header = read_ply_header(text, file.path);
    if (!header) return tl::unexpected(header.error());
    return PlyReader(file, text, std::move(*header)).read();
}

}  // namespace overlook::mesh
