#include "tools/bake/mesh_textures.h"

#include <span>

#include "tools/bake/caveclod/seam_error.h"
#include "tools/bake/images.h"

namespace overlook::mesh {

Result<std::vector<glm::dvec2>> texture_sizes_px(const Mesh& mesh) {
    std::vector<glm::dvec2> sizes_px;
    for (const Surface& surface : mesh.surfaces) {
        auto size = picture_size(surface.texture, std::as_bytes(std::span(surface.texture_bytes)));
        if (!size) return tl::unexpected(size.error());
        sizes_px.push_back(*size ? glm::dvec2((*size)->width_px, (*size)->height_px) : glm::dvec2(caveclod::kTextureSize_px));
    }
    return sizes_px;
}

}  // namespace overlook::mesh
