// The methods of what is read in parts while it is flown over: terrains in tiles, meshes in blocks.
#pragma once

#include <array>
#include <memory>

#include "formats/setting.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// What they have beside the settings of the same thing whole: room for blocks, 2^20 bytes, and frames of the logical clock from
// asking for a block until it is there, whatever the worker's speed.
inline constexpr std::array<SettingKind, 2> kStreamSettings = {
    {{"memory-mib", 0.01, 1e6, 64, false}, {"latency", 1, 240, 1, true, true}}};

bool is_streamed(const MethodSpec& spec);  // "caveclod:streamed", "terrain:streamed"

// Could it be streamed? Opens the world's file as the method does. Fails as caveclod::MeshStream::open and terrain::Tiles::open.
Result<void> check_streams(const MethodSpec& spec, const World& world);

// A streamed one, which begins with the coarsest blocks alone and asks for more from the first frame on. Its errors are against
// all of the file, and what it promises counts what is missing. check_streams must have passed: what has become unreadable since
// is thrown.
std::unique_ptr<Method> make_streamed_method(World& world, const MethodSpec& spec);

}  // namespace overlook::measure
