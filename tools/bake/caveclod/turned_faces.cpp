#include "tools/bake/caveclod/turned_faces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

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

bool is_turned(const TriangleTree& source, const Triangle& face, double slack_m, uint32_t guess) {
    glm::dvec3 normal = normal_of(face);
    double length = glm::length(normal), sum = 0;
    if (!(length > 0)) return false;
    normal /= length;
    auto place = [&](size_t i) { return face[0] * kPlaces[i].x + face[1] * kPlaces[i].y + face[2] * kPlaces[i].z; };
    std::array<bool, kPlaces.size()> is_ahead{};  // the nearest source faces the face, by however much
    std::array<double, kPlaces.size()> facing{};
    size_t behind_count = kPlaces.size();  // may be as little as -1
    for (size_t i = 0; i < kPlaces.size(); ++i, --behind_count) {
        if (sum >= double(behind_count)) return false;
        is_ahead[i] = guess != kNoGuess && source.nearest_face(place(i), normal, slack_m, guess);
        if (is_ahead[i]) continue;
        facing[i] = source.facing_of_nearest(place(i), normal, slack_m, guess);
        sum += facing[i];
    }
    if (sum >= 0) return false;
    for (size_t i = 0; i < kPlaces.size(); ++i)
        if (is_ahead[i]) facing[i] = source.facing_of_nearest(place(i), normal, slack_m, guess);
    return std::accumulate(facing.begin(), facing.end(), 0.0) < 0;
}

size_t first_turned(const TriangleTree& source, std::span<const Triangle> faces, double away_m, double slack_m,
                    std::span<const uint32_t> guesses) {
    double reach_m = away_m * (1 + kSlackShare) + 3 * slack_m;
    if (is_plain(source, faces, reach_m)) return faces.size();
    for (size_t i = 0; i < faces.size(); ++i) {
        if (is_plain(source, faces.subspan(i, 1), reach_m)) continue;
        if (is_turned(source, faces[i], slack_m, guesses.empty() ? kNoGuess : guesses[i])) return i;
    }
    return faces.size();
}

double turn_slack_m(std::span<const glm::vec3> positions_m) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::vec3& p : positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return positions_m.empty() ? 0 : kSlackShare * glm::length(high - low);
}

}  // namespace overlook::caveclod
