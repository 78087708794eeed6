#include "tools/bake/wang_ldi/tile_bake.h"

#include <algorithm>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/assemble.h"
#include "tools/bake/wang_ldi/bake_textures.h"
#include "tools/bake/wang_ldi/covering.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kSampleStream = 42, kLightStream = 43, kJudgeStream = 44, kTextureStream = 45;
constexpr size_t kSamplesTimedAtOnce = 4096;  // whose shadow rays are kept

}  // namespace

uint32_t tiles_tried(const ImageBake& bake, const ImageSet& set) {
    return bake.trial_tiles == 0 ? set.tile_count : std::min(bake.trial_tiles, set.tile_count);
}

std::vector<glm::vec3> TileBake::colours_of(std::span<const TraceStage> stages, const Sampled& sampled, const Wedge& wedge,
                                            uint64_t seed) const {
    if (!set_.has_normals) return lit_samples(models_, stages, sampled.samples, middle_eye_m(wedge), own_light(), seed);
    std::vector<glm::vec3> colours;
    for (const Sample& sample : sampled.samples) colours.push_back(sample.albedo);
    return colours;
}

void TileBake::time_shadow_rays(std::span<const TraceStage> stages, std::span<const Sample> samples, const Wedge& wedge,
                                uint64_t seed, Rate& rate) const {
    std::vector<std::vector<rays::Ray>> asked(stages.size());
    while (!samples.empty()) {
        auto now = samples.first(std::min(samples.size(), kSamplesTimedAtOnce));
        samples = samples.subspan(now.size());
        for (auto& of_stage : asked) of_stage.clear();
        lit_samples(models_, stages, now, middle_eye_m(wedge), own_light(), seed, &asked);
        for (const auto& of_stage : asked) rate.shadow_rays += of_stage.size();
        rate.bare_shadow_s += bare_shadow_s(stages, asked);
    }
}

Sampled TileBake::sampled_and_lit(std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options,
                                  uint64_t light_seed, std::vector<glm::vec3>& colours, Rate& rate) const {
    double begin = thread_s();
    Sampled all = sampled(models_, stages, wedge, options);
    rate.sampled_s += thread_s() - begin, rate.rays += all.rays;
    if (bake_.is_covering) all = covering(stages, wedge, set_.cell.focal_px, std::move(all), options.seed);
    double lit = thread_s();
    colours = colours_of(stages, all, wedge, light_seed);
    rate.lit_s += thread_s() - lit;
    if (!bake_.is_timed) return all;
    rate.bare_s += bare_s(stages, wedge, options, all.eyes);
    if (!set_.has_normals) time_shadow_rays(stages, all.samples, wedge, light_seed, rate);
    return all;
}

Result<Shard> TileBake::image(std::span<const TraceStage> stages, const TraceStage* foreign, const Which& which,
                              Rate& rate) const {
    auto index = int64_t(index_of(set_, which));
    SampleOptions options = bake_.sampling;
    options.seed = hash_of(bake_.seed, kSampleStream, index, 0);
    Wedge wedge = wedge_of(set_, which.level, which.direction);
    std::vector<glm::vec3> colours;
    Sampled all = sampled_and_lit(stages, wedge, options, hash_of(bake_.seed, kLightStream, index, 0), colours, rate);
    Ldi ldi = assembled(set_, which.level, all, colours);
    auto bytes = packed(set_, which.level, ldi);
    if (!bytes) return tl::unexpected(bytes.error());
    Shard shard{std::move(*bytes), all.rays, all.hits, all.eyes, {}, {}};
    if (uint32_t views = views_of(set_, which, bake_.judged_views, tiles_tried(bake_, set_)); views > 0) {
        Judging judging;
        judging.views = views, judging.seed = hash_of(bake_.seed, kJudgeStream, index, 0);
        shard.judgement = judged(models_, stages[0], set_, which, ldi, bake_.light, judging);
        if (foreign) shard.foreign = judged(models_, *foreign, set_, which, ldi, bake_.light, judging);
    }
    return shard;
}

Shard TileBake::texture(std::span<const TraceStage> stages, const TextureSet& set, uint64_t index) const {
    TextureOptions options = bake_.textures;
    options.seed = hash_of(bake_.seed, kTextureStream, int64_t(index), 0);
    auto direction = uint32_t(index % set.direction_count);
    TextureSampled all = texture_of(models_, stages, set, direction, own_light(), options);
    TextureJudgement judgement;
    if (bake_.judged_views > 0) {
        Judging judging;
        judging.views = 1, judging.seed = hash_of(bake_.seed, kJudgeStream, int64_t(index), 1);
        judgement = judged_texture(models_, stages[0], set, all.texture, direction, set_.cell.focal_px, bake_.light, judging);
    }
    return shard_of_texture(all, judgement);
}

}  // namespace overlook::wang_ldi
