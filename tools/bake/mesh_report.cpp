// The report's sums and words.

#include "tools/bake/mesh_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/numbers.h"

namespace overlook::mesh {
namespace {

// One line: the parts whose count is not 0, or "" if there is none.
class Line {
  public:
    explicit Line(std::string head) : text_(std::move(head)) {}
    Line& add(uint64_t count, std::string_view what) {
        if (count > 0) text_ += fmt::format("{}{} {}", has_part_ ? ", " : ": ", with_commas(count), what);
        has_part_ = has_part_ || count > 0;
        return *this;
    }
    void append_to(std::vector<std::string>& lines) const {
        if (has_part_) lines.push_back(text_);
    }

  private:
    std::string text_;
    bool has_part_ = false;
};

}  // namespace

std::string_view name_of(DropReason reason) {
    static constexpr std::string_view kNames[kDropReasonCount] = {"too_few_corners", "not_finite", "repeated_position", "no_area",
                                                                  "duplicate"};
    return kNames[size_t(reason)];
}

uint64_t MeshReport::dropped_count(DropReason reason) const {
    return uint64_t(
        std::count_if(dropped.begin(), dropped.end(), [&](const DroppedFace& face) { return face.reason == reason; }));
}

std::vector<std::string> text_of(const MeshReport& report) {
    std::vector<std::string> lines;
    Line(fmt::format("{} ({})", report.source_name, report.form))
        .add(report.triangle_count, "triangles")
        .add(report.polygon_count != report.triangle_count ? report.polygon_count : 0, "polygons")
        .add(report.file_position_count, "positions")
        .add(report.other_primitive_count, "points and lines, not read")
        .append_to(lines);
    Line("mesh")
        .add(report.face_count, "faces")
        .add(report.position_count, "positions")
        .add(report.component_count, "pieces")
        .add(report.closed_component_count, "of them closed")
        .add(report.border_edge_count, "edges of border")
        .append_to(lines);
    Line dropped("dropped");
    for (size_t i = 0; i < kDropReasonCount; ++i)
        dropped.add(report.dropped_count(DropReason(i)), std::string("faces: ").append(name_of(DropReason(i))));
    dropped.append_to(lines);
    Line("repaired")
        .add(report.welded_position_count, "positions welded")
        .add(report.unused_position_count, "positions unused")
        .add(report.flipped_face_count, "faces turned")
        .add(report.back_side_count, "back sides kept apart")
        .add(report.complex_edge_count, "edges of more than two faces")
        .add(report.unorientable_edge_count, "edges that cannot be oriented")
        .add(report.contradicting_edge_count, "edges whose faces contradict each other")
        .add(report.cut_edge_count, "edges added by cutting")
        .add(report.split_position_count, "positions added by splitting")
        .add(report.bad_normal_count, "normals missing")
        .add(report.bad_uv_count, "texture coordinates missing")
        .append_to(lines);
    lines.insert(lines.end(), report.notes.begin(), report.notes.end());
    return lines;
}

}  // namespace overlook::mesh
