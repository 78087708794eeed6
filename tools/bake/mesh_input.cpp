// Which form a file is, and who reads it.

#include "tools/bake/mesh_input.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "formats/mapped_file.h"
#include "tools/bake/mesh/soup.h"

namespace overlook::mesh {
namespace {

using Reader = Result<Soup> (*)(const InputFile&);

std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

// PLY, glTF and OFF say at their beginning what they are. OBJ and STL do not: there the ending counts.
Reader reader_of(const InputFile& file) {
    const std::string_view text = text_of(file.bytes);
    const std::string ending = ending_of(file.path);
    if (text.starts_with("glTF") || ending == ".gltf" || ending == ".glb") return read_gltf;
    if (text.starts_with("ply\n") || text.starts_with("ply\r") || ending == ".ply") return read_ply;
    if (ending == ".obj") return read_obj;
    if (ending == ".stl") return read_stl;
    const std::string_view first_line = text.substr(0, text.find_first_of("\r\n"));
    if (ending == ".off" || first_line.substr(0, 8).find("OFF") != std::string_view::npos) return read_off;
    return nullptr;
}

// From y up to z up, a quarter turn about x: nothing is rounded.
void stand_up(Soup& soup) {
    for (glm::dvec3& p : soup.positions) p = {p.x, -p.z, p.y};
    for (glm::vec3& n : soup.mesh.normals) n = {n.x, -n.z, n.y};
    stand_up(soup.motion);
}

Result<MeshFile> read(const InputFile& file) {
    if (file.bytes.empty()) return bad_input("{}: is empty", file.path);
    const Reader reader = reader_of(file);
    if (!reader) return bad_input("{}: is no mesh of a known form; read are .obj, .ply, .off, .stl, .gltf and .glb", file.path);
    Result<Soup> soup = reader(file);
    if (!soup) return tl::unexpected(soup.error());
    Up up = file.options.up != Up::automatic ? file.options.up : reader == read_gltf ? Up::y : Up::z;
    if (up == Up::y) stand_up(*soup);
    return finish(std::move(*soup), file);
}

}  // namespace

Result<MeshFile> open_mesh(const std::string& path, const Options& options) {
    if (!(options.metres_per_unit > 0) || !std::isfinite(options.metres_per_unit))
        return bad_command("{}: a unit of {} m is none; give a length above 0", path, options.metres_per_unit);
    Result<MappedFile> mapped = MappedFile::open(path);
    if (!mapped) return tl::unexpected(mapped.error());
    const size_t slash = path.find_last_of('/');
    const InputFile file{mapped->bytes(), path, slash == std::string::npos ? "" : path.substr(0, slash + 1), options};
    try {
        Result<MeshFile> mesh = read(file);
        if (!mesh) return mesh;
        mesh->report.source_name = bare_name(path);
        mesh->report.source_hash = content_hash(file.bytes);
        return mesh;
    } catch (const std::bad_alloc&) {
        return impossible("{}: does not fit into memory; cut it into parts", path);
    } catch (const std::length_error&) {
        return impossible("{}: does not fit into memory; cut it into parts", path);
    }
}

}  // namespace overlook::mesh
