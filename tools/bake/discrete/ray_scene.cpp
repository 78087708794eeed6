#include "tools/bake/discrete/ray_scene.h"

#include <limits>
#include <new>
#include <optional>

#include "tools/bake/rays.h"

namespace overlook::discrete {

struct RayScene::Trees {
    std::vector<rays::Mesh> meshes;  // one, which the scene looks at
    std::optional<rays::Scene> scene;
    glm::dvec3 middle_m{0};
};

RayScene::RayScene(std::span<const caveclod::Triangle> triangles) : trees_(std::make_unique<Trees>()) {
    if (triangles.empty()) return;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const caveclod::Triangle& t : triangles)
        for (const glm::dvec3& p : t) low = glm::min(low, p), high = glm::max(high, p);
    trees_->middle_m = (low + high) / 2.0;
    rays::Mesh& mesh = trees_->meshes.emplace_back();
    for (const caveclod::Triangle& t : triangles) {
        auto first = uint32_t(mesh.positions_m.size());
        for (const glm::dvec3& p : t) mesh.positions_m.emplace_back(p - trees_->middle_m);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const rays::Copy whole[] = {{}};
    Result<rays::Scene> built = rays::Scene::build(trees_->meshes, whole, rays::Layout::flattened, rays::Instructions::everywhere);
    if (!built) throw std::bad_alloc();  // all that Embree can lack, as any container
    trees_->scene.emplace(std::move(*built));
}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

RayHit RayScene::first(const glm::dvec3& from, const glm::dvec3& direction, double far_m, const AcceptHit& accept) const {
    if (!trees_->scene) return {};
    rays::Ray ray{glm::vec3(from - trees_->middle_m), glm::vec3(direction), 0, float(far_m)};
    rays::Hit hit = trees_->scene->first_accepted(ray, [&](const rays::Hit& met) { return accept(met.triangle, met.u, met.v); });
    if (hit.copy == rays::kNone) return {};
    return {hit.triangle, hit.u, hit.v, double(hit.distance)};
}

}  // namespace overlook::discrete
