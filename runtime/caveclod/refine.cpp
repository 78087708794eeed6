#include "runtime/caveclod/refine.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <utility>

#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {

Refinement::Refinement(const Mesh& mesh) : mesh_(mesh), faces_(mesh.surface_count(), mesh.slot_bits()) {
    split_count_ = mesh.split_count();
    for (Bits* bits : {&applied_, &open_, &gliding_}) bits->assign((split_count_ + 63) / 64, 0);
    for (uint32_t face = 0; face < mesh.base_face_count(); ++face)
        faces_.add(mesh.base_surface(face), face, mesh.base_faces()[face]);
    for (uint32_t root : mesh.roots()) open(root);
}

void Refinement::apply(Frame& frame, const Wish& wish) {
    uint32_t split = wish.split;
    mesh_.decode(split, record_);
    for (uint32_t need : record_.needs) {
        if (has(gliding_, need)) finish_glide(need);
        close(need);
    }
    put(applied_, split, true);
    for (const SplitRecord::Move& move : record_.moves) faces_.set(move.corner, move.vertex);
    for (uint32_t k = 0; k < record_.face_count; ++k)
        faces_.add(record_.faces[k].surface, record_.faces[k].face, record_.faces[k].vertices);
    ++frame.report.split_count;
    if (may_glide(frame, wish)) start_glide(split, false, 0);
    for (uint32_t dependent : record_.dependents) {
        mesh_.decode_needs(dependent, needs_);
        if (!std::all_of(needs_.begin(), needs_.end(), [&](uint32_t need) { return has(applied_, need); })) continue;
        open(dependent);
        evaluate(frame, dependent);
    }
}

// The split leaves the faces as they were before it. opened_: what could be undone now.
void Refinement::take_back(uint32_t split) {
    mesh_.decode(split, record_);
    for (const SplitRecord::Move& move : record_.moves) faces_.set(move.corner, move.vertex_before);
    for (uint32_t k = 0; k < record_.face_count; ++k) faces_.remove(record_.faces[k].face);
    put(applied_, split, false);
    for (uint32_t dependent : record_.dependents) close(dependent);
    opened_.clear();
    for (uint32_t need : record_.needs) {
        mesh_.decode_dependents(need, needs_);
        if (std::any_of(needs_.begin(), needs_.end(), [&](uint32_t other) { return has(applied_, other); })) continue;
        open(need);
        opened_.push_back(need);
    }
}

void Refinement::undo(Frame& frame, uint32_t split) {
    take_back(split);
    for (uint32_t need : opened_) evaluate(frame, need);
}

// Only what keeps the promise unsplit as well may be seen gliding on its way; what fades is drawn as split.
bool Refinement::may_glide(const Frame& frame, const Wish& wish) const {
    const Settings& settings = frame.settings;
    if (settings.glide_s <= 0 || !(wish.error_px >= settings.least_glide_px)) return false;
    return !mesh_.glides(wish.split) || wish.error_px <= frame.test.least_limit_px();
}

// What keeps the promise unsplit lets those that it needs arrive.
bool Refinement::must_wait(const Frame& frame, const Wish& wish) {
    if (glides_.is_empty() || wish.error_px > frame.test.least_limit_px()) return false;
    mesh_.decode_needs(wish.split, needs_);
    return std::any_of(needs_.begin(), needs_.end(), [&](uint32_t need) { return has(gliding_, need); });
}

bool Refinement::collapse_next(Frame& frame) {
    while (!collapses_.empty()) {
        std::pop_heap(collapses_.begin(), collapses_.end(), std::greater<>());
        Wish wish = collapses_.back();
        collapses_.pop_back();
        if (!has(applied_, wish.split) || !has(open_, wish.split) || has(gliding_, wish.split)) continue;
        frame.report.error_px = std::max(frame.report.error_px, wish.error_px);
        ++frame.report.collapse_count;
        bool is_over_budget = frame.settings.most_triangles > 0 && faces_.face_count() + 2 > frame.settings.most_triangles;
        if (!is_over_budget && may_glide(frame, wish)) {
            mesh_.decode(wish.split, record_);
            start_glide(wish.split, true, 1);
        } else {
            undo(frame, wish.split);
        }
        return true;
    }
    return false;
}

// Under a budget of triangles, by collapsing what has less than its share of error_px. False if there is nothing such.
bool Refinement::make_room(Frame& frame, double error_px) {
    while (!reserve_.empty()) {
        std::pop_heap(reserve_.begin(), reserve_.end(), std::greater<>());
        Wish wish = reserve_.back();
        reserve_.pop_back();
        if (!has(applied_, wish.split) || !has(open_, wish.split)) continue;
        if (wish.error_px > error_px * frame.settings.collapse_share) return false;
        if (has(gliding_, wish.split)) finish_glide(wish.split);
        ++frame.report.collapse_count;
        undo(frame, wish.split);
        frame.report.error_px = std::max(frame.report.error_px, wish.error_px);
        return true;
    }
    return false;
}

bool Refinement::split_next(Frame& frame) {
    const uint64_t most = frame.settings.most_triangles;
    while (!splits_.empty()) {
        Wish wish = splits_.front();
        bool is_wanted = !has(applied_, wish.split) && has(open_, wish.split);
        if (is_wanted && most > 0 && faces_.face_count() + 2 > most) {
            if (collapse_next(frame)) return true;
            return make_room(frame, wish.error_px);
        }
        std::pop_heap(splits_.begin(), splits_.end());
        splits_.pop_back();
        if (!is_wanted) continue;
        if (must_wait(frame, wish)) {
            frame.report.error_px = std::max(frame.report.error_px, wish.error_px);
            continue;
        }
        apply(frame, wish);
        return true;
    }
    return false;
}

// Splits and collapses in turn, so that neither waits for the other.
void Refinement::operate(Frame& frame) {
    constexpr double kAnyError = 1e300;
    const uint64_t most = frame.settings.most_triangles;
    uint64_t& left = frame.operations_left;
    while (left > 0 && most > 0 && faces_.face_count() > most && (collapse_next(frame) || make_room(frame, kAnyError))) --left;
    for (bool is_done = false; left > 0 && !is_done;) {
        is_done = true;
        if (split_next(frame)) --left, is_done = false;
        if (left > 0 && collapse_next(frame)) --left, is_done = false;
    }
    frame.report.is_settled = left > 0;
    for (const Wish& wish : splits_)
        if (!has(applied_, wish.split) && has(open_, wish.split))
            frame.report.error_px = std::max(frame.report.error_px, wish.error_px);
}

void Refinement::begin(Frame& frame, double dt_s) {
    if (split_count_ != mesh_.split_count()) follow_mesh();
    const Settings& settings = frame.settings;
    frame.keeps_reserve = settings.most_triangles > 0 && faces_.face_count() * 8 > settings.most_triangles * 7;
    splits_.clear(), collapses_.clear(), reserve_.clear();
    advance_glides(frame, dt_s);
    if (settings.collapse_share == 1) undo_unwanted(frame);
    guess_greatest(frame);
    parts_.resize(part_count());
}

void Refinement::finish(Frame& frame) {
    const Settings& settings = frame.settings;
    for (const Found& found : parts_) take(frame, found);
    operate(frame);
    greatest_left_ = frame.greatest_left;
    frame.report.triangle_count = faces_.face_count();
    frame.report.gliding_count = uint32_t(glides_.all().size());
    if (mesh_.missing_error_m() > 0) {
        frame.report.missing_px = displaced_px(frame.camera, settings, mesh_.missing_error_m(), settings.error_px);
        frame.report.error_px = std::max(frame.report.error_px, frame.report.missing_px);
    }
}

FrameReport Refinement::refine(const view::Camera& camera, const Settings& settings, double dt_s, const view::FinerParts* finer) {
    Frame frame(mesh_, camera, settings, finer);
    begin(frame, dt_s);
    for (size_t part = 0; part < parts_.size(); ++part) look(frame, part);
    finish(frame);
    return frame.report;
}

// Splits have come, whose needs may be applied already, or gone. What glides goes on, where it may still.
void Refinement::follow_mesh() {
    uint32_t before = std::exchange(split_count_, mesh_.split_count());
    assert(split_end() <= split_count_);
    for (Bits* bits : {&applied_, &open_, &gliding_}) bits->resize((split_count_ + 63) / 64, 0);
    if (split_count_ < before && split_count_ % 64 != 0) open_.back() &= (uint64_t(1) << (split_count_ % 64)) - 1;
    for (uint32_t split = before; split < split_count_; ++split) {
        mesh_.decode_needs(split, needs_);
        if (std::all_of(needs_.begin(), needs_.end(), [&](uint32_t need) { return has(applied_, need); })) open(split);
    }
    std::vector<uint32_t> ended;
    for (const Glide& glide : glides_.all())
        if (glide.moves && !mesh_.glides(glide.split)) ended.push_back(glide.split);
    std::sort(ended.begin(), ended.end());
    for (uint32_t split : ended) finish_glide(split);
}

uint32_t Refinement::split_end() const {
    for (size_t word = applied_.size(); word-- > 0;)
        if (applied_[word] != 0) return uint32_t(64 * word) + uint32_t(std::bit_width(applied_[word]));
    return 0;
}

glm::dvec3 Refinement::place_m(uint32_t index) const {
    if (index < mesh_.glide_begin()) return mesh_.origin_m() + mesh_.vertex_m(index);
    const GlideVertex& glide = glides_.vertices()[index - mesh_.glide_begin()];
    glm::dvec3 to_m = mesh_.vertex_m(glide.to());
    return mesh_.origin_m() + (glide.glides() ? glm::mix(mesh_.vertex_m(glide.from[0]), to_m, double(glide.share)) : to_m);
}

double Refinement::displaced_px(const view::Camera& camera, const Settings& settings, double error_m, double enough_px) const {
    ScreenTest test(mesh_, camera, settings);
    glm::dvec3 middle_m = (mesh_.lowest_m() + mesh_.highest_m()) / 2.0;
    double all_px = test.seen_px(middle_m, glm::distance(middle_m, mesh_.highest_m()), error_m), greatest_px = 0;
    if (all_px <= enough_px) return all_px;
    for (uint32_t surface = 0; surface < faces_.surface_count(); ++surface) {
        for (uint32_t p = 0; p < faces_.pages(surface).size(); ++p) {
            const FacePage& page = *faces_.pages(surface)[p];
            for (uint32_t k = 0; k < 3 * faces_.page_count(surface, p); k += 3) {
                glm::dvec3 a = place_m(page.indices[k]), b = place_m(page.indices[k + 1]), c = place_m(page.indices[k + 2]);
                middle_m = (a + b + c) / 3.0;
                double radius_m = std::max({glm::distance(a, middle_m), glm::distance(b, middle_m), glm::distance(c, middle_m)});
                greatest_px = std::max(greatest_px, test.seen_px(middle_m, radius_m, error_m));
            }
        }
    }
    return greatest_px;
}

Refinement::Bytes Refinement::bytes() const {
    Bytes bytes;
    for (const Bits* bits : {&applied_, &open_, &gliding_}) bytes.fixed += bits->capacity() * sizeof(uint64_t);
    bytes.active = faces_.bytes();
    bytes.glides = glides_.bytes();
    return bytes;
}

}  // namespace overlook::caveclod
