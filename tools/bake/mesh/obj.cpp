// OBJ files. Source: Wavefront Technologies, "Advanced Visualizer Manual, Appendix B1: Object Files", 1995.

#include "tools/bake/mesh/obj.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/mesh/polygon.h"
#include "tools/bake/mesh/text.h"

namespace overlook::mesh {
namespace {

// A corner of a face as numbers of v, vt, vn from 0, or kNone.
struct Corner {
    uint32_t position, uv, normal;
};

class ObjReader {
  public:
    explicit ObjReader(const InputFile& file) : file_(file), text_(file.bytes) {}

    Result<Soup> read() {
        soup_.report.form = "OBJ";
        for (; text_.find_line('#'); text_.next_line()) {
            if (auto r = read_line(text_.word()); !r) return tl::unexpected(r.error());
        }
        if (auto r = check_indices(); !r) return tl::unexpected(r.error());
        attach();
        return std::move(soup_);
    }

  private:
    Result<void> read_line(std::string_view key) {
        if (key == "v") return read_position();
        if (key == "vt") return read_uv();
        if (key == "vn") return read_normal();
        if (key == "f" || key == "fo") return read_face();
        if (key == "usemtl") use_material(std::string(text_.rest()));
        if (key == "mtllib") read_library(std::string(text_.rest()));
        if (key == "l" || key == "p") ++soup_.report.other_primitive_count;
        return {};
    }

    tl::unexpected<Error> mistake(const char* what) const { return bad_input("{}:{}: {}", file_.path, text_.line(), what); }

    // x y z, x y z w, x y z r g b, x y z r g b a.
    Result<void> read_position() {
        double values[7] = {};
        int count = 0;
        while (count < 7 && text_.number(values[count])) ++count;
        const bool has_ended = text_.is_at_line_end() || text_.peek() == '#';
        if (count < 3 || !has_ended) return mistake("a vertex is three numbers, or six with its colour");
        soup_.positions.emplace_back(values[0], values[1], values[2]);
        if (count >= 6) {
            colours_.resize(soup_.positions.size() - 1, {1, 1, 1, 1});
            colours_.push_back({values[3], values[4], values[5], count == 7 ? values[6] : -1});
        }
        return {};
    }

    // Rows of textures are counted from the top, OBJ's v from the bottom.
    Result<void> read_uv() {
        double u = 0, v = 0;
        if (!text_.number(u)) return mistake("a texture coordinate is two numbers");
        (void)text_.number(v);
        soup_.mesh.uvs.emplace_back(float(u), float(1 - v));
        return {};
    }

    Result<void> read_normal() {
        double x = 0, y = 0, z = 0;
        if (!text_.number(x) || !text_.number(y) || !text_.number(z)) return mistake("a normal is three numbers");
        soup_.mesh.normals.emplace_back(float(x), float(y), float(z));
        return {};
    }

    // One index of a corner; false if it is no number that fits. Numbers count from 1, or from the last one back.
    bool read_index(size_t count, uint32_t& index) {
        int64_t value = 0;
        if (!text_.integer(value) || value == 0 || value > int64_t(kNone) - 1 || value < -int64_t(count)) return false;
        index = uint32_t(value > 0 ? value - 1 : int64_t(count) + value);
        return true;
    }

    // v, v/vt, v//vn, v/vt/vn; "1/" and "1//" are taken as "1".
    bool read_corner(Corner& corner) {
        corner = {kNone, kNone, kNone};
        if (!read_index(soup_.positions.size(), corner.position)) return false;
        if (!text_.skip('/') || text_.is_at_word_end()) return true;
        if (!text_.skip('/')) {
            if (!read_index(soup_.mesh.uvs.size(), corner.uv)) return false;
            if (!text_.skip('/')) return true;
        }
        return text_.is_at_word_end() || read_index(soup_.mesh.normals.size(), corner.normal);
    }

    Result<void> read_face() {
        corners_.clear();
        while (!text_.is_at_line_end() && text_.peek() != '#') {
            Corner corner;
            if (!read_corner(corner)) return bad_corner();
            largest_ = {std::max(largest_.position, corner.position), std::max(largest_.uv, corner.uv + 1),
                        std::max(largest_.normal, corner.normal + 1)};
            corners_.push_back(corner);
        }
        if (corners_.size() < 3) return drop_polygon(soup_, file_.path);
        if (surface_ == kNone) use_material("");
        if (largest_.position >= soup_.positions.size()) return missing_vertex();
        return cut_face(corners_, surface_);
    }

    tl::unexpected<Error> bad_corner() {
        const std::string_view word = text_.word();
        return bad_input("{}:{}: corner {} of a face is not v, v/vt, v//vn or v/vt/vn with numbers that exist{}{}", file_.path,
                         text_.line(), corners_.size() + 1, word.empty() ? "" : ", near ", word);
    }

    tl::unexpected<Error> missing_vertex() const {
        return bad_input("{}:{}: vertex {} does not exist, there are {}; was the file cut short?", file_.path, text_.line(),
                         uint64_t(largest_.position) + 1, soup_.positions.size());
    }

    Result<void> cut_face(std::span<const Corner> corners, uint32_t surface) {
        points_.clear();
        for (const Corner& corner : corners) points_.push_back(soup_.positions[corner.position]);
        const std::span<const Corners> triangles = cutter_.cut(points_);
        if (triangles.empty()) return mistake("a polygon is too large and too jagged to be cut; cut it into triangles before");
        const uint32_t first = uint32_t(soup_.report.triangle_count);
        if (auto r = count_triangles(soup_, triangles.size(), file_.path); !r) return r;
        ++soup_.report.polygon_count;
        Mesh& mesh = soup_.mesh;
        for (size_t i = 0; i < triangles.size(); ++i) {
            const Corner &a = corners[triangles[i][0]], &b = corners[triangles[i][1]], &c = corners[triangles[i][2]];
            mesh.faces.push_back({a.position, b.position, c.position});
            mesh.face_uvs.push_back({a.uv, b.uv, c.uv});
            mesh.face_normals.push_back({a.normal, b.normal, c.normal});
            mesh.face_surface.push_back(surface);
            mesh.face_source.push_back(first + uint32_t(i));
        }
        return {};
    }

    void use_material(const std::string& name) {
        const auto [entry, is_new] = surface_of_name_.try_emplace(name, uint32_t(soup_.mesh.surfaces.size()));
        surface_ = entry->second;
        if (!is_new) return;
        soup_.mesh.surfaces.emplace_back().name = name;
    }

    // "mtllib a.mtl b.mtl" are two libraries, "mtllib my chair.mtl" is one.
    void read_library(const std::string& reference) {
        Text words(std::as_bytes(std::span(reference.data(), reference.size())));
        std::vector<std::string> names;
        bool are_libraries = true;
        while (!words.is_at_line_end()) {
            names.emplace_back(words.word());
            are_libraries = are_libraries && names.back().ends_with(".mtl");
        }
        if (!are_libraries) names = {reference};
        for (const std::string& name : names) {
            const std::vector<uint8_t> bytes = read_beside(file_, name, "its materials are drawn white", soup_.report);
            read_mtl(bytes, materials_);
        }
    }

    // The largest index of each kind is in range, so all are.
    Result<void> check_indices() const {
        if (largest_.uv > soup_.mesh.uvs.size())
            return bad_input("{}: a face uses texture coordinate {}, there are {}; was the file cut short?", file_.path,
                             largest_.uv, soup_.mesh.uvs.size());
        if (largest_.normal > soup_.mesh.normals.size())
            return bad_input("{}: a face uses normal {}, there are {}; was the file cut short?", file_.path, largest_.normal,
                             soup_.mesh.normals.size());
        return {};
    }

    // What is known only when all has been read: materials, and colours as bytes.
    void attach() {
        Mesh& mesh = soup_.mesh;
        for (Surface& surface : mesh.surfaces) {
            const auto material = materials_.find(surface.name);
            if (material == materials_.end()) {
                if (!surface.name.empty() && !materials_.empty())
                    soup_.report.notes.push_back(
                        fmt::format("{}: material {} is in no library, it is drawn white", file_.path, surface.name));
                continue;
            }
            surface = material->second;
            set_texture(soup_, surface, material->second.texture, file_);
        }
        if (mesh.uvs.empty()) mesh.face_uvs.clear();
        if (mesh.normals.empty()) mesh.face_normals.clear();
        if (!colours_.empty()) attach_colours();
    }

    void attach_colours() {
        colours_.resize(soup_.positions.size(), {1, 1, 1, -1});
        double largest = 0;
        for (const glm::dvec4& colour : colours_) largest = std::max({largest, colour.r, colour.g, colour.b});
        const double scale = largest > 1 ? 1 / 255.0 : 1;
        for (const glm::dvec4& colour : colours_)
            soup_.mesh.colours.push_back({byte_from_unit(colour.r * scale), byte_from_unit(colour.g * scale),
                                          byte_from_unit(colour.b * scale),
                                          colour.a < 0 ? uint8_t(255) : byte_from_unit(colour.a * scale)});
        soup_.mesh.face_colours = soup_.mesh.faces;
    }

    const InputFile& file_;
    Text text_;
    Soup soup_;
    PolygonCutter cutter_;
    std::vector<Corner> corners_;
    std::vector<glm::dvec3> points_;
    std::vector<glm::dvec4> colours_;  // by position, opacity below 0 where none is said
    Corner largest_{0, 0, 0};          // position: the largest index; the others: one above it
    uint32_t surface_ = kNone;
    std::unordered_map<std::string, uint32_t> surface_of_name_;
    MaterialLibrary materials_;
};

}  // namespace

Result<Soup> read_obj(const InputFile& file) {
    return ObjReader(file).read();
}

}  // namespace overlook::mesh
