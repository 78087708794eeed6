// How large the pictures on a mesh are.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::mesh {

// [surfaces] width and height of each one's texture; caveclod::kTextureSize_px both where it has none that can be read. Fails
// where the library of pictures cannot be opened (images.h).
Result<std::vector<glm::dvec2>> texture_sizes_px(const Mesh& mesh);

}  // namespace overlook::mesh
