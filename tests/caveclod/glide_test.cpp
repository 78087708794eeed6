// Vertices on their way: between two legal cuts, in the time that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/caveclod/refine.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod {
namespace {

using flights::camera_at;
using flights::flown;
using flights::kFrame_s;
using flights::plain;

using Corners = std::array<glm::dvec3, 3>;

// Height along `axis` over a place of the plane across it, of the first of some triangles that covers it.
class Heights {
  public:
    Heights(const glm::dvec3& axis, std::vector<Corners> triangles) : axis_(axis), triangles_(std::move(triangles)) {
        right_ = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        up_ = glm::cross(axis, right_);
    }
    double of(const glm::dvec3& point) const { return glm::dot(axis_, point); }
    std::optional<double> at(const glm::dvec3& point) const {
        glm::dvec2 p = flat(point);
        for (const Corners& t : triangles_) {
            glm::dvec2 a = flat(t[0]), b = flat(t[1]), c = flat(t[2]);
            double area = cross(b - a, c - a), wa = cross(b - p, c - p) / area, wb = cross(c - p, a - p) / area;
            if (area > 0 && wa >= -1e-9 && wb >= -1e-9 && wa + wb <= 1 + 1e-9)
                return wa * of(t[0]) + wb * of(t[1]) + (1 - wa - wb) * of(t[2]);
        }
        return std::nullopt;
    }

  private:
    glm::dvec2 flat(const glm::dvec3& p) const { return {glm::dot(right_, p), glm::dot(up_, p)}; }
    static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
    glm::dvec3 axis_, right_, up_;
    std::vector<Corners> triangles_;
};

struct Star {
    std::vector<Corners> before, after;
    // Of each face of `after`, which corner is the new position's.
    std::vector<size_t> gliding;
    glm::dvec3 owner, created;
};

// Calls visit(split, star) with the star of every split as it is when all before are applied.
template <class Visit>
void visit_stars(const Hierarchy& h, const Visit& visit) {
    std::vector<std::array<uint32_t, 3>> faces(h.face_positions.begin(), h.face_positions.begin() + h.base_face_count);
    auto corners = [&](uint32_t face) {
        return Corners{glm::dvec3(h.positions_m[faces[face][0]]), glm::dvec3(h.positions_m[faces[face][1]]),
                       glm::dvec3(h.positions_m[faces[face][2]])};
    };
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        Star star;
        star.owner = glm::dvec3(h.positions_m[h.owner[i]]), star.created = glm::dvec3(h.positions_m[h.new_position(i)]);
        for (uint32_t k = h.moved_begin[i]; k < h.moved_begin[i + 1]; ++k) {
            uint32_t face = h.moved[k] / kCorners, c = h.moved[k] % kCorners;
            star.before.push_back(corners(face));
            faces[face][c] = h.new_position(i);
            star.after.push_back(corners(face));
            star.gliding.push_back(c);
        }
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) {
            faces.push_back(h.face_positions[face]);
            star.after.push_back(corners(face));
            star.gliding.push_back(h.face_positions[face][1] == h.new_position(i) ? 1 : 2);
        }
        visit(i, star);
    }
}

void expect_between(const Hierarchy& h, double least_share) {
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    size_t gliding = 0, checked = 0, missed = 0;
    visit_stars(h, [&](uint32_t split, const Star& star) {
        if (!mesh->glides(split)) return;
        ++gliding;
        Heights before(axis_of(h.cone[split]), star.before), after(axis_of(h.cone[split]), star.after);
        for (double share : {0.25, 0.5, 0.8}) {
            for (size_t k = 0; k < star.after.size(); ++k) {
                Corners t = star.after[k];
                t[star.gliding[k]] = star.owner + share * (star.created - star.owner);
                for (int a = 1; a < 6; ++a)
                    for (int b = 1; a + b < 7; ++b) {
                        glm::dvec3 point = (double(a) * t[0] + double(b) * t[1] + double(7 - a - b) * t[2]) / 7.0;
                        auto low = before.at(point), high = after.at(point);
                        if (!low || !high) {
                            ++missed;
                            continue;
                        }
                        ++checked;
                        double at = before.of(point);
                        ASSERT_GE(at, std::min(*low, *high) - 1e-6);
                        ASSERT_LE(at, std::max(*low, *high) + 1e-6);
                    }
            }
        }
    });
    EXPECT_GT(double(gliding), least_share * h.split_count());
    EXPECT_LT(double(missed), 0.02 * double(checked));
}

TEST(Glide, StaysBetweenWhatWasDrawnAndWhatWillBe) {
    expect_between(synthetic::bake(synthetic::sphere(24)), 0.5);
    expect_between(synthetic::bake(synthetic::hills(48, 48)), 0.1);
}

// Some splits cross the surface that they replace: those must not glide.
TEST(Glide, IsRefusedToSplitsThatCrossTheOldForm) {
    Hierarchy h = synthetic::bake(synthetic::hills(48, 48));
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    size_t crossing = 0;
    visit_stars(h, [&](uint32_t split, const Star& star) {
        double least = 0, greatest = 0;
        for (const Corners& t : star.before) {
            double above = glm::dot(star.created - star.owner, glm::cross(t[1] - t[0], t[2] - t[0]));
            least = std::min(least, above), greatest = std::max(greatest, above);
        }
        if (least > -1e-6 || greatest < 1e-6) return;
        ++crossing;
        EXPECT_FALSE(mesh->glides(split));
    });
    EXPECT_GT(crossing, 20u);
}

// How far what is drawn on its way has come, each share once.
std::vector<float> drawn_shares(const Refinement& refinement) {
    std::vector<float> shares;
    const FaceSlots& faces = refinement.faces();
    uint32_t vertex_count = refinement.mesh().vertex_count();
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
        for (uint32_t p = 0; p < faces.pages(surface).size(); ++p)
            for (uint32_t k = 0; k < 3 * faces.page_count(surface, p); ++k)
                if (uint32_t index = faces.pages(surface)[p]->indices[k]; index >= vertex_count)
                    shares.push_back(refinement.glide_vertices()[index - vertex_count].share);
    std::sort(shares.begin(), shares.end());
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    return shares;
}

TEST(Glide, TakesItsTimeAndTurnsBackOnItsWay) {
    Hierarchy h = synthetic::bake(synthetic::sphere(24));
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    Settings settings = plain();
    settings.error_px = 2, settings.glide_s = 0.25;
    Refinement refinement(*mesh);
    view::Camera far = camera_at(0, -60, 0, 0, 0), near = camera_at(0, -56, 0, 0, 0);
    for (int frame = 0; frame < 60; ++frame) refinement.refine(far, settings, kFrame_s);
    uint64_t coarse = refinement.faces().face_count();
    FrameReport begun = refinement.refine(near, settings, kFrame_s);
    ASSERT_GT(begun.gliding_count, 0u);
    EXPECT_EQ(drawn_shares(refinement), std::vector<float>{0});
    for (int frame = 0; frame < 7; ++frame) refinement.refine(near, settings, kFrame_s);
    std::vector<float> shares = drawn_shares(refinement);
    ASSERT_EQ(shares.size(), 1u);
    EXPECT_NEAR(shares[0], 7 / 15.0, 1e-3);
    FrameReport last;  // some have waited for those that they need: one after the other
    for (int frame = 0; frame < 60; ++frame) last = refinement.refine(near, settings, kFrame_s);
    EXPECT_EQ(last.gliding_count, 0u);
    // Away again: the same ones glide back, and go.
    view::Camera away = camera_at(0, -120, 0, 0, 0);
    FrameReport back = refinement.refine(away, settings, kFrame_s);
    EXPECT_GT(back.gliding_count, 0u);
    for (int frame = 0; frame < 200; ++frame) last = refinement.refine(away, settings, kFrame_s);
    EXPECT_EQ(last.gliding_count, 0u);
    EXPECT_LT(refinement.faces().face_count(), coarse);
}

// What may not glide stands at its place at once, and looks as the coarser surface did there: over hills whose colour is a
// height's, that is the height of the face that it came out of.
TEST(Fade, BeginsAsTheCoarserSurfaceLooked) {
    Hierarchy h = synthetic::bake(synthetic::hills(48, 48));
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    Refinement refinement(*mesh);
    Settings settings = plain();
    settings.glide_s = 0.25, settings.error_px = 3;
    size_t fading = 0, gliding = 0;
    for (int frame = 0; frame < 60; ++frame) {
        refinement.refine(flown(0.02 * frame), settings, kFrame_s);
        for (const GlideVertex& vertex : refinement.glide_vertices()) {
            if (vertex.glides()) {
                ++gliding;
                EXPECT_EQ(vertex.from[0], vertex.from[1]);
                EXPECT_EQ(vertex.from[0], vertex.from[2]);
                continue;
            }
            ++fading;
            double a = vertex.weights[0] / 65535.0, b = vertex.weights[1] / 65535.0;
            glm::dvec3 at = a * mesh->vertex_m(vertex.from[0]) + b * mesh->vertex_m(vertex.from[1]) +
                            (1 - a - b) * mesh->vertex_m(vertex.from[2]);
            // The place that it takes its looks from is that over which it came to stand, as near as a projection along the
            // face's own normal is.
            glm::dvec3 to = mesh->vertex_m(vertex.to());
            double away = glm::distance(at, to), face = std::max(glm::distance(mesh->vertex_m(vertex.from[0]), to), 1e-9);
            EXPECT_LE(away, face + 1e-3);
        }
    }
    EXPECT_GT(fading, 100u);
    EXPECT_GT(gliding, 10u);
}

// It is the finer cut that is drawn, so nothing waits at less than what was asked.
TEST(Fade, HidesNoError) {
    Hierarchy h = synthetic::bake(synthetic::hills(48, 48));
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    Settings fades = plain(), pops = plain();
    fades.glide_s = 0.25, pops.glide_s = 0;
    Refinement fading(*mesh), popping(*mesh);
    for (int frame = 0; frame < 40; ++frame) {
        FrameReport report = fading.refine(flown(0.02 * frame), fades, kFrame_s);
        popping.refine(flown(0.02 * frame), pops, kFrame_s);
        EXPECT_LE(report.error_px, fades.error_px);
        for (uint32_t split = 0; split < mesh->split_count(); ++split) {
            if (popping.is_applied(split) && !mesh->glides(split)) {
                ASSERT_TRUE(fading.is_applied(split)) << frame << " " << split;
            }
        }
    }
}

// Indices of what glides stand for both its ends; all others for vertices of the mesh.
TEST(Glide, DrawsEveryIndexFromTheMeshOrFromItsList) {
    Hierarchy h = synthetic::bake(synthetic::hills(48, 48, 2));
    Result<Mesh> mesh = Mesh::make(h);
    ASSERT_TRUE(mesh);
    Refinement refinement(*mesh);
    Settings settings = plain();
    settings.glide_s = 0.25;
    size_t seen = 0;
    for (int frame = 0; frame < 50; ++frame) {
        refinement.refine(flown(0.02 * frame), settings, kFrame_s);
        const FaceSlots& faces = refinement.faces();
        for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
            for (uint32_t p = 0; p < faces.pages(surface).size(); ++p)
                for (uint32_t k = 0; k < 3 * faces.page_count(surface, p); ++k) {
                    uint32_t index = faces.pages(surface)[p]->indices[k];
                    if (index < mesh->vertex_count()) continue;
                    ASSERT_LT(index - mesh->vertex_count(), refinement.glide_vertices().size());
                    const GlideVertex& vertex = refinement.glide_vertices()[index - mesh->vertex_count()];
                    ASSERT_LT(std::max({vertex.to(), vertex.from[0], vertex.from[1], vertex.from[2]}), mesh->vertex_count());
                    ASSERT_LE(vertex.weights[0] + vertex.weights[1], 65535);
                    ++seen;
                }
    }
    EXPECT_GT(seen, 100u);
}

}  // namespace
}  // namespace overlook::caveclod
