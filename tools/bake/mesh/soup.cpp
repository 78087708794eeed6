// What the readers share.

#include "tools/bake/mesh/soup.h"

#include <algorithm>
#include <cmath>

#include "formats/mapped_file.h"
#include "formats/numbers.h"

namespace overlook::mesh {

Result<void> count_triangles(Soup& soup, uint64_t more, const std::string& path) {
    soup.report.triangle_count += more;
    if (soup.report.triangle_count > kMostTriangles)
        return impossible("{}: has more than {} triangles; cut it into parts", path, with_commas(kMostTriangles));
    return {};
}

Result<void> drop_polygon(Soup& soup, const std::string& path) {
    const uint32_t source = uint32_t(soup.report.triangle_count);
    if (auto r = count_triangles(soup, 1, path); !r) return r;
    ++soup.report.polygon_count;
    soup.report.dropped.push_back({source, DropReason::too_few_corners, kNone});
    return {};
}

std::string bare_name(std::string_view reference) {
    const size_t slash = reference.find_last_of("/\\");
    return std::string(slash == std::string_view::npos ? reference : reference.substr(slash + 1));
}

std::vector<uint8_t> read_beside(const InputFile& file, const std::string& reference, const std::string& loss,
                                 MeshReport& report) {
    const std::string name = bare_name(reference);
    if (!name.empty() && name != "." && name != ".." && name.find('\0') == std::string::npos) {
        if (const Result<MappedFile> mapped = MappedFile::open(file.folder + name)) {
            const auto* begin = reinterpret_cast<const uint8_t*>(mapped->bytes().data());
            return {begin, begin + mapped->bytes().size()};
        }
    }
    report.notes.push_back(fmt::format("{}: {} cannot be read from its folder; {}", file.path, name, loss));
    return {};
}

void set_texture(Soup& soup, Surface& surface, const std::string& reference, const InputFile& file) {
    surface.texture = bare_name(reference);
    if (surface.texture.empty() || !file.options.reads_textures || !soup.textures.insert(surface.texture).second) return;
    surface.texture_bytes = read_beside(file, surface.texture, "what it covers is drawn in its plain colour", soup.report);
}

uint8_t byte_from_unit(double value) {
    return value > 0 ? uint8_t(std::lround(std::min(value, 1.0) * 255)) : uint8_t(0);
}

}  // namespace overlook::mesh
