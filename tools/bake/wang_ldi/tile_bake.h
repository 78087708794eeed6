// The images and textures of one tile among its neighbours: what is done by several threads.
#pragma once

#include <span>

#include "tools/bake/wang_ldi/bake_images.h"

namespace overlook::wang_ldi {

// How many tiles have images made.
uint32_t tiles_tried(const ImageBake& bake, const ImageSet& set);

class TileBake {
  public:
    TileBake(const Models& models, const ImageBake& bake, const ImageSet& set) : models_(models), bake_(bake), set_(set) {}
    // foreign: of other neighbours, to be judged among; or null. rate: to be added to, if it is timed.
    Result<Shard> image(std::span<const TraceStage> stages, const TraceStage* foreign, const Which& which, Rate& rate) const;
    Shard texture(std::span<const TraceStage> stages, const TextureSet& set, uint64_t index) const;

  private:
    // What is baked is lit by; what it is judged by keeps its gloss.
    Light own_light() const {
        Light light = bake_.light;
        light.has_gloss = bake_.has_gloss;
        return light;
    }
    std::vector<glm::vec3> colours_of(std::span<const TraceStage> stages, const Sampled& sampled, const Wedge& wedge,
                                      uint64_t seed) const;
    // Adds the shadow rays of colours_of, shot again for nothing else.
    void time_shadow_rays(std::span<const TraceStage> stages, std::span<const Sample> samples, const Wedge& wedge, uint64_t seed,
                          Rate& rate) const;
    // The samples of an image and their colours.
    Sampled sampled_and_lit(std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options,
                            uint64_t light_seed, std::vector<glm::vec3>& colours, Rate& rate) const;
    const Models& models_;
    const ImageBake& bake_;
    const ImageSet& set_;
};

}  // namespace overlook::wang_ldi
