// STL files. Source: 3D Systems, "StereoLithography Interface Specification", 1988. Facet normals are not read: they say nothing
// that the corners do not, and many writers leave them zero.

#include <algorithm>
#include <bit>

#include "formats/little_endian.h"
#include "tools/bake/mesh/soup.h"
#include "tools/bake/mesh/text.h"

namespace overlook::mesh {
namespace {

constexpr size_t kHeaderBytes = 84, kFacetBytes = 50, kCountAt = 80;

Result<void> add_facet(Soup& soup, const std::string& path) {
    const uint32_t last = uint32_t(soup.positions.size());
    soup.mesh.faces.push_back({last - 3, last - 2, last - 1});
    soup.mesh.face_source.push_back(uint32_t(soup.report.triangle_count));
    soup.mesh.face_surface.push_back(0);
    ++soup.report.polygon_count;
    return count_triangles(soup, 1, path);
}

Result<Soup> read_binary(const InputFile& file, uint32_t count) {
    Soup soup;
    soup.report.form = "STL binary";
    soup.mesh.surfaces.resize(1);
    const uint64_t needed = kHeaderBytes + uint64_t(kFacetBytes) * count;
    if (needed > file.bytes.size())
        return bad_input("{}: has {} facets, which are {} bytes, but {} bytes long; was it cut short?", file.path, count, needed,
                         file.bytes.size());
    soup.positions.reserve(size_t(3) * count);
    for (uint32_t i = 0; i < count; ++i) {
        const size_t facet = kHeaderBytes + kFacetBytes * size_t(i) + 12;
        for (size_t corner = 0; corner < 3; ++corner) {
            const auto axis = [&](size_t k) {
                return double(std::bit_cast<float>(load_le<uint32_t>(file.bytes, facet + 12 * corner + 4 * k)));
            };
            soup.positions.emplace_back(axis(0), axis(1), axis(2));
        }
        if (auto r = add_facet(soup, file.path); !r) return tl::unexpected(r.error());
    }
    return soup;
}

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return lower;
}

// "facet normal 0 0 1 / outer loop / vertex x y z (three or more times) / endloop / endfacet", in any number of solids.
class AsciiReader {
  public:
    explicit AsciiReader(const InputFile& file) : file_(file), text_(file.bytes) {}

    Result<Soup> read() {
        soup_.report.form = "STL ascii";
        soup_.mesh.surfaces.resize(1);
        for (; text_.find_line('\0'); text_.next_line()) {
            if (auto r = read_line(lower_case(text_.word())); !r) return tl::unexpected(r.error());
        }
        if (has_loop_) return mistake("ends within a facet; was the file cut short?");
        if (in_solid_) return mistake("ends without endsolid; was the file cut short?");
        return std::move(soup_);
    }

  private:
    tl::unexpected<Error> mistake(const char* what) const { return bad_input("{}:{}: {}", file_.path, text_.line(), what); }

    Result<void> read_line(std::string_view key) {
        if (key == "vertex") return read_vertex();
        if (key == "outer") {
            if (has_loop_) return mistake("a loop begins within a loop");
            has_loop_ = true;
            corners_ = 0;
        } else if (key == "endloop") {
            if (!has_loop_ || corners_ != 3) return mistake("a facet has three vertices");
            has_loop_ = false;
            return add_facet(soup_, file_.path);
        } else if (key == "solid" || key == "endsolid") {
            in_solid_ = key == "solid";
        } else if (key != "facet" && key != "endfacet") {
            return mistake("is no line of an STL file");
        }
        return {};
    }

    Result<void> read_vertex() {
        double x = 0, y = 0, z = 0;
        if (!text_.number(x) || !text_.number(y) || !text_.number(z)) return mistake("a vertex is three numbers");
        if (!has_loop_ || corners_ == 3) return mistake("a facet has three vertices");
        ++corners_;
        // As in a binary file; so the two of one mesh weld alike.
        soup_.positions.emplace_back(float(x), float(y), float(z));
        return {};
    }

    const InputFile& file_;
    Text text_;
    Soup soup_;
    bool in_solid_ = false, has_loop_ = false;
    int corners_ = 0;
};

}  // namespace

// Binary files may begin with "solid" too; their length tells.
Result<Soup> read_stl(const InputFile& file) {
    const size_t size = file.bytes.size();
    const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), size);
    const size_t begin = std::min(text.find_first_not_of(" \t\r\n"), size);
    const bool is_named_solid = lower_case(text.substr(begin, 5)) == "solid";
    const uint32_t count = size >= kHeaderBytes ? load_le<uint32_t>(file.bytes, kCountAt) : 0;
    const bool has_binary_length = size >= kHeaderBytes && size == kHeaderBytes + uint64_t(kFacetBytes) * count;
    if (has_binary_length) return read_binary(file, count);
    const bool looks_like_text = is_named_solid && text.find('\0') == std::string_view::npos;
    if (looks_like_text) return AsciiReader(file).read();
    if (size < kHeaderBytes)
        return bad_input("{}: neither begins with solid nor has the 84 bytes of a binary STL's header; was it cut short?",
                         file.path);
    return read_binary(file, count);
}

}  // namespace overlook::mesh
