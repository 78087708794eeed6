// A mesh from a file as a model that images are sampled from.
#pragma once

#include <optional>

#include "formats/result.h"
#include "tools/bake/mesh.h"
#include "tools/bake/wang_ldi/skins.h"
#include "tools/bake/wang_ldi/trim.h"

namespace overlook::wang_ldi {

struct ModelOptions {
    float leaf_transmission = 0.35f;  // of two-sided surfaces, what they let through; 0..1
    bool trims_leaves = true;         // by trim_to_masks
    // Of all surfaces, in place of their own.
    std::optional<float> roughness{}, metallic{};
};

// Adds a mesh to the models: its triangles, normals (where the file has them), colours and textures; alpha-masked texels are
// holes. Textures that cannot be decoded fail with Exit::bad_input: "leaf.png: ..."; a missing one is left out, as if it were
// white.
// What is trimmed is added to `trimmed`, if there is one.
Result<void> add_model(const mesh::Mesh& mesh, const ModelOptions& options, Models& models, TrimReport* trimmed = nullptr);

}  // namespace overlook::wang_ldi
