#include "tools/bake/discrete/ray_scene.h"

#include <embree3/rtcore.h>

#include <limits>

namespace overlook::discrete {
namespace {

// What a filter finds of the ray that it is asked about: Embree hands the context through.
struct Context {
    RTCIntersectContext embree;
    const AcceptHit* accept = nullptr;
};

void filter(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = reinterpret_cast<const Context*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        float second = RTCHitN_u(arguments->hit, arguments->N, i), third = RTCHitN_v(arguments->hit, arguments->N, i);
        if (!(*context->accept)(RTCHitN_primID(arguments->hit, arguments->N, i), second, third)) arguments->valid[i] = 0;
    }
}

}  // namespace

struct RayScene::Trees {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    glm::dvec3 middle_m{0};

    ~Trees() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

RayScene::RayScene(std::span<const caveclod::Triangle> triangles) : trees_(std::make_unique<Trees>()) {
    if (triangles.empty()) return;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const caveclod::Triangle& t : triangles)
        for (const glm::dvec3& p : t) low = glm::min(low, p), high = glm::max(high, p);
    trees_->middle_m = (low + high) / 2.0;
    trees_->device = rtcNewDevice("threads=1,isa=sse2,max_isa=sse2,set_affinity=0");
    trees_->scene = rtcNewScene(trees_->device);
    rtcSetSceneFlags(trees_->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(trees_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * triangles.size()));
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangles.size()));
    uint32_t next = 0;
    for (const caveclod::Triangle& t : triangles)
        for (const glm::dvec3& p : t) {
            for (int axis = 0; axis < 3; ++axis) *vertices++ = float(p[axis] - trees_->middle_m[axis]);
            *indices++ = next++;
        }
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(trees_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(trees_->scene);
}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

RayHit RayScene::first(const glm::dvec3& from, const glm::dvec3& direction, double far_m, const AcceptHit& accept) const {
    if (trees_->scene == nullptr) return {};
    Context context;
    rtcInitIntersectContext(&context.embree);
    context.accept = &accept;
    glm::vec3 at(from - trees_->middle_m), along(direction);
    RTCRayHit ray{};
    ray.ray.org_x = at.x, ray.ray.org_y = at.y, ray.ray.org_z = at.z;
    ray.ray.dir_x = along.x, ray.ray.dir_y = along.y, ray.ray.dir_z = along.z;
    ray.ray.tnear = 0, ray.ray.tfar = float(far_m), ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(trees_->scene, &context.embree, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {ray.hit.primID, ray.hit.u, ray.hit.v, double(ray.ray.tfar)};
}

}  // namespace overlook::discrete
