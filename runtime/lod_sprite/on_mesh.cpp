#include "runtime/lod_sprite/on_mesh.h"

#include <algorithm>
#include <limits>

namespace overlook::lod_sprite {
namespace {

// Whatever the camera asks for, at once, without bands and glides.
caveclod::Settings settings_of(double error_px) {
    caveclod::Settings settings;
    settings.error_px = error_px;
    settings.collapse_share = 1;
    settings.guard_deg = 0;
    settings.most_operations = 0;
    settings.glide_s = 0;
    return settings;
}

}  // namespace

MeshGeometry::MeshGeometry(const caveclod::Mesh& mesh)
    : mesh_(mesh), coarse_(mesh), key_(mesh), near_(mesh.surface_count()), far_(mesh.surface_count()) {
    for (uint32_t root : mesh.roots()) most_slack_m_ = std::max(most_slack_m_, double(mesh.error_m(root)));
}

CutCount MeshGeometry::cut_coarse(const view::Camera& camera, const view::PixelDetail& detail) {
    caveclod::Settings settings = settings_of(detail.error_px);
    if (detail.keeps_outlines) settings.silhouette_error_px = std::min(detail.near_error_px, detail.error_px);
    view::FinerParts finer(camera, detail);
    caveclod::FrameReport report = coarse_.refine(camera, settings, 0, &finer);
    return {report.triangle_count, report.evaluated_count};
}

uint64_t MeshGeometry::put_near_first(const view::Camera& camera, double near_depth_m) {
    glm::dvec3 forward = view::axes_of(camera).forward, eye_m = camera.position_m - mesh_.origin_m();
    uint64_t near_count = 0;
    const caveclod::FaceSlots& faces = coarse_.faces();
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface) {
        near_[surface].clear(), far_[surface].clear();
        auto pages = faces.pages(surface);
        for (uint32_t page = 0; page < pages.size(); ++page) {
            for (uint32_t slot = 0; slot < faces.page_count(surface, page); ++slot) {
                const uint32_t* corners = &pages[page]->indices[3 * size_t(slot)];
                bool is_near = near_depth_m > 0 && std::all_of(corners, corners + 3, [&](uint32_t vertex) {
                                   return glm::dot(mesh_.vertex_m(vertex) - eye_m, forward) < near_depth_m;
                               });
                std::vector<uint32_t>& into = is_near ? near_[surface] : far_[surface];
                into.insert(into.end(), corners, corners + 3);
                near_count += is_near;
            }
        }
    }
    return near_count;
}

void MeshGeometry::begin_key(const view::Camera& camera, double error_px) {
    key_camera_ = camera;
    key_error_px_ = error_px;
    is_cut_ = false;
    slice_begin_ = drawn_ = 0;
}

Geometry::Slice MeshGeometry::next_slice(uint64_t triangles_wanted) {
    Slice slice;
    uint64_t left = triangles_wanted;
    slice_begin_ = drawn_;
    if (!is_cut_) {
        caveclod::Settings settings = settings_of(key_error_px_);
        bool is_limited = triangles_wanted < std::numeric_limits<uint32_t>::max();
        settings.most_operations = is_limited ? uint32_t(triangles_wanted) : 0;
        caveclod::FrameReport report = key_.refine(key_camera_, settings, 0);
        slice.count.tested_count = report.evaluated_count;
        is_cut_ = report.is_settled;
        left -= std::min<uint64_t>(left, report.split_count + report.collapse_count);
    }
    uint64_t all = key_.faces().face_count();
    if (is_cut_) drawn_ = std::min(all, drawn_ + left);
    slice.count.triangle_count = drawn_ - slice_begin_;
    slice.is_last = is_cut_ && drawn_ == all;
    return slice;
}

}  // namespace overlook::lod_sprite
