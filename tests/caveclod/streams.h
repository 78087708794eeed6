// What the tests of streamed meshes share: two files, streams of them, and frames.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/caveclod/mesh_stream.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/mesh_files.h"

namespace overlook::caveclod::streams {

using flights::kFrame_s;

constexpr uint64_t kMuch = uint64_t(1) << 30;

struct Baked {
    explicit Baked(const synthetic::Source& source)
        : file(synthetic::file_of(synthetic::bake(source))), hierarchy(*synthetic::read_bytes(file)) {}
    std::string file;
    Hierarchy hierarchy;
};
// Four blocks of splits each.
inline const Baked& sphere() {
    static const Baked kSphere(synthetic::sphere(72));
    return kSphere;
}
inline const Baked& hills() {
    static const Baked kHills(synthetic::hills(96, 96, 3));
    return kHills;
}

inline container::Reader reader_of(const std::string& bytes) {
    return *container::Reader::open_bytes(std::as_bytes(std::span(bytes)), "mesh.ovl");
}

inline std::unique_ptr<MeshStream> opened(const std::vector<const Baked*>& meshes, const stream::Settings& settings) {
    std::vector<container::Reader> readers;
    for (const Baked* mesh : meshes) readers.push_back(reader_of(mesh->file));
    auto stream = MeshStream::open(std::move(readers), settings);
    EXPECT_TRUE(stream) << stream.error().message;
    return std::move(*stream);
}
inline std::unique_ptr<MeshStream> opened(const Baked& mesh, uint64_t budget_bytes, std::optional<uint32_t> latency = 1) {
    return opened({&mesh}, {budget_bytes, 1 << 24, 1, latency});
}

// A mesh of a stream as some cameras see it.
class Cameras {
  public:
    Cameras(MeshStream& stream, size_t mesh, size_t count) : stream_(stream), mesh_(mesh), reports_(count) {
        for (size_t k = 0; k < count; ++k) {
            made_.push_back(std::make_unique<Refinement>(stream.mesh(mesh)));
            refinements_.push_back(made_.back().get());
        }
    }
    // What a frame does between begin and end.
    void refine(std::span<const view::Camera> cameras, const Settings& settings) {
        refine_all(refinements_, cameras, settings, kFrame_s, reports_);
        for (size_t k = 0; k < cameras.size(); ++k)
            stream_.take_note(mesh_, *refinements_[k], cameras[k], settings, reports_[k].missing_px);
    }
    const FrameReport& report(size_t camera = 0) const { return reports_[camera]; }
    const Refinement& operator[](size_t camera) const { return *refinements_[camera]; }

  private:
    MeshStream& stream_;
    size_t mesh_;
    std::vector<std::unique_ptr<Refinement>> made_;
    std::vector<Refinement*> refinements_;
    std::vector<FrameReport> reports_;
};

// One frame of one mesh and camera.
inline void play(MeshStream& stream, Cameras& cameras, const view::Camera& camera, const Settings& settings) {
    for (const Error& fault : stream.begin_frame()) ADD_FAILURE() << fault.message;
    cameras.refine(std::span(&camera, 1), settings);
    stream.end_frame();
}

inline void settle(MeshStream& stream, Cameras& cameras, const view::Camera& camera, const Settings& settings) {
    do {
        play(stream, cameras, camera, settings);
    } while (!stream.is_settled());
    play(stream, cameras, camera, settings);
}

}  // namespace overlook::caveclod::streams
