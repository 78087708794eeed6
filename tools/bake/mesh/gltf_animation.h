// Animations of a glTF file's JSON. A template, so that no header names the JSON library.
#pragma once

#include "tools/bake/mesh/gltf_document.h"
#include "tools/bake/mesh/gltf_json.h"

namespace overlook::mesh::gltf {

// The first animation's channels of nodes' translation and rotation; notes say what else there is.
template <class Json>
std::vector<Channel> read_channels(const Json& root, size_t node_count, size_t accessor_count, Values<Json>& values,
                                   std::vector<std::string>& unread) {
    std::vector<Channel> channels;
    const Json& animations = values.array(root, "animations", "");
    if (animations.empty()) return channels;
    if (animations.size() > 1) unread.push_back("animations but the first are not read");
    const std::string at = "/animations/0";
    const Json& samplers = values.array(animations[0], "samplers", at);
    const Json& array = values.array(animations[0], "channels", at);
    for (size_t i = 0; i < array.size(); ++i) {
        const std::string place = fmt::format("{}/channels/{}", at, i);
        const Json& target = values.member(array[i], "target");
        const std::string path = values.text(target, "path");
        Channel channel;
        channel.node = values.reference(target, "node", node_count, place + "/target");
        const uint32_t sampler = values.needed_reference(array[i], "sampler", samplers.size(), place);
        if (channel.node == kNone || sampler == kNone) continue;
        if (path != "translation" && path != "rotation") {
            unread.push_back(fmt::format("animation of {} is not read; it stays as it is at rest", path));
            continue;
        }
        channel.is_rotation = path == "rotation";
        const std::string of = fmt::format("{}/samplers/{}", at, sampler);
        channel.times = values.needed_reference(samplers[sampler], "input", accessor_count, of);
        channel.values = values.needed_reference(samplers[sampler], "output", accessor_count, of);
        const std::string way = values.text(samplers[sampler], "interpolation");
        channel.way = way == "STEP" ? Channel::Way::step : way == "CUBICSPLINE" ? Channel::Way::cubic : Channel::Way::linear;
        channels.push_back(channel);
    }
    return channels;
}

}  // namespace overlook::mesh::gltf
