// From triangles as a file has them to a mesh.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/soup.h"
#include "tools/bake/mesh/unique.h"
#include "tools/bake/mesh_repair.h"

namespace overlook::mesh {
namespace {

struct Box {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};

    glm::dvec3 middle() const { return low + (high - low) / 2.0; }
    double size() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
    double reach() const {
        const glm::dvec3 a = glm::max(-low, high);
        return std::max({a.x, a.y, a.z});
    }
};

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void drop_what_is_nowhere(Soup& soup) {
    std::vector<uint8_t> keep(soup.mesh.faces.size(), 1);
    bool has_dropped = false;
    for (size_t f = 0; f < keep.size(); ++f) {
        const Corners& c = soup.mesh.faces[f];
        if (is_finite(soup.positions[c[0]]) && is_finite(soup.positions[c[1]]) && is_finite(soup.positions[c[2]])) continue;
        keep[f] = 0;
        has_dropped = true;
        soup.report.dropped.push_back({soup.mesh.face_source[f], DropReason::not_finite, kNone});
    }
    if (has_dropped) keep_faces(soup.mesh, keep);
}

// "12 not_finite, 3 no_area"
std::string reasons_of(const MeshReport& report) {
    std::string text;
    for (size_t i = 0; i < kDropReasonCount; ++i) {
        const uint64_t count = report.dropped_count(DropReason(i));
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(DropReason(i)));
    }
    return text;
}

Result<void> check_has_faces(const Mesh& mesh, const MeshReport& report, const std::string& path) {
    if (!mesh.faces.empty()) return {};
    if (report.triangle_count > 0)
        return bad_input("{}: none of its {} faces can be drawn: {}", path, report.triangle_count, reasons_of(report));
    return bad_input("{}: has no faces{}", path, report.other_primitive_count > 0 ? ", only points or lines" : "");
}

Box box_of(const Soup& soup, double scale) {
    Box box;
    for (const Corners& face : soup.mesh.faces)
        for (const uint32_t p : face) {
            box.low = glm::min(box.low, soup.positions[p] * scale);
            box.high = glm::max(box.high, soup.positions[p] * scale);
        }
    return box;
}

// A mesh far from zero gets its middle as origin, on a grid of a power of two so that floats stay the floats that they were.
glm::dvec3 origin_of(const Box& box) {
    constexpr double kFar = 4;  // sizes of the mesh; nearer, an origin would win two bits at most
    const double size = std::max(box.size(), 1e-30);
    if (box.reach() <= kFar * size) return glm::dvec3(0);
    const double step = std::exp2(std::ceil(std::log2(size)));
    return glm::round(box.middle() / step) * step;
}

// Positions as floats from the origin, each once, in the order in which they stand in the file.
void place(Soup& soup, double scale, const Box& box) {
    Mesh& mesh = soup.mesh;
    mesh.origin_m = origin_of(box);
    std::vector<uint32_t> number(soup.positions.size(), kNone);
    for (const Corners& face : mesh.faces)
        for (const uint32_t p : face) number[p] = 0;
    const size_t used_count = number.size() - size_t(std::count(number.begin(), number.end(), kNone));

    UniqueValues<glm::vec3> unique(used_count);
    double worst = 0;
    for (size_t p = 0; p < number.size(); ++p) {
        if (number[p] == kNone) continue;
        const glm::dvec3 exact = soup.positions[p] * scale - mesh.origin_m;
        const glm::vec3 stored = glm::vec3(exact) + glm::vec3(0);  // no -0
        const glm::dvec3 off = glm::dvec3(stored) - exact;
        worst = std::max(worst, off.x * off.x + off.y * off.y + off.z * off.z);
        number[p] = unique.number_of(stored);
    }
    mesh.positions_m = unique.take();
    for (Corners& face : mesh.faces)
        for (uint32_t& p : face) p = number[p];
    soup.report.file_position_count = number.size();
    soup.report.unused_position_count = number.size() - used_count;
    soup.report.welded_position_count = used_count - mesh.positions_m.size();
    soup.report.rounding_m = std::sqrt(worst);
}

// Makes a pool hold each value once and only those that corners use. `clean` rights a value, or says that it is none.
template <class T, class Clean>
uint64_t make_unique(std::vector<T>& pool, std::vector<Corners>& corners, const Clean& clean) {
    constexpr uint32_t kUnseen = kNone - 1;
    std::vector<uint32_t> number(pool.size(), kUnseen);
    UniqueValues<T> unique(pool.size());
    uint64_t bad_count = 0;
    for (Corners& face : corners)
        for (uint32_t& i : face) {
            if (i == kNone) continue;
            if (number[i] == kUnseen) {
                const bool is_good = clean(pool[i]);
                number[i] = is_good ? unique.number_of(pool[i]) : kNone;
                bad_count += !is_good;
            }
            i = number[i];
        }
    pool = unique.take();
    if (pool.empty()) corners.clear();
    return bad_count;
}

bool clean_normal(glm::vec3& normal) {
    const double x = normal.x, y = normal.y, z = normal.z, length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !std::isfinite(length)) return false;
    normal = glm::vec3(float(x / length), float(y / length), float(z / length)) + glm::vec3(0);
    return true;
}

bool clean_uv(glm::vec2& uv) {
    uv = uv + glm::vec2(0);
    return std::isfinite(uv.x) && std::isfinite(uv.y);
}

void clean_attributes(Mesh& mesh, MeshReport& report) {
    report.bad_normal_count = make_unique(mesh.normals, mesh.face_normals, clean_normal);
    report.bad_uv_count = make_unique(mesh.uvs, mesh.face_uvs, clean_uv) + make_unique(mesh.uvs2, mesh.face_uvs2, clean_uv);
    (void)make_unique(mesh.colours, mesh.face_colours, [](const auto&) { return true; });
}

// What baked files can hold: no control characters, and so many bytes at most, cut between characters.
void make_storable(std::string& name) {
    constexpr size_t kMostBytes = 4096;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return uint8_t(c) < ' ' || uint8_t(c) == 127; }, ' ');
    if (name.size() <= kMostBytes) return;
    size_t end = kMostBytes;
    while (end > 0 && (uint8_t(name[end]) & 0xc0) == 0x80) --end;
    name.resize(end);
}

}  // namespace

Result<MeshFile> finish(Soup soup, const InputFile& file) {
    drop_what_is_nowhere(soup);
    if (auto r = check_has_faces(soup.mesh, soup.report, file.path); !r) return tl::unexpected(r.error());
    const Box box = box_of(soup, file.options.metres_per_unit);
    if (!(box.size() <= kMostExtent_m))
        return bad_input("{}: reaches {:.3g} m from its middle, at most {:g} m are read; give the unit that it is in", file.path,
                         box.high.x / 2 - box.low.x / 2 + box.high.y / 2 - box.low.y / 2 + box.high.z / 2 - box.low.z / 2,
                         kMostExtent_m);
    place(soup, file.options.metres_per_unit, box);
    clean_attributes(soup.mesh, soup.report);
    repair(soup.mesh, soup.report);
    if (auto r = check_has_faces(soup.mesh, soup.report, file.path); !r) return tl::unexpected(r.error());
    scale(soup.motion, file.options.metres_per_unit);
    for (Surface& surface : soup.mesh.surfaces) make_storable(surface.name), make_storable(surface.texture);
    for (Motion::Part& part : soup.motion.parts) make_storable(part.name);
    return MeshFile{std::move(soup.mesh), std::move(soup.report), std::move(soup.motion)};
}

}  // namespace overlook::mesh
