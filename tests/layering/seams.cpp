// The seams: where each heavy dependency is included, one source file to a room. Who adds a dependency adds its line.
#include "tests/layering/layering.h"

namespace overlook::layering {

std::span<const Seam> seams() {
    static const std::vector<Seam> kSeams = {
        {"Embree", {"embree"}, {"tools/bake/rays.cpp"}},
        {"OpenMesh", {"OpenMesh/"}, {"tools/bake/caveclod/openmesh_topology.cpp"}},
        {"CGAL", {"CGAL/"}, {"tools/bake/cgal/self_intersections.cpp"}},
        {"Draco", {"draco/"}, {"formats/draco_codec.cpp", "tools/bake/mesh/gltf_draco.cpp"}},
        {"meshoptimizer", {"meshoptimizer.h"}, {"formats/meshopt_codec.cpp", "tools/bake/mesh/gltf_meshopt.cpp"}},
        {"OpenImageIO", {"OpenImageIO/"}, {"tools/bake/image_library.cpp"}},
        {"GeographicLib", {"GeographicLib/"}, {"tools/bake/georeference.cpp"}},
        {"tinygltf", {"tiny_gltf.h"}, {"tools/baked/glb.cpp"}},
        {"toml++", {"toml++/", "toml.hpp"}, {"tools/bake/wang_ldi/toml_table.cpp"}},
        {"oneTBB", {"tbb/", "oneapi/"}, {"formats/parallel.cpp"}},
        {"zstd", {"zstd.h"}, {"formats/compression.cpp"}},
        {"libspng", {"spng.h"}, {"runtime/gl/png.cpp"}},
        {"GLFW", {"GLFW/"}, {"runtime/player/window.cpp"}},
        {"EGL", {"EGL/", "epoxy/egl.h"}, {"runtime/gl/context.cpp"}},
        {"Dear ImGui", {"imgui"}, {"runtime/player/overlay.cpp"}},
        {"xxHash", {"xxhash.h"}, {}, true},
        {"nlohmann-json", {"nlohmann/"}, {}, true},
    };
    return kSeams;
}

}  // namespace overlook::layering
