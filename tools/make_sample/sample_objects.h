// make-sample vase and masts: meshes of one object, for what is shown of outlines and of thin things.
#pragma once

#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/scene.h"
#include "tools/bake/mesh.h"

namespace overlook::sample {

// A vase with flutes that turn round it, 3 m high, closed: 98,304 triangles round the origin, z up. The object of case S09.
mesh::Mesh vase_mesh();
// Once round it at 4.5 m, a little from above, in 24 s.
scene::Flight vase_flight();

// Rolling ground 128 m wide round the origin with twelve masts, 15 m high and 0.3 m thick, and between them a railing, its posts
// 1.2 m high and 0.06 m thick. The surface "ground" is green, "mast" a red that nothing else has. Case S10.
mesh::Mesh masts_mesh();
// Past them from 110 m to 25 m, turning a little, in 8 s.
scene::Flight masts_flight();

// Writes NAME.obj, NAME.mtl, flight.json and scene.json (of NAME.ovl, to be baked beside it) into a folder, which it makes where
// there is none. Returns their paths. name: "vase" or "masts". Fails with Exit::cannot_write.
Result<std::vector<std::string>> make_object(const std::string& name, const std::string& folder);

}  // namespace overlook::sample
