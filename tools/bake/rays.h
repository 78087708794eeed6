// Rays against many copies of triangle meshes, through Embree, whose only source file in the bakers is rays.cpp.
//
// Based on: I. Wald, S. Woop, C. Benthin, G. S. Johnson, M. Ernst, Embree: A Kernel Framework for Efficient CPU Ray Tracing,
// 2014.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "formats/result.h"

namespace overlook::rays {

constexpr uint32_t kNone = 0xffffffff;
constexpr size_t kPacket = 16;

// Where a surface is: texels of an opacity below `least` are holes. Repeats; (0, 0) is the first texel of the first row.
struct Mask {
    uint32_t width_px = 0, height_px = 0;
    std::vector<uint8_t> opacity;  // [height, width]
    uint16_t least = 128;          // above 255: holes all over
};

struct Mesh {
    std::vector<glm::vec3> positions_m;
    std::vector<std::array<uint32_t, 3>> triangles;  // [T] indices of positions_m
    // Both [T], or empty where nothing has holes.
    std::vector<std::array<glm::vec2, 3>> uvs;
    std::vector<uint32_t> masks_of;  // of masks, or kNone
    std::vector<Mask> masks;
};
// Whether a triangle is there at barycentric (u, v), those of its second and third corner.
bool is_solid(const Mesh& mesh, uint32_t triangle, float u, float v);

// A copy of a mesh: place * position.
struct Copy {
    uint32_t mesh = 0;
    glm::mat4x3 place{1};
};

struct Ray {
    glm::vec3 from_m{0}, along{0};  // along: of any length but 0; distances count in it
    float nearest = 0, farthest = INFINITY;
};
struct Hit {
    uint32_t copy = kNone, triangle = 0;  // copy kNone: nothing is hit
    float distance = INFINITY;
    float u = 0, v = 0;  // barycentric, of the triangle's second and third corner
};

// How copies are kept: each with triangles of its own (a half faster), or as instances of one tree for each mesh (little memory).
enum class Layout { flattened, instances };

// Which of a processor's instructions are used: the best that it has, or those that all have, so that a ray hits the same on
// every one, to the last bit, that estimates reciprocals alike: Embree refines what rcpps says, which SSE leaves to the maker.
enum class Instructions { best, everywhere };
// "everywhere", or which are the best of this processor: "avx512", "avx2", "avx", "sse4.2" or "sse2".
std::string_view name_of(Instructions instructions);

// What a flattened layout of these copies takes about, in bytes (Embree 3.13: 110 to 130 a triangle).
uint64_t flattened_bytes(std::span<const Mesh> meshes, std::span<const Copy> copies);

// Copies of meshes that rays are asked of. Built by one thread, so that what is hit where surfaces touch does not hang on the
// number of threads; asked by any number. The meshes must outlive it.
class Scene {
  public:
    // Fails with Exit::impossible: "Embree cannot build 12 copies of meshes: ..." with its reason.
    static Result<Scene> build(std::span<const Mesh> meshes, std::span<const Copy> copies, Layout layout,
                               Instructions instructions = Instructions::best);
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    // The first solid surface along each ray, in packets of rays that go about the same way (kPacket at once; hits.size() is
    // rays.size()). Watertight.
    void first_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
    // The nearest along a ray that is solid and accepted.
    Hit first_accepted(const Ray& ray, const std::function<bool(const Hit&)>& accept) const;
    // Whether anything solid is along each ray; these may go any way.
    void are_blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const;
    // All solid surfaces along a ray, the nearest first; one that Embree reports twice counts once.
    std::vector<Hit> all_hits(const Ray& ray) const;

  private:
    struct Parts;
    explicit Scene(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace overlook::rays
