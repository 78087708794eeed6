// Any bytes as a mesh: a reader refuses them, or what it gives is repaired into a mesh that keeps every law and loses no face.
// Nothing may crash, leak or take memory without bound. Each target names its reader.
#pragma once

#include <cstdint>
#include <span>

#include "tools/bake/mesh/soup.h"
#include "tools/bake/mesh_repair.h"

namespace overlook::mesh {

inline int fuzz_reader(Result<Soup> (*reader)(const InputFile&), const uint8_t* data, size_t size) {
    const InputFile file{std::as_bytes(std::span(data, size)), "fuzz", "/nonexistent/", {}};
    Result<Soup> soup = reader(file);
    if (!soup) return 0;
    const Result<MeshFile> mesh = finish(std::move(*soup), file);
    if (!mesh) return 0;
    if (!first_fault(mesh->mesh).empty()) __builtin_trap();
    if (mesh->report.triangle_count != mesh->mesh.faces.size() + mesh->report.dropped.size()) __builtin_trap();
    return 0;
}

}  // namespace overlook::mesh
