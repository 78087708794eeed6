// make-sample trees, windmills and simple: the scenes of Scherzer and Wimmer 2008, section 4, ready to be baked with
// bake-lod discrete.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook::sample {

struct InstancesOptions {
    uint64_t seed = 1;
    uint32_t count = 4000;  // of things that stand about, 1..100000
};
constexpr uint32_t kSimpleCount = 400;

// Writes into a folder, which it makes where there is none, and returns the paths:
//   trees      tree-0.glb (about 93,000 triangles) to tree-4.glb (5,000), plain.glb
//   windmills  windmill-0.glb (18,000) to windmill-3.glb (100), plain.glb
//   simple     simple-0.glb (a red sphere), simple-1.glb (a blue cube), plain.glb
// and of each scene.json (of NAME.ovl and plain.ovl, to be baked beside it; its instances stand scattered over a plain),
// flight.json, README.md with the commands. Fails with Exit::cannot_write.
Result<std::vector<std::string>> make_instances(const std::string& name, const InstancesOptions& options,
                                                const std::string& folder);

}  // namespace overlook::sample
