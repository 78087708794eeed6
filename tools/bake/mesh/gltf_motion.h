// From a glTF file's animation to parts that move rigidly.
#pragma once

#include <optional>

#include "tools/bake/mesh/gltf_accessors.h"
#include "tools/bake/mesh_motion.h"

namespace overlook::mesh::gltf {

// Where the nodes of a scene are at any time of its first animation.
class MotionReader {
  public:
    MotionReader(const Document& document, Buffers& buffers, const std::string& name)
        : document_(document), accessors_(document, buffers, name), name_(name) {}

    // Reads the channels. Fails with Exit::bad_input: "a.glb: animation channel 2 has 4 values for 3 times".
    Result<void> read();
    bool moves(uint32_t node) const { return !tracks_.empty() && !tracks_[node].empty(); }
    double clip_s() const { return clip_s_; }

    // The part that a node which moves is, with `ancestors` from the root to it; nothing (and a note) where it does not move
    // rigidly, lies more than 256 nodes deep, or part_count is 1,023 already. Keys are dense enough that what lies between is
    // within a quarter of a degree and a thousandth of the way.
    std::optional<Motion::Part> part_of(const std::vector<uint32_t>& ancestors, size_t part_count,
                                        std::vector<std::string>& notes) const;

  private:
    struct Track {
        bool is_rotation = false;
        Channel::Way way = Channel::Way::linear;
        std::vector<double> times_s;
        std::vector<glm::dvec4> values;  // of cubic: in-tangent, value, out-tangent
        glm::dvec4 at(double time_s) const;
    };
    Result<Track> read_track(const Channel& channel, size_t number);
    glm::dmat4 transform_at(uint32_t node, double time_s) const;
    glm::dmat4 world_at(const std::vector<uint32_t>& ancestors, double time_s) const;
    std::vector<double> times_of(const std::vector<uint32_t>& ancestors) const;
    bool key_at(const std::vector<uint32_t>& ancestors, double time_s, Motion::Key& key) const;
    bool refine(const std::vector<uint32_t>& ancestors, const Motion::Key& before, const Motion::Key& after, int depth,
                std::vector<Motion::Key>& keys) const;

    const Document& document_;
    Accessors accessors_;
    const std::string& name_;
    std::vector<std::vector<Track>> tracks_;  // [nodes], or none
    double clip_s_ = 0;
};

}  // namespace overlook::mesh::gltf
