#include "tools/baked/mesh_file.h"

#include <algorithm>
#include <cstring>

#include "formats/atomic_file.h"

namespace overlook {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The texture's colour at a sample, nearest pixel.
void append_colour(const terrain::Terrain& terrain, uint32_t column, uint32_t row, std::vector<uint8_t>& colours) {
    const ImageRgb8& texture = terrain.texture;
    auto pixel = [](uint32_t at, uint32_t samples, uint32_t pixels) {
        return (uint64_t(at) * (pixels - 1) + (samples - 1) / 2) / (samples - 1);
    };
    uint64_t x = pixel(column, terrain.shape.width, texture.width), y = pixel(row, terrain.shape.height, texture.height);
    const uint8_t* rgb = texture.pixels.data() + (y * texture.width + x) * 3;
    colours.insert(colours.end(), rgb, rgb + 3);
}

MeshData mesh_of(MeshSpace space, const terrain::Terrain& terrain, std::span<const uint32_t> indices) {
    MeshData mesh;
    constexpr uint32_t kUnused = ~0u;
    std::vector<uint32_t> number(terrain.heights.size(), kUnused);
    for (uint32_t index : indices) number[index] = 0;
    uint32_t next = 0, width = terrain.shape.width;
    bool is_coloured = space == MeshSpace::local && !terrain.texture.pixels.empty();
    for (size_t i = 0; i < number.size(); ++i) {
        if (number[i] == kUnused) continue;
        number[i] = next++;
        uint32_t column = uint32_t(i % width), row = uint32_t(i / width);
        double x = column, y = row;
        if (space == MeshSpace::local) x *= terrain.frame.metres_per_column, y *= -terrain.frame.metres_per_row;
        mesh.positions.insert(mesh.positions.end(), {x, y, terrain.height_m(column, row)});
        if (is_coloured) append_colour(terrain, column, row, mesh.colours);
    }
    mesh.indices.reserve(indices.size());
    for (size_t i = 0; i < indices.size(); i += 3) {
        uint32_t a = number[indices[i]], b = number[indices[i + 1]], c = number[indices[i + 2]];
        if (space == MeshSpace::raster) std::swap(b, c);  // rows run downwards: the other way round is upwards there
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
    return mesh;
}

template <class T>
void append_number(std::string& out, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

}  // namespace

Result<void> write_ply(const std::string& path, const MeshData& mesh, MeshReport& report) {
    bool floats_are_exact =
        std::all_of(mesh.positions.begin(), mesh.positions.end(), [](double p) { return double(float(p)) == p; });
    bool is_coloured = !mesh.colours.empty();
    const char* type = floats_are_exact ? "float" : "double";
    size_t vertex_count = mesh.positions.size() / 3;
    std::string out =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n",
                    vertex_count, type, type, type);
    if (is_coloured) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.indices.size() / 3);
    for (size_t v = 0; v < vertex_count; ++v) {
        for (size_t k = 0; k < 3; ++k)
            floats_are_exact ? append_number(out, float(mesh.positions[3 * v + k]))
                             : append_number(out, mesh.positions[3 * v + k]);
        if (is_coloured) out.append(reinterpret_cast<const char*>(mesh.colours.data() + 3 * v), 3);
    }
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        append_number(out, uint8_t(3));
        for (size_t k = 0; k < 3; ++k) append_number(out, int32_t(mesh.indices[i + k]));
    }
    report.file_bytes = out.size();
    return write_file(path, std::string_view(out));
}

Result<MeshReport> write_triangles(const std::string& path, const MeshData& mesh) {
    bool is_ply = ends_with(path, ".ply"), is_glb = ends_with(path, ".glb");
    if (!is_ply && !is_glb) return bad_command("{}: a mesh is written as .ply or .glb; another ending was given", path);
    MeshReport report;
    report.vertex_count = mesh.positions.size() / 3, report.triangle_count = mesh.indices.size() / 3;
    Result<void> written = is_ply ? write_ply(path, mesh, report) : write_glb(path, mesh, report);
    if (!written) return tl::unexpected(written.error());
    return report;
}

Result<MeshReport> write_mesh(const std::string& path, MeshSpace space, const terrain::Terrain& terrain,
                              std::span<const uint32_t> indices) {
    if (ends_with(path, ".glb") && space == MeshSpace::raster)
        return bad_command("{}: raster space is for .ply; glTF is in metres", path);
    return write_triangles(path, mesh_of(space, terrain, indices));
}

}  // namespace overlook
