// Sampled animations. Source: glTF 2.0 Specification, section 3.11 and appendix C.

#include "tools/bake/mesh/gltf_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace overlook::mesh::gltf {
namespace {

constexpr double kStep_s = 1e-3;  // how long before its end what steps still stands
constexpr double kTurnSlack_rad = 0.00436, kMoveSlack = 1e-3, kRigidSlack = 1e-4;
constexpr int kDeepest = 7;
constexpr size_t kMostKeys = 1 << 14, kMostAncestors = 256, kMostParts = 1023;

glm::dquat quat_of(const glm::dvec4& v) {
    glm::dquat q(v.w, v.x, v.y, v.z);
    return glm::length(q) > 0 ? glm::normalize(q) : glm::dquat(1, 0, 0, 0);
}

glm::dvec4 slerp(const glm::dvec4& a, const glm::dvec4& b, double share) {
    glm::dquat q = glm::slerp(quat_of(a), quat_of(b), share);
    return {q.x, q.y, q.z, q.w};
}

// A rotation's matrix, give or take rounding.
bool is_rigid(const glm::dmat3& m) {
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            if (!(std::abs(glm::dot(m[i], m[j]) - (i == j ? 1 : 0)) <= kRigidSlack)) return false;
    return glm::determinant(m) > 0;
}

}  // namespace

glm::dvec4 MotionReader::Track::at(double time_s) const {
    size_t after = size_t(std::upper_bound(times_s.begin(), times_s.end(), time_s) - times_s.begin());
    size_t before = after > 0 ? after - 1 : 0;
    after = std::min(after, times_s.size() - 1);
    size_t each = way == Channel::Way::cubic ? 3 : 1, value = each / 3;
    double span_s = times_s[after] - times_s[before];
    double t = span_s > 0 ? std::clamp((time_s - times_s[before]) / span_s, 0.0, 1.0) : 0;
    const glm::dvec4 &a = values[each * before + value], &b = values[each * after + value];
    if (way == Channel::Way::step || span_s <= 0) return a;
    if (way == Channel::Way::linear) return is_rotation ? slerp(a, b, t) : glm::mix(a, b, t);
    const glm::dvec4 &leaving = values[3 * before + 2], &coming = values[3 * after];
    double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * span_s * leaving + (3 * t2 - 2 * t3) * b + (t3 - t2) * span_s * coming;
}

Result<MotionReader::Track> MotionReader::read_track(const Channel& channel, size_t number) {
    auto times = accessors_.attribute(channel.times, 1, 1);
    if (!times) return tl::unexpected(times.error());
    uint32_t width = channel.is_rotation ? 4 : 3;
    auto values = accessors_.attribute(channel.values, width, width);
    if (!values) return tl::unexpected(values.error());
    Track track{channel.is_rotation, channel.way, {}, {}};
    size_t each = channel.way == Channel::Way::cubic ? 3 : 1;
    if (times->size() == 0 || values->size() != each * times->size())
        return bad_input("{}: animation channel {} has {} values for {} times", name_, number, values->size(), times->size());
    for (size_t i = 0; i < times->size(); ++i) {
        double time_s = (*times)[i].x;
        if (!(time_s >= 0 && time_s <= 1e6) || (i > 0 && !(time_s > track.times_s.back())))
            return bad_input("{}: animation channel {} has key {} at {} s, which is no time after the one before", name_, number,
                             i, time_s);
        track.times_s.push_back(time_s);
    }
    for (size_t i = 0; i < values->size(); ++i) {
        glm::dvec4 value = (*values)[i];
        if (!std::isfinite(value.x + value.y + value.z + value.w))
            return bad_input("{}: animation channel {} has a value {} that is not finite", name_, number, i);
        track.values.push_back(value);
    }
    return track;
}

Result<void> MotionReader::read() {
    if (document_.channels.empty()) return {};
    tracks_.resize(document_.nodes.size());
    for (size_t i = 0; i < document_.channels.size(); ++i) {
        auto track = read_track(document_.channels[i], i);
        if (!track) return tl::unexpected(track.error());
        clip_s_ = std::max(clip_s_, track->times_s.back());
        tracks_[document_.channels[i].node].push_back(std::move(*track));
    }
    if (clip_s_ <= 0) tracks_.clear();
    return {};
}

glm::dmat4 MotionReader::transform_at(uint32_t node, double time_s) const {
    const Node& n = document_.nodes[node];
    if (!moves(node)) return n.transform;
    glm::dvec3 translation = n.translation;
    glm::dquat rotation = n.rotation;
    for (const Track& track : tracks_[node]) {
        glm::dvec4 value = track.at(time_s);
        if (track.is_rotation)
            rotation = quat_of(value);
        else
            translation = glm::dvec3(value);
    }
    return glm::scale(glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation), n.scale);
}

glm::dmat4 MotionReader::world_at(const std::vector<uint32_t>& ancestors, double time_s) const {
    glm::dmat4 world(1);
    for (uint32_t node : ancestors) world *= transform_at(node, time_s);
    return world;
}

std::vector<double> MotionReader::times_of(const std::vector<uint32_t>& ancestors) const {
    std::vector<double> times_s{0, clip_s_};
    for (uint32_t node : ancestors)
        for (const Track& track : tracks_[node])
            for (size_t i = 0; i < track.times_s.size(); ++i) {
                double time_s = track.times_s[i];
                times_s.push_back(time_s);
                if (track.way == Channel::Way::step && i > 0 && time_s - kStep_s > track.times_s[i - 1])
                    times_s.push_back(time_s - kStep_s);
            }
    std::sort(times_s.begin(), times_s.end());
    // Keys are floats: what they cannot tell apart is one.
    times_s.erase(std::unique(times_s.begin(), times_s.end(), [](double a, double b) { return float(a) == float(b); }),
                  times_s.end());
    return times_s;
}

// What leads from rest to there: world(t) * world(rest)^-1, about the place of the node at rest.
bool MotionReader::key_at(const std::vector<uint32_t>& ancestors, double time_s, Motion::Key& key) const {
    glm::dmat4 rest(1);
    for (uint32_t node : ancestors) rest *= document_.nodes[node].transform;
    if (std::abs(glm::determinant(rest)) < 1e-12) return false;
    glm::dmat4 moved = world_at(ancestors, time_s) * glm::inverse(rest);
    if (!is_rigid(glm::dmat3(moved))) return false;
    key.at_s = time_s;
    key.turn = glm::normalize(glm::quat_cast(glm::dmat3(moved)));
    glm::dvec3 pivot(rest[3]);
    key.move_m = glm::dvec3(moved * glm::dvec4(pivot, 1)) - pivot;
    return true;
}

// Adds keys between two until what lies a quarter of the way, three quarters and half of it is where it should be: of one cubic
// span, whose deviation is t (1 - t) (a + b t), two places tell a and b. The middle alone does not: there an even ease crosses
// the straight way.
bool MotionReader::refine(const std::vector<uint32_t>& ancestors, const Motion::Key& before, const Motion::Key& after, int depth,
                          std::vector<Motion::Key>& keys) const {
    Motion::Key middle;
    bool is_near = true;
    for (double share : {0.25, 0.75, 0.5}) {
        if (!key_at(ancestors, glm::mix(before.at_s, after.at_s, share), middle)) return false;
        double cosine = std::abs(glm::dot(glm::slerp(before.turn, after.turn, share), middle.turn));
        glm::dvec3 off = glm::mix(before.move_m, after.move_m, share) - middle.move_m;
        is_near = is_near && 2 * std::acos(std::min(1.0, cosine)) <= kTurnSlack_rad &&
                  glm::length(off) <= kMoveSlack * (glm::length(after.move_m - before.move_m) + 1e-6);
    }
    // A turn of nearly half a circle could go either way.
    bool is_short = std::abs(glm::dot(before.turn, after.turn)) > 0.5;
    bool is_apart = float(middle.at_s) > float(before.at_s) && float(middle.at_s) < float(after.at_s);
    if ((is_near && is_short) || depth >= kDeepest || !is_apart || keys.size() >= kMostKeys) return true;
    if (!refine(ancestors, before, middle, depth + 1, keys)) return false;
    keys.push_back(middle);
    return refine(ancestors, middle, after, depth + 1, keys);
}

std::optional<Motion::Part> MotionReader::part_of(const std::vector<uint32_t>& ancestors, size_t part_count,
                                                  std::vector<std::string>& notes) const {
    const uint32_t node = ancestors.back();
    Motion::Part part;
    part.name = document_.nodes[node].name.empty() ? fmt::format("node-{}", node) : document_.nodes[node].name;
    glm::dmat4 rest(1);
    for (uint32_t ancestor : ancestors) rest *= document_.nodes[ancestor].transform;
    part.pivot_m = glm::dvec3(rest[3]);
    bool is_right = ancestors.size() <= kMostAncestors && part_count < kMostParts;
    for (double time_s : is_right ? times_of(ancestors) : std::vector<double>()) {
        Motion::Key key;
        is_right = is_right && part.keys.size() < kMostKeys && key_at(ancestors, time_s, key);
        if (!is_right) break;
        if (!part.keys.empty()) is_right = refine(ancestors, Motion::Key(part.keys.back()), key, 0, part.keys);
        part.keys.push_back(key);
    }
    if (is_right) return part;
    notes.push_back(fmt::format("{}: node {} ({}) does not move rigidly, or is one of too many, or of too many keys; it rests",
                                name_, node, part.name));
    return std::nullopt;
}

}  // namespace overlook::mesh::gltf
