#include "tools/bake/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "formats/parallel.h"

namespace overlook::rays {
namespace {

constexpr uint64_t kBytesPerTriangle = 130;

// Embree asks whether what it met counts: holes do not.
void skip_holes(const RTCFilterFunctionNArguments* args) {
    const Mesh& mesh = *static_cast<const Mesh*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        uint32_t triangle = RTCHitN_primID(args->hit, args->N, i);
        if (!is_solid(mesh, triangle, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i))) args->valid[i] = 0;
    }
}

// Collects what a ray meets, and has it go on.
struct Collector {
    RTCIntersectContext context;
    std::vector<Hit>* hits;
};
// Has a ray go on where what it meets is not accepted.
struct Chooser {
    RTCIntersectContext context;
    const std::function<bool(const Hit&)>* accept;
};

// What a filter is asked about, of one ray.
Hit hit_of(const RTCFilterFunctionNArguments* args) {
    unsigned instance = RTCHitN_instID(args->hit, 1, 0, 0);
    unsigned copy = instance == RTC_INVALID_GEOMETRY_ID ? RTCHitN_geomID(args->hit, 1, 0) : instance;
    return {copy, RTCHitN_primID(args->hit, 1, 0), RTCRayN_tfar(args->ray, 1, 0), RTCHitN_u(args->hit, 1, 0),
            RTCHitN_v(args->hit, 1, 0)};
}

RTCRayHit one_ray(const Ray& ray) {
    RTCRayHit one{};
    one.ray.org_x = ray.from_m.x, one.ray.org_y = ray.from_m.y, one.ray.org_z = ray.from_m.z;
    one.ray.dir_x = ray.along.x, one.ray.dir_y = ray.along.y, one.ray.dir_z = ray.along.z;
    one.ray.tnear = ray.nearest, one.ray.tfar = ray.farthest, one.ray.mask = 0xffffffff;
    one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return one;
}

glm::vec3 placed(const glm::mat4x3& place, const glm::vec3& position) {
    return place * glm::vec4(position, 1);
}

// Of Embree's own memory, which has room behind the last: it reads 16 bytes at each.
float* new_positions(RTCGeometry geometry, size_t count) {
    return static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
}

RTCGeometry new_triangles(RTCDevice device, const Mesh& mesh, const glm::mat4x3& place) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float* positions = new_positions(geometry, mesh.positions_m.size());
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(uint32_t), mesh.triangles.size()));
    if (positions == nullptr || indices == nullptr) return geometry;  // the device says why
    for (size_t p = 0; p < mesh.positions_m.size(); ++p) {
        glm::vec3 at = placed(place, mesh.positions_m[p]);
        for (size_t axis = 0; axis < 3; ++axis) positions[3 * p + axis] = at[int(axis)];
    }
    if (!mesh.triangles.empty()) std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(uint32_t));
    if (!mesh.masks_of.empty()) {
        rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
        rtcSetGeometryIntersectFilterFunction(geometry, skip_holes);
        rtcSetGeometryOccludedFilterFunction(geometry, skip_holes);
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitGeometry(geometry);
    return geometry;
}

RTCScene new_scene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);  // of high quality, filters see a triangle more than once
    rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    return scene;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id) {
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

const char* reason_of(RTCError error) {
    switch (error) {
        case RTC_ERROR_OUT_OF_MEMORY:
            return "there is not enough memory";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "this processor lacks SSE2";
        default:
            return "it refuses them";
    }
}

template <class Packet>
void set_ray(Packet& packet, size_t i, const Ray& ray) {
    packet.org_x[i] = ray.from_m.x, packet.org_y[i] = ray.from_m.y, packet.org_z[i] = ray.from_m.z;
    packet.dir_x[i] = ray.along.x, packet.dir_y[i] = ray.along.y, packet.dir_z[i] = ray.along.z;
    packet.tnear[i] = ray.nearest, packet.tfar[i] = ray.farthest;
    packet.time[i] = 0, packet.mask[i] = 0xffffffff, packet.id[i] = unsigned(i), packet.flags[i] = 0;
}

}  // namespace

struct Scene::Parts {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<RTCScene> of_meshes;
    bool has_instances = false;

    ~Parts() {
        if (scene) rtcReleaseScene(scene);
        for (RTCScene mesh : of_meshes) rtcReleaseScene(mesh);
        if (device) rtcReleaseDevice(device);
    }
    void flatten(std::span<const Mesh> meshes, std::span<const Copy> copies);
    void instance(std::span<const Mesh> meshes, std::span<const Copy> copies);
    uint32_t copy_of(unsigned geometry, unsigned instance) const { return has_instances ? instance : geometry; }
};

void Scene::Parts::flatten(std::span<const Mesh> meshes, std::span<const Copy> copies) {
    for (size_t c = 0; c < copies.size(); ++c)
        attach(scene, new_triangles(device, meshes[copies[c].mesh], copies[c].place), unsigned(c));
}

void Scene::Parts::instance(std::span<const Mesh> meshes, std::span<const Copy> copies) {
    has_instances = true;
    for (const Mesh& mesh : meshes) {
        of_meshes.push_back(new_scene(device));
        attach(of_meshes.back(), new_triangles(device, mesh, glm::mat4x3(1)), 0);
        rtcCommitScene(of_meshes.back());
    }
    for (size_t c = 0; c < copies.size(); ++c) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, of_meshes[copies[c].mesh]);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &copies[c].place[0][0]);
        rtcCommitGeometry(geometry);
        attach(scene, geometry, unsigned(c));
    }
}

bool is_solid(const Mesh& mesh, uint32_t triangle, float u, float v) {
    if (mesh.masks_of.empty() || mesh.masks_of[triangle] == kNone) return true;
    const Mask& mask = mesh.masks[mesh.masks_of[triangle]];
    const auto& corners = mesh.uvs[triangle];
    glm::vec2 at = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
    auto texel = [](float place, uint32_t count) {
        float whole = std::floor((place - std::floor(place)) * float(count));
        return whole >= 0 ? std::min(uint32_t(whole), count - 1) : 0u;
    };
    size_t column = texel(at.x, mask.width_px), row = texel(at.y, mask.height_px);
    return mask.opacity[row * mask.width_px + column] >= mask.least;
}

// Embree takes those that its build and the processor have: packets of 16 at once by AVX-512, of 8 by AVX.
std::string_view name_of(Instructions instructions) {
    if (instructions == Instructions::everywhere) return "everywhere";
    RTCDevice device = rtcNewDevice("");
    bool has_16 = device && rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    bool has_8 = device && rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
    if (device) rtcReleaseDevice(device);
    if (has_16) return "avx512";
    if (has_8) return __builtin_cpu_supports("avx2") ? "avx2" : "avx";
    return __builtin_cpu_supports("sse4.2") ? "sse4.2" : "sse2";
}

uint64_t flattened_bytes(std::span<const Mesh> meshes, std::span<const Copy> copies) {
    uint64_t bytes = 0;
    for (const Copy& copy : copies) {
        const Mesh& mesh = meshes[copy.mesh];
        bytes += kBytesPerTriangle * mesh.triangles.size() + 12 * (mesh.positions_m.size() + mesh.triangles.size());
    }
    return bytes;
}

Scene::Scene(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Result<Scene> Scene::build(std::span<const Mesh> meshes, std::span<const Copy> copies, Layout layout, Instructions instructions) {
    auto parts = std::make_unique<Parts>();
    // Not by "threads=1", which would leave one thread to all of the program while the device is there.
    by_one_thread([&] {
        parts->device = rtcNewDevice(instructions == Instructions::best ? "" : "isa=sse2,max_isa=sse2");
        if (!parts->device) return;
        parts->scene = new_scene(parts->device);
        if (layout == Layout::flattened)
            parts->flatten(meshes, copies);
        else
            parts->instance(meshes, copies);
        rtcCommitScene(parts->scene);
    });
    if (!parts->device) return impossible("Embree cannot begin: {}", reason_of(rtcGetDeviceError(nullptr)));
    if (RTCError error = rtcGetDeviceError(parts->device); error != RTC_ERROR_NONE)
        return impossible("Embree cannot build {} copies of meshes: {}", copies.size(), reason_of(error));
    return Scene(std::move(parts));
}

void Scene::first_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int valid[kPacket];
    alignas(64) RTCRayHit16 packet;
    for (size_t first = 0; first < rays.size(); first += kPacket) {
        size_t count = std::min(kPacket, rays.size() - first);
        for (size_t i = 0; i < kPacket; ++i) {
            valid[i] = i < count ? -1 : 0;
            set_ray(packet.ray, i, rays[first + std::min(i, count - 1)]);
            packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, parts_->scene, &context, &packet);
        for (size_t i = 0; i < count; ++i) {
            Hit& hit = hits[first + i];
            hit = {};
            if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            hit = {parts_->copy_of(packet.hit.geomID[i], packet.hit.instID[0][i]), packet.hit.primID[i], packet.ray.tfar[i],
                   packet.hit.u[i], packet.hit.v[i]};
        }
    }
}

void Scene::are_blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    alignas(64) int valid[kPacket];
    alignas(64) RTCRay16 packet;
    for (size_t first = 0; first < rays.size(); first += kPacket) {
        size_t count = std::min(kPacket, rays.size() - first);
        for (size_t i = 0; i < kPacket; ++i) {
            valid[i] = i < count ? -1 : 0;
            set_ray(packet, i, rays[first + std::min(i, count - 1)]);
        }
        rtcOccluded16(valid, parts_->scene, &context, &packet);
        for (size_t i = 0; i < count; ++i) blocked[first + i] = packet.tfar[i] < 0;
    }
}

Hit Scene::first_accepted(const Ray& ray, const std::function<bool(const Hit&)>& accept) const {
    Chooser chooser;
    rtcInitIntersectContext(&chooser.context);
    chooser.accept = &accept;
    chooser.context.filter = [](const RTCFilterFunctionNArguments* args) {
        if (args->valid[0] == -1 && !(*reinterpret_cast<Chooser*>(args->context)->accept)(hit_of(args))) args->valid[0] = 0;
    };
    alignas(16) RTCRayHit one = one_ray(ray);
    rtcIntersect1(parts_->scene, &chooser.context, &one);
    if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {parts_->copy_of(one.hit.geomID, one.hit.instID[0]), one.hit.primID, one.ray.tfar, one.hit.u, one.hit.v};
}

std::vector<Hit> Scene::all_hits(const Ray& ray) const {
    std::vector<Hit> hits;
    Collector collector;
    rtcInitIntersectContext(&collector.context);
    collector.hits = &hits;
    collector.context.filter = [](const RTCFilterFunctionNArguments* args) {
        if (args->valid[0] != -1) return;
        reinterpret_cast<Collector*>(args->context)->hits->push_back(hit_of(args));
        args->valid[0] = 0;
    };
    alignas(16) RTCRayHit one = one_ray(ray);
    rtcIntersect1(parts_->scene, &collector.context, &one);

    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return std::tie(a.distance, a.copy, a.triangle) < std::tie(b.distance, b.copy, b.triangle);
    });
    auto is_same = [](const Hit& a, const Hit& b) { return a.copy == b.copy && a.triangle == b.triangle; };
    hits.erase(std::unique(hits.begin(), hits.end(), is_same), hits.end());
    return hits;
}

}  // namespace overlook::rays
