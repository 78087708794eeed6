// A director flown over hills, frame by frame, with a ray marcher for a renderer.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/lod_sprite/director.h"
#include "runtime/lod_sprite/on_terrain.h"
#include "tests/runtime/lod_sprite/sprite_fixture.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::lod_sprite::flown {

using Triangles = std::multiset<std::array<uint32_t, 3>>;

// What a frame was, kept.
struct Frame {
    view::Camera camera;
    Novel novel;
    std::vector<uint32_t> indices;  // of the coarse cut
    uint64_t slice_triangles = 0;
    bool had_work = false, ended_key = false;
    std::optional<view::Camera> begun;
};

struct Ground {
    terrain::Terrain terrain = *terrain::bake(overlook::test::make_hills(257, 257, 4), {}, [](double) {});
    terrain::Refiner refiner{terrain};
};
inline const Ground& ground() {
    static const Ground kGround;
    return kGround;
}

// Above the hills, looking over them.
inline view::Camera start_pose() {
    view::Camera camera;
    camera.position_m = {3800, -8500, 2000};
    camera.pitch_deg = -15;
    camera.width_px = 320, camera.height_px = 180;
    return camera;
}

constexpr uint64_t kThreadTriangles = 1234;  // of keys that a thread is said to have drawn

// Carries out what a director plans, with a ray marcher for a renderer; sees to it that plans can be carried out.
class Flight {
  public:
    explicit Flight(const Settings& settings = {}) : director_(geometry_, settings) {}

    Frame step(const view::Camera& camera) {
        Frame frame;
        frame.camera = camera;
        while (std::optional<KeyWork> work = director_.key_work(camera)) {
            EXPECT_FALSE(frame.had_work && !frame.ended_key) << "two slices of a key in a frame";
            carry_out(*work, frame);
        }
        EXPECT_EQ(director_.key_triangles(), frame.slice_triangles);
        frame.novel = director_.novel();
        frame.indices = geometry_.coarse().indices;
        EXPECT_EQ(frame.novel.cut.triangle_count, geometry_.coarse().triangle_count());
        for (const NovelUse& use : frame.novel.keys) EXPECT_TRUE(whole_.count(use.slot)) << "a key that is not whole is used";
        EXPECT_EQ(frame.novel.is_fine, frame.novel.keys.empty());
        return frame;
    }
    std::vector<Frame> fly(view::Camera camera, const glm::dvec3& step_m, double turn_deg, int frames) {
        std::vector<Frame> flown;
        for (int i = 0; i < frames; ++i) {
            flown.push_back(step(camera));
            camera.position_m += step_m;
            camera.heading_deg += turn_deg;
        }
        return flown;
    }
    Director& director() { return director_; }

    // Of every key begun: its camera, and what was drawn into it.
    std::vector<std::pair<view::Camera, Triangles>> drawn;
    std::vector<bool> ended;

  private:
    void carry_out(const KeyWork& work, Frame& frame) {
        frame.had_work = true;
        if (work.begin != nullptr) {
            frame.begun = *work.begin;
            whole_.erase(work.slot);
            camera_of_[work.slot] = *work.begin;
            place_of_[work.slot] = drawn.size();
            drawn.push_back({*work.begin, {}});
            ended.push_back(false);
        }
        if (work.slice) add_slice(work, frame);
        if (!work.is_last) return;
        frame.ended_key = true;
        ended[place_of_.at(work.slot)] = true;
        whole_.insert(work.slot);
        director_.key_done(test::seen_depths(ground().terrain, camera_of_.at(work.slot), 48), kThreadTriangles);
        if (!work.slice) frame.slice_triangles = kThreadTriangles;
    }
    void add_slice(const KeyWork& work, Frame& frame) {
        const std::vector<uint32_t>& indices = geometry_.slice().indices;
        EXPECT_EQ(3 * work.slice->triangle_count, indices.size());
        frame.slice_triangles += work.slice->triangle_count;
        Triangles& into = drawn[place_of_.at(work.slot)].second;
        for (size_t i = 0; i < indices.size(); i += 3) {
            std::array<uint32_t, 3> t{indices[i], indices[i + 1], indices[i + 2]};
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            into.insert(t);
        }
    }

    TerrainGeometry geometry_{ground().refiner};
    Director director_;
    std::set<uint32_t> whole_;
    std::map<uint32_t, view::Camera> camera_of_;
    std::map<uint32_t, size_t> place_of_;
};

inline Triangles triangles_of(const std::vector<uint32_t>& indices) {
    Triangles triangles;
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::array<uint32_t, 3> t{indices[i], indices[i + 1], indices[i + 2]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.insert(t);
    }
    return triangles;
}

// Frames until one is shown from keys within the settings' limit.
inline int frames_without_key(Flight& flight, view::Camera camera, const glm::dvec3& step_m) {
    for (int frame = 0; frame < 100; ++frame) {
        Frame shown = flight.step(camera);
        if (!shown.novel.is_fine && shown.novel.error_p99_px <= flight.director().settings().key_error_px * 1.5) return frame;
        camera.position_m += step_m;
    }
    return 100;
}

}  // namespace overlook::lod_sprite::flown
