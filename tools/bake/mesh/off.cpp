// OFF files. Source: "Geomview Manual 1.9.4", section "OFF Files", The Geometry Center, 1998-2008.

#include <array>
#include <limits>

#include "tools/bake/mesh/polygons.h"
#include "tools/bake/mesh/text.h"

namespace overlook::mesh {
namespace {

class OffReader {
  public:
    explicit OffReader(const InputFile& file) : file_(file), text_(file.bytes) {}

    Result<Soup> read() {
        soup_.report.form = "OFF";
        soup_.mesh.surfaces.resize(1);
        if (auto r = read_header(); !r) return tl::unexpected(r.error());
        for (uint64_t i = 0; i < vertex_count_; ++i)
            if (auto r = read_vertex(); !r) return tl::unexpected(r.error());
        for (uint64_t i = 0; i < face_count_; ++i)
            if (auto r = read_face(); !r) return tl::unexpected(r.error());
        if (auto r = add_polygons(polygons_, file_.path, soup_); !r) return tl::unexpected(r.error());
        attach();
        return std::move(soup_);
    }

  private:
    tl::unexpected<Error> mistake(const char* what) const { return bad_input("{}:{}: {}", file_.path, text_.line(), what); }

    // "[ST][C][N]OFF", then the counts on this line or the next.
    Result<void> read_header() {
        if (!text_.find_line('#')) return bad_input("{}: holds no line", file_.path);
        std::string_view key = text_.word();
        if (!key.ends_with("OFF")) return mistake("does not begin with OFF");
        key.remove_suffix(3);
        const auto takes = [&](std::string_view flag) {
            const bool is_there = key.starts_with(flag);
            if (is_there) key.remove_prefix(flag.size());
            return is_there;
        };
        has_uv_ = takes("ST");
        has_colour_ = takes("C");
        has_normal_ = takes("N");
        if (!key.empty()) return mistake("OFF of four or of n dimensions is not read");
        if (text_.peek() != '\0' && !text_.is_at_line_end() && text_.peek() == 'B')
            return mistake("binary OFF is not read; write it as ascii OFF, or as PLY");
        int64_t vertices = 0, faces = 0;
        if (!text_.find_line('#') || !text_.integer(vertices) || !text_.integer(faces) || vertices < 0 || faces < 0)
            return mistake("the number of vertices and of faces are missing");
        text_.next_line();
        // A row is two bytes at least: a digit and its end.
        if (uint64_t(vertices) > text_.bytes_left() || uint64_t(faces) > text_.bytes_left())
            return bad_input("{}: {} vertices and {} faces do not fit into the {} bytes that follow; was it cut short?",
                             file_.path, vertices, faces, text_.bytes_left());
        vertex_count_ = uint64_t(vertices);
        face_count_ = uint64_t(faces);
        return {};
    }

    // Reads what is left of a line as numbers; whether all of them are.
    bool read_rest() {
        rest_.clear();
        has_point_ = false;
        while (!text_.is_at_line_end() && text_.peek() != '#') {
            double value = 0;
            const std::string_view word = text_.word();
            if (!number_from(word, value)) return false;
            has_point_ = has_point_ || word.find_first_of(".eE") != std::string_view::npos;
            rest_.push_back(value);
        }
        text_.next_line();
        return true;
    }

    // Colours are whole numbers of 0..255 or floats of 0..1.
    std::array<uint8_t, 4> colour(size_t begin, size_t count) const {
        const double scale = has_point_ ? 1 : 1 / 255.0;
        std::array<uint8_t, 4> colour{0, 0, 0, 255};
        for (size_t i = 0; i < count; ++i) colour[i] = byte_from_unit(rest_[begin + i] * scale);
        return colour;
    }

    Result<void> read_vertex() {
        if (!text_.find_line('#')) return missing("vertices", soup_.positions.size(), vertex_count_);
        glm::dvec3 p, n;
        if (!text_.number(p.x) || !text_.number(p.y) || !text_.number(p.z)) return mistake("a vertex is three numbers");
        if (has_normal_ && (!text_.number(n.x) || !text_.number(n.y) || !text_.number(n.z)))
            return mistake("a vertex of NOFF has a normal, three numbers");
        const uint64_t line = text_.line();
        if (!read_rest()) return bad_input("{}:{}: a vertex holds something that is no number", file_.path, line);
        const size_t uv_count = has_uv_ ? 2 : 0;
        if (rest_.size() < uv_count) return bad_input("{}:{}: a vertex has no texture coordinate", file_.path, line);
        const size_t colour_count = rest_.size() - uv_count;
        const bool has_colour = colour_count == 3 || colour_count == 4;
        if (has_colour_ && !has_colour) return bad_input("{}:{}: a vertex of COFF has a colour of 3 or 4", file_.path, line);
        if (!has_colour_ && colour_count != 0 && !has_colour)
            return bad_input("{}:{}: a vertex has {} numbers too many", file_.path, line, colour_count);

        soup_.positions.push_back(p);
        if (has_normal_) soup_.mesh.normals.emplace_back(glm::vec3(n));
        if (has_uv_) uvs_.emplace_back(float(rest_[colour_count]), float(1 - rest_[colour_count + 1]));
        if (has_colour) {
            vertex_colours_.resize(soup_.positions.size() - 1, {255, 255, 255, 255});
            vertex_colours_.push_back(colour(0, colour_count));
        }
        return {};
    }

    tl::unexpected<Error> missing(const char* what, uint64_t found, uint64_t wanted) const {
        return bad_input("{}: ends after {} of {} {}; was it cut short?", file_.path, found, wanted, what);
    }

    // "n i1 ... in", then nothing, a number of a colour map (which stands in no file: left), or a colour.
    Result<void> read_face() {
        if (!text_.find_line('#')) return missing("faces", polygons_.size(), face_count_);
        int64_t count = 0;
        if (!text_.integer(count) || count < 0 || uint64_t(count) > text_.bytes_left())
            return mistake("a face is a count and as many numbers of vertices");
        for (int64_t i = 0; i < count; ++i) {
            int64_t index = 0;
            if (!text_.integer(index)) return mistake("a face is a count and as many numbers of vertices");
            if (index < 0 || uint64_t(index) >= vertex_count_)
                return bad_input("{}:{}: vertex {} does not exist, there are {}", file_.path, text_.line(), index, vertex_count_);
            polygons_.positions.push_back(uint32_t(index));
        }
        polygons_.end_polygon();
        const uint64_t line = text_.line();
        if (!read_rest()) return bad_input("{}:{}: a face holds something that is no number", file_.path, line);
        if (rest_.size() == 2 || rest_.size() > 4)
            return bad_input("{}:{}: a face has {} numbers after its vertices, a colour has 3 or 4", file_.path, line,
                             rest_.size());
        const bool has_colour = rest_.size() >= 3;
        has_face_colour_ = has_face_colour_ || has_colour;
        polygons_.colours.push_back(has_colour ? uint32_t(face_colours_.size()) : kNone);
        if (has_colour) face_colours_.push_back(colour(0, rest_.size()));
        return {};
    }

    // What is by vertex counts before what is by face.
    void attach() {
        Mesh& mesh = soup_.mesh;
        if (has_normal_) mesh.face_normals = mesh.faces;
        if (has_uv_) {
            mesh.uvs = std::move(uvs_);
            mesh.face_uvs = mesh.faces;
        }
        if (!vertex_colours_.empty()) {
            vertex_colours_.resize(soup_.positions.size(), {255, 255, 255, 255});
            mesh.colours = std::move(vertex_colours_);
            mesh.face_colours = mesh.faces;
        } else if (has_face_colour_) {
            mesh.colours = std::move(face_colours_);
        } else {
            mesh.face_colours.clear();
        }
    }

    const InputFile& file_;
    Text text_;
    Soup soup_;
    Polygons polygons_;
    uint64_t vertex_count_ = 0, face_count_ = 0;
    bool has_uv_ = false, has_colour_ = false, has_normal_ = false, has_face_colour_ = false;
    std::vector<double> rest_;
    bool has_point_ = false;  // whether rest_ was written with a decimal point
    std::vector<glm::vec2> uvs_;
    std::vector<std::array<uint8_t, 4>> vertex_colours_, face_colours_;
};

}  // namespace

Result<Soup> read_off(const InputFile& file) {
    return OffReader(file).read();
}

}  // namespace overlook::mesh
