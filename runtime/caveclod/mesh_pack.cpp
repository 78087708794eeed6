// Packing a hierarchy for refinement: bounds, records, and which splits can glide.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "formats/caveclod_codes.h"
#include "formats/caveclod_octahedral.h"
#include "formats/caveclod_state.h"
#include "runtime/caveclod/mesh.h"
#include "runtime/caveclod/mesh_record.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kRadiusSteps = 64, kRadiusCodes = 80 * kRadiusSteps;  // 2^-40 .. 2^40 m

std::vector<float> radius_table() {
    std::vector<float> table(1, 0.0f);
    for (uint32_t code = 1; code < kRadiusCodes; ++code) {
        double mantissa = std::exp2(double((code - 1) % kRadiusSteps) / kRadiusSteps);
        table.push_back(float(std::ldexp(mantissa, int((code - 1) / kRadiusSteps) - 40)));
    }
    table.push_back(std::numeric_limits<float>::infinity());
    return table;
}

std::vector<float> error_table() {
    std::vector<float> table;
    for (uint32_t code = 0; code <= kErrorCodeMax; ++code) table.push_back(error_of_code(code));
    return table;
}

void put(std::vector<uint8_t>& bytes, uint32_t value) {
    for (; value >= 128; value >>= 7) bytes.push_back(uint8_t(value | 128));
    bytes.push_back(uint8_t(value));
}

double cross_2d(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

// A hierarchy into a Mesh, split by split.
class MeshPacker {
  public:
    explicit MeshPacker(const Hierarchy& hierarchy) : h_(hierarchy) {}

    // whole: of which the hierarchy is a part.
    Result<Mesh> run(const std::optional<WholeMesh>& whole) {
        if (Result<void> fits = choose_handles(whole ? whole->face_count : most_faces()); !fits)
            return tl::unexpected(fits.error());
        mesh_.split_limit_ = h_.split_count();
        mesh_.glide_begin_ = whole ? whole->vertex_count : uint32_t(h_.vertices.size());
        mesh_.missing_error_m_ = whole ? whole->missing_error_m : 0;
        mesh_.base_position_count_ = h_.base_position_count;
        mesh_.face_count_ = uint32_t(h_.face_positions.size());
        mesh_.finest_error_m_ = h_.finest_error_m;
        mesh_.origin_m_ = h_.origin_m, mesh_.grid_ = h_.grid, mesh_.position_step_m_ = h_.grid.position_step_m;
        mesh_.attributes_ = h_.attributes, mesh_.surfaces_ = h_.surfaces;
        mesh_.error_by_code_ = error_table(), mesh_.radius_by_code_ = radius_table();
        pack_rows();
        pack_vertices();
        pack_bounds();
        gather_dependents();
        state_.add_positions(h_.positions_m.size());
        for (uint32_t face = 0; face < h_.base_face_count; ++face) pack_base(face);
        for (uint32_t i = 0; i < h_.split_count(); ++i) {
            pack_record(i);
            apply(i);
        }
        if (mesh_.records_.size() > std::numeric_limits<uint32_t>::max())
            return impossible("a mesh of {} splits needs more than 4 GiB of records", h_.split_count());
        mesh_.records_.shrink_to_fit();
        return std::move(mesh_);
    }

  private:
    // Of one surface.
    uint32_t most_faces() const {
        std::vector<uint32_t> counts(h_.surfaces.size(), 0);
        for (uint32_t group : h_.face_group) ++counts[h_.group_surface[group]];
        return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
    }

    Result<void> choose_handles(uint32_t most) {
        size_t surfaces = h_.surfaces.size();
        uint32_t surface_bits = uint32_t(std::bit_width(surfaces)), slot_bits = uint32_t(std::bit_width(most));
        if (surface_bits + slot_bits > 32)
            return impossible("a mesh of {} surfaces and {} faces of one has too many for one camera's handles", surfaces, most);
        mesh_.slot_bits_ = 32 - surface_bits;
        return {};
    }

    void pack_rows() {
        bool is_wide = false;
        for (uint32_t p = 0; p < h_.positions_m.size(); ++p) {
            if (p % Mesh::kRowBlock == 0) mesh_.vertex_blocks_.push_back(h_.vertex_begin[p]);
            is_wide = is_wide || h_.vertex_begin[p] - mesh_.vertex_blocks_.back() > 65535;
        }
        for (uint32_t p = 0; p < h_.positions_m.size(); ++p) {
            uint32_t row = h_.vertex_begin[p] - mesh_.vertex_blocks_[p / Mesh::kRowBlock];
            if (is_wide)
                mesh_.wide_rows_.push_back(row);
            else
                mesh_.vertex_rows_.push_back(uint16_t(row));
        }
    }

    void pack_vertices() {
        uint32_t low_bits = h_.grid.position_bits > 16 ? h_.grid.position_bits - 16 : 0;
        glm::vec3 lowest(std::numeric_limits<float>::max()), highest(-lowest);
        for (const glm::vec3& at : h_.positions_m) lowest = glm::min(lowest, at), highest = glm::max(highest, at);
        mesh_.lowest_m_ = h_.origin_m + glm::dvec3(lowest), mesh_.highest_m_ = h_.origin_m + glm::dvec3(highest);
        for (uint32_t p = 0; p < h_.positions_m.size(); ++p) {
            GridPosition at = steps_of_position(h_.grid, h_.positions_m[p]);
            for (uint32_t v = h_.vertex_begin[p]; v < h_.vertex_begin[p + 1]; ++v) {
                PackedVertex packed;
                Steps steps = steps_of_vertex(h_.grid, h_.vertices[v]);
                for (uint32_t axis = 0; axis < 3; ++axis) {
                    uint32_t whole = uint32_t(at.at[axis]), low = whole & ((1u << low_bits) - 1);
                    packed.position[axis] = uint16_t(whole >> low_bits);
                    packed.position_low = uint16_t(packed.position_low | low << (4 * axis));
                }
                for (size_t k = 0; k < 2; ++k) packed.normal[k] = int16_t(steps.normal[k]), packed.uv[k] = uint16_t(steps.uv[k]);
                mesh_.vertices_.push_back(packed);
                if (h_.attributes.colours) mesh_.colours_.push_back(h_.vertices[v].colour);
            }
        }
    }

    void pack_bounds() {
        const std::vector<float>& radii = mesh_.radius_by_code_;
        for (uint32_t i = 0; i < h_.split_count(); ++i) {
            GridPosition at = steps_of_position(h_.grid, h_.positions_m[h_.owner[i]]);
            Bounds bounds;
            bounds.middle = uint64_t(at.at[0]) | uint64_t(at.at[1]) << 21 | uint64_t(at.at[2]) << 42;
            bounds.error = uint16_t(code_of_error(h_.error_m[i]));
            bounds.radius = uint16_t(std::lower_bound(radii.begin(), radii.end() - 1, h_.radius_m[i]) - radii.begin());
            bounds.cone = h_.cone[i];
            mesh_.bounds_.push_back(bounds);
        }
    }

    void gather_dependents() {
        dependent_begin_.assign(h_.split_count() + 1, 0);
        for (uint32_t need : h_.needs) ++dependent_begin_[need + 1];
        for (uint32_t i = 0; i < h_.split_count(); ++i) dependent_begin_[i + 1] += dependent_begin_[i];
        dependents_.resize(h_.needs.size());
        std::vector<uint32_t> at(dependent_begin_.begin(), dependent_begin_.end() - 1);
        for (uint32_t i = 0; i < h_.split_count(); ++i)
            for (uint32_t k = h_.need_begin[i]; k < h_.need_begin[i + 1]; ++k) dependents_[at[h_.needs[k]]++] = i;
    }

    void pack_base(uint32_t face) {
        std::array<uint32_t, 3> vertices{};
        for (size_t c = 0; c < 3; ++c)
            vertices[c] = h_.vertex_begin[h_.face_positions[face][c]] + h_.birth_wedge[3 * size_t(face) + c];
        mesh_.base_faces_.push_back(vertices);
        mesh_.base_surfaces_.push_back(uint16_t(h_.group_surface[h_.face_group[face]]));
        add_face(face, MeshState::kNone);
    }
    void add_face(uint32_t face, uint32_t split) {
        const uint16_t* wedge = h_.birth_wedge.data() + 3 * size_t(face);
        state_.add_face(h_.face_positions[face], {wedge[0], wedge[1], wedge[2]}, split);
    }

    void pack_record(uint32_t i) {
        std::vector<uint8_t>& out = mesh_.records_;
        mesh_.record_begin_.push_back(uint32_t(out.size()));
        if (h_.need_begin[i] == h_.need_begin[i + 1]) mesh_.roots_.push_back(i);
        uint32_t added = h_.added_begin[i], face_count = h_.added_begin[i + 1] - added, created = h_.new_position(i);
        auto is_wedged = [](auto begin, auto end) { return std::any_of(begin, end, [](uint16_t wedge) { return wedge != 0; }); };
        bool moves_wedged =
            is_wedged(h_.moved_wedge.begin() + h_.moved_begin[i], h_.moved_wedge.begin() + h_.moved_begin[i + 1]) ||
            is_wedged(h_.moved_back_wedge.begin() + h_.moved_begin[i], h_.moved_back_wedge.begin() + h_.moved_begin[i + 1]);
        bool faces_wedged =
            is_wedged(h_.birth_wedge.begin() + 3 * ptrdiff_t(added), h_.birth_wedge.begin() + 3 * ptrdiff_t(added + face_count));
        uint8_t head = uint8_t(face_count | (moves_wedged ? kHasMoveWedges : 0) | (faces_wedged ? kHasFaceWedges : 0));
        for (uint32_t k = 0; k < face_count; ++k)
            if (h_.face_positions[added + k][1] == created) head = uint8_t(head | kThirdIsLast << k);
        out.push_back(head);
        put_rows(i);
        put(out, created - h_.owner[i]);
        put(out, h_.base_face_count + 2 * i - added);
        put_moves(i, moves_wedged);
        for (uint32_t k = 0; k < face_count; ++k) {
            const auto& at = h_.face_positions[added + k];
            put(out, created - at[at[1] == created ? 2 : 1]);
            if (h_.surfaces.size() > 1) put(out, h_.group_surface[h_.face_group[added + k]]);
            for (size_t c = 0; faces_wedged && c < 3; ++c) put(out, h_.birth_wedge[3 * size_t(added + k) + c]);
        }
    }

    // Needs and dependents, each as steps from the one before.
    void put_rows(uint32_t i) {
        put(mesh_.records_, h_.need_begin[i + 1] - h_.need_begin[i]);
        uint32_t last = i;
        for (uint32_t k = h_.need_begin[i + 1]; k-- > h_.need_begin[i];) {
            put(mesh_.records_, last - h_.needs[k]);
            last = h_.needs[k];
        }
        put(mesh_.records_, dependent_begin_[i + 1] - dependent_begin_[i]);
        last = i;
        for (uint32_t k = dependent_begin_[i]; k < dependent_begin_[i + 1]; ++k) {
            put(mesh_.records_, dependents_[k] - last);
            last = dependents_[k];
        }
    }

    // From the youngest face down.
    void put_moves(uint32_t i, bool is_wedged) {
        put(mesh_.records_, h_.moved_begin[i + 1] - h_.moved_begin[i]);
        uint32_t last = h_.added_begin[i];
        for (uint32_t k = h_.moved_begin[i + 1]; k-- > h_.moved_begin[i];) {
            uint32_t face = h_.moved[k] / kCorners;
            put(mesh_.records_, (last - face) * kCorners + h_.moved[k] % kCorners);
            last = face;
            if (is_wedged) put(mesh_.records_, h_.moved_wedge[k]), put(mesh_.records_, h_.moved_back_wedge[k]);
        }
    }

    void apply(uint32_t i) {
        if (i % 64 == 0) mesh_.glides_.push_back(0);
        bool can_glide = half_angle_rad_of(h_.cone[i]) < std::numbers::pi / 2 - 0.01 && is_on_one_side(i) && winds_once(i, false);
        for (uint32_t k = h_.moved_begin[i]; k < h_.moved_begin[i + 1]; ++k)
            state_.move(h_.moved[k], h_.new_position(i), h_.moved_wedge[k], i);
        for (uint32_t face = h_.added_begin[i]; face < h_.added_begin[i + 1]; ++face) add_face(face, i);
        if (can_glide && winds_once(i, true)) mesh_.glides_.back() |= uint64_t(1) << (i % 64);
    }

    glm::dvec3 at(uint32_t position) const {  // in steps
        GridPosition steps = steps_of_position(h_.grid, h_.positions_m[position]);
        return {steps.at[0], steps.at[1], steps.at[2]};
    }

    // Is the new position on one side of all faces that it will move? Up to 16 bits whole steps make exact products; beyond, what
    // rounding could have turned counts for both sides.
    bool is_on_one_side(uint32_t i) const {
        double least = 0, greatest = 0;
        glm::dvec3 owner = at(h_.owner[i]), way = at(h_.new_position(i)) - owner;
        for (uint32_t k = h_.moved_begin[i]; k < h_.moved_begin[i + 1]; ++k) {
            const auto& corners = state_.positions(h_.moved[k] / kCorners);
            uint32_t c = h_.moved[k] % kCorners;
            double volume = glm::dot(way, glm::cross(at(corners[(c + 1) % 3]) - owner, at(corners[(c + 2) % 3]) - owner));
            double doubt = h_.grid.position_bits > 16 ? 1 << 14 : 0;
            least = std::min(least, volume - doubt), greatest = std::max(greatest, volume + doubt);
        }
        return h_.moved_begin[i] != h_.moved_begin[i + 1] && (least == 0 || greatest == 0);
    }

    // Seen along the cone's axis: do the faces moved, and after the split those added, go round their common corner at most once?
    bool winds_once(uint32_t i, bool is_split) const {
        glm::dvec3 axis = axis_of(h_.cone[i]),
                   right = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        glm::dvec3 up = glm::cross(axis, right);
        uint32_t middle = is_split ? h_.new_position(i) : h_.owner[i];
        double turned_rad = 0;
        auto add = [&](uint32_t face, uint32_t c) {
            const auto& corners = state_.positions(face);
            glm::dvec3 to_next = at(corners[(c + 1) % 3]) - at(middle), to_last = at(corners[(c + 2) % 3]) - at(middle);
            glm::dvec2 a(glm::dot(to_next, right), glm::dot(to_next, up)), b(glm::dot(to_last, right), glm::dot(to_last, up));
            turned_rad += std::abs(std::atan2(cross_2d(a, b), glm::dot(a, b)));
        };
        for (uint32_t k = h_.moved_begin[i]; k < h_.moved_begin[i + 1]; ++k) add(h_.moved[k] / kCorners, h_.moved[k] % kCorners);
        for (uint32_t face = h_.added_begin[i]; is_split && face < h_.added_begin[i + 1]; ++face)
            add(face, h_.face_positions[face][1] == middle ? 1 : 2);
        return turned_rad < 2 * std::numbers::pi + 1e-6;
    }

    const Hierarchy& h_;
    Mesh mesh_;
    MeshState state_;
    std::vector<uint32_t> dependent_begin_, dependents_;
};

Result<Mesh> Mesh::make(const Hierarchy& hierarchy) {
    return MeshPacker(hierarchy).run(std::nullopt);
}

Result<Mesh> Mesh::make(const Hierarchy& hierarchy, const WholeMesh& whole) {
    return MeshPacker(hierarchy).run(whole);
}

}  // namespace overlook::caveclod
