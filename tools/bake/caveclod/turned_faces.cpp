#include "tools/bake/caveclod/turned_faces.h"

#include <algorithm>
#include <array>
#include <limits>

namespace overlook::caveclod {
namespace {

constexpr double kSlackShare = 1e-6;
constexpr size_t kMostAtOnce = 32;

// Weights of the corners.
const std::array<glm::dvec3, 7> kPlaces{glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(4, 1, 1) / 6.0, glm::dvec3(1, 4, 1) / 6.0,
                                        glm::dvec3(1, 1, 4) / 6.0, glm::dvec3(2, 2, 1) / 5.0, glm::dvec3(2, 1, 2) / 5.0,
                                        glm::dvec3(1, 2, 2) / 5.0};

glm::dvec3 normal_of(const Triangle& t) {
    return glm::cross(t[1] - t[0], t[2] - t[0]);
}

// All the source that can be nearest to a place on one of the faces faces all of them.
bool is_plain(const TriangleTree& source, std::span<const Triangle> faces, double away_m) {
    std::array<glm::vec3, kMostAtOnce> directions;
    if (faces.size() > kMostAtOnce) return false;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (size_t i = 0; i < faces.size(); ++i) {
        glm::dvec3 normal = normal_of(faces[i]);
        double length = glm::length(normal);
        if (!(length > 0)) return false;
        directions[i] = glm::vec3(normal / length);
        for (const glm::dvec3& p : faces[i]) low = glm::min(low, p), high = glm::max(high, p);
    }
    return source.all_face(glm::vec3(low - away_m), glm::vec3(high + away_m), std::span(directions).first(faces.size()));
}

}  // namespace

bool is_turned(const TriangleTree& source, const Triangle& face, double slack_m) {
    glm::dvec3 normal = normal_of(face);
    double length = glm::length(normal), sum = 0;
    if (!(length > 0)) return false;
    for (size_t i = 0; i < kPlaces.size(); ++i) {
        const glm::dvec3& w = kPlaces[i];
        sum += source.facing_of_nearest(face[0] * w.x + face[1] * w.y + face[2] * w.z, normal / length, slack_m);
        if (sum >= double(kPlaces.size() - 1 - i)) return false;  // whatever the places left say
    }
    return sum < 0;
}

bool none_is_turned(const TriangleTree& source, std::span<const Triangle> faces, double away_m, double slack_m) {
    double reach_m = away_m * (1 + kSlackShare) + 3 * slack_m;
    if (is_plain(source, faces, reach_m)) return true;
    return std::all_of(faces.begin(), faces.end(), [&](const Triangle& face) {
        return is_plain(source, std::span(&face, 1), reach_m) || !is_turned(source, face, slack_m);
    });
}

double turn_slack_m(std::span<const glm::vec3> positions_m) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::vec3& p : positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return positions_m.empty() ? 0 : kSlackShare * glm::length(high - low);
}

}  // namespace overlook::caveclod
