#include "runtime/caveclod/draw_frames.h"

#include <algorithm>
#include <cmath>

namespace overlook::caveclod {
namespace {

constexpr uint32_t kMostTraversals = 256;  // to the first frame

}  // namespace

std::vector<view::Camera> cameras_round(const view::Camera& camera, uint32_t count) {
    std::vector<view::Camera> cameras(count, camera);
    for (uint32_t i = 1; i < count; ++i) cameras[i].heading_deg = std::remainder(camera.heading_deg + 360.0 * i / count, 360.0);
    return cameras;
}

FrameDrawer::FrameDrawer(const Hierarchy& hierarchy, const Mesh& mesh, const Drawing& drawing, const FrameOptions& options)
    : mesh_(mesh), drawing_(drawing), options_(options), reports_(options.cameras) {
    if (options.variant == Variant::paper) paper_mesh_ = std::make_unique<paper::Mesh>(hierarchy);
    start();
}

void FrameDrawer::start() {
    paper_.clear(), refinements_.clear(), buffers_.clear();
    bool is_one = options_.variant == Variant::shared;
    for (uint32_t i = 0; i < options_.cameras; ++i) {
        if (paper_mesh_) {
            paper_.push_back(std::make_unique<paper::CameraRefinement>(*paper_mesh_));
        } else if (i == 0 || !is_one) {
            refinements_.push_back(std::make_unique<Refinement>(mesh_));
        }
        if (i == 0 || !is_one) buffers_.push_back(std::make_unique<CameraBuffers>(mesh_));
    }
    is_first_ = true;
}

void FrameDrawer::take(const FrameReport& report, bool is_drawn) {
    counts_.split_count += report.split_count;
    counts_.collapse_count += report.collapse_count;
    counts_.forced_count += report.forced_count;
    counts_.evaluated_count += report.evaluated_count;
    counts_.refined_triangle_count += report.triangle_count;
    counts_.is_settled = counts_.is_settled && report.is_settled;
    if (is_drawn) counts_.error_px = report.error_px, counts_.missing_px = report.missing_px;
}

void FrameDrawer::decide(const view::Camera& camera, double dt_s) {
    bool is_resized = !cameras_.empty() && (cameras_[0].width_px != camera.width_px || cameras_[0].height_px != camera.height_px);
    if (is_resized) start();
    cameras_ = cameras_round(camera, options_.cameras);
    counts_ = {};
    switch (options_.variant) {
        case Variant::own:
            decide_own(dt_s);
            break;
        case Variant::shared:
            decide_shared();
            break;
        case Variant::paper:
            decide_paper();
            break;
    }
}

void FrameDrawer::decide_own(double dt_s) {
    std::vector<Refinement*> all;
    for (const auto& refinement : refinements_) all.push_back(refinement.get());
    if (is_first_) {
        // All the way: whatever glides has arrived, and what waited for it as well.
        Settings at_once = options_.settings;
        at_once.most_operations = 0;
        dt_s = options_.settings.glide_s;
        bool is_gliding = true;
        for (uint32_t round = 0; is_gliding && round < kMostTraversals; ++round) {
            refine_all(all, cameras_, at_once, dt_s, reports_);
            is_gliding = false;
            for (const FrameReport& report : reports_) {
                is_gliding = is_gliding || report.gliding_count > 0;
                take(report, false);
            }
        }
    }
    is_first_ = false;
    refine_all(all, cameras_, options_.settings, dt_s, reports_);
    for (size_t i = 0; i < all.size(); ++i) {
        take(reports_[i], i == 0);
        buffers_[i]->take(*all[i]);
        counts_.uploaded_bytes += buffers_[i]->uploaded_bytes();
        Refinement::Bytes bytes = all[i]->bytes();
        counts_.camera_bytes += bytes.fixed + bytes.active + bytes.glides;
    }
}

// The camera that is drawn comes last, so that its faces are what stays.
void FrameDrawer::decide_shared() {
    std::vector<view::Camera> in_turn(cameras_.rbegin(), cameras_.rend());
    Refinement& shared = *refinements_.front();
    refine_in_turn(
        shared, in_turn, options_.settings,
        [&](size_t) {
            buffers_.front()->take(shared);
            counts_.uploaded_bytes += buffers_.front()->uploaded_bytes();
        },
        reports_);
    for (size_t i = 0; i < reports_.size(); ++i) take(reports_[i], i + 1 == reports_.size());
    Refinement::Bytes bytes = shared.bytes();
    counts_.camera_bytes = bytes.fixed + bytes.active + bytes.glides;
}

void FrameDrawer::decide_paper() {
    paper::Options options;
    options.settings = options_.settings;
    std::vector<std::vector<uint32_t>> by_surface;
    for (size_t i = 0; i < paper_.size(); ++i) {
        FrameReport report = paper_[i]->refine(cameras_[i], options);
        // A traversal goes one step deeper.
        for (uint32_t more = 0; is_first_ && !report.is_settled && more < kMostTraversals; ++more) {
            FrameReport next = paper_[i]->refine(cameras_[i], options);
            report.split_count += next.split_count, report.collapse_count += next.collapse_count;
            report.forced_count += next.forced_count, report.evaluated_count += next.evaluated_count;
            report.triangle_count = next.triangle_count, report.is_settled = next.is_settled;
        }
        take(report, i == 0);
        uint64_t wrong = 0;
        paper_[i]->collect(by_surface, wrong);
        buffers_[i]->take(by_surface);
        counts_.uploaded_bytes += buffers_[i]->uploaded_bytes();
        if (i > 0) continue;
        counts_.wrong_corner_count = wrong;
        paper_faces_ = by_surface;
    }
    is_first_ = false;
    for (const auto& camera : paper_) {
        paper::Equation1 terms = paper::equation1(paper_mesh_->nodes().size(), mesh_.face_count(), 0, 0, 0,
                                                  camera->active_node_count(), camera->active_polygon_count(), 1);
        counts_.camera_bytes += terms.active_nodes + terms.active_polygons + terms.cameras;
    }
}

FrameCounts FrameDrawer::draw(const gl::Target& target, const DrawOptions& look) {
    drawing_.draw(target, *buffers_.front(), cameras_.front(), look);
    counts_.triangle_count = buffers_.front()->triangle_count();
    counts_.draw_call_count = buffers_.front()->draw_call_count() + 1;  // and the background
    return counts_;
}

void FrameDrawer::take_note(MeshStream& stream, size_t mesh) const {
    for (size_t i = 0; i < refinements_.size(); ++i)
        stream.take_note(mesh, *refinements_[i], cameras_[i], options_.settings, reports_[i].missing_px);
}

std::vector<glm::dvec3> FrameDrawer::drawn_corners_m() const {
    std::vector<glm::dvec3> corners;
    auto add_own = [&](uint32_t index) { corners.push_back(refinements_.front()->place_m(index)); };
    auto add = [&](uint32_t vertex) { corners.push_back(mesh_.origin_m() + mesh_.vertex_m(vertex)); };
    for (const std::vector<uint32_t>& indices : paper_faces_) std::for_each(indices.begin(), indices.end(), add);
    if (refinements_.empty()) return corners;
    const FaceSlots& faces = refinements_.front()->faces();
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface) {
        for (uint32_t page = 0; page < faces.pages(surface).size(); ++page) {
            const FacePage& one = *faces.pages(surface)[page];
            std::for_each(one.indices.begin(), one.indices.begin() + 3 * faces.page_count(surface, page), add_own);
        }
    }
    return corners;
}

}  // namespace overlook::caveclod
