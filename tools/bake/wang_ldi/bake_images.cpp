#include "tools/bake/wang_ldi/bake_images.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <thread>

#include "formats/parallel.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/bake_key.h"
#include "tools/bake/wang_ldi/bake_textures.h"
#include "tools/bake/wang_ldi/tile_bake.h"

namespace overlook::wang_ldi {
namespace {

constexpr const char* kNoMemory =
    "there is not enough memory for the images of a tile; ask for a greater pixel error or less memory for rays, or give fewer "
    "threads";
constexpr uint64_t kPaperRays = 2'500'000;
constexpr uint32_t kPaperEyes = 64;
constexpr uint64_t kNeighbourStream = 41;

class SetBake {
  public:
    SetBake(const TileSet& tiles, const Planting& planting, const Models& models, const ImageBake& bake, const ImageSet& set)
        : tiles_(tiles),
          planting_(planting),
          models_(models),
          bake_(bake),
          set_(set),
          one_(models, bake, set),
          textures_(texture_set_of(set, bake.textures.side_px)) {}
    Result<ImageReport> run(container::Writer& writer, const std::function<void(double)>& progress);

  private:
    // Those to sample from and, where images are judged, one more, of other neighbours.
    Result<std::vector<TraceStage>> stages_of(uint32_t context, uint32_t tile) const;
    size_t sampled_stages(uint32_t context) const { return context == 1 ? 1 : std::max(1u, bake_.neighbourhoods); }
    // Of a tile, first its images, then its textures. done: called by this thread with the share of them.
    Result<void> bake_tile(uint32_t context, uint32_t tile, std::vector<Shard>& shards, const std::function<void(double)>& done);
    // index: of the images, or behind them of the textures.
    Result<Shard> made(std::span<const TraceStage> stages, uint32_t context, uint64_t index, Rate& rate) const;
    Result<void> bake_all(ImageWriter* images, const std::function<void(double)>& progress);
    void add_rows(uint64_t first, const std::vector<Shard>& shards);
    Result<void> write_all(container::Writer& writer, const std::function<void(double)>& progress);
    uint64_t images_of_tile() const { return set_.levels.size() * set_.direction_count; }
    uint64_t textures_of_tile() const { return has_textures() ? set_.direction_count : 0; }
    bool has_textures() const { return bake_.textures.side_px > 0; }
    uint64_t index_of_job(uint64_t tile, uint64_t job) const {
        if (job < images_of_tile()) return tile * images_of_tile() + job;
        return set_.ldi_count() + tile * textures_of_tile() + job - images_of_tile();
    }

    const TileSet& tiles_;
    const Planting& planting_;
    const Models& models_;
    const ImageBake& bake_;
    const ImageSet& set_;
    TileBake one_;
    TextureSet textures_;
    Shards kept_;
    ImageReport report_;
};

Result<std::vector<TraceStage>> SetBake::stages_of(uint32_t context, uint32_t tile) const {
    std::vector<TraceStage> stages;
    size_t count = sampled_stages(context) + (context == 0 && bake_.judged_views > 0 ? 1 : 0);
    std::vector<std::array<int, 9>> sampled_among;
    for (size_t n = 0; n < count; ++n) {
        uint64_t seed = hash_of(bake_.seed, kNeighbourStream, tile, int64_t(n));
        std::span<const std::array<int, 9>> unlike(sampled_among);
        auto around = context == 1 ? alone(tile)
                                   : neighbourhood(tiles_, tile, seed, n < sampled_stages(context) ? unlike.first(0) : unlike);
        sampled_among.push_back(around);
        auto stage = stage_of(models_, copies_of(tiles_, planting_, around), bake_.memory_bytes / count, bake_.instructions);
        if (!stage) return tl::unexpected(stage.error());
        stages.push_back(std::move(*stage));
    }
    return stages;
}

Result<Shard> SetBake::made(std::span<const TraceStage> stages, uint32_t context, uint64_t index, Rate& rate) const {
    size_t own = sampled_stages(context);
    const TraceStage* foreign = stages.size() > own ? &stages.back() : nullptr;
    if (index < set_.ldi_count()) return one_.image(stages.first(own), foreign, which_of(set_, index), rate);
    return one_.texture(stages.first(own), textures_, index - set_.ldi_count());
}

Result<void> SetBake::bake_tile(uint32_t context, uint32_t tile, std::vector<Shard>& shards,
                                const std::function<void(double)>& done) {
    auto index_of = [&](uint64_t job) { return index_of_job(uint64_t(context) * set_.tile_count + tile, job); };
    std::vector<size_t> missing;
    for (size_t i = 0; i < shards.size(); ++i) {
        if (index_of(i) % bake_.part_count != bake_.part) continue;
        if (auto kept = kept_.find(index_of(i)))
            shards[i] = std::move(*kept), ++report_.taken_from_parts;
        else
            missing.push_back(i);
    }
    report_.made += missing.size();
    if (missing.empty()) return {};
    auto stages = stages_of(context, tile);
    if (!stages) return tl::unexpected(stages.error());

    std::mutex mutex;
    Result<void> outcome;
    std::atomic<size_t> finished = 0;
    auto caller = std::this_thread::get_id();
    parallel_ranges(missing.size(), 1, [&](size_t m, size_t) {
        auto fail = [&](const Error& error) {
            std::lock_guard lock(mutex);
            if (outcome) outcome = tl::unexpected(error);
        };
        try {
            Rate rate;
            auto shard = made(*stages, context, index_of(missing[m]), rate);
            if (!shard) return fail(shard.error());
            {
                std::lock_guard lock(mutex);
                report_.rate.add(rate);
            }
            if (auto kept = kept_.keep(index_of(missing[m]), *shard); !kept) return fail(kept.error());
            shards[missing[m]] = std::move(*shard);
            size_t count = ++finished;
            if (std::this_thread::get_id() == caller) done(double(count) / double(missing.size()));
        } catch (const std::bad_alloc&) {
            fail({Exit::impossible, kNoMemory});
        }
    });
    return outcome;
}

void SetBake::add_rows(uint64_t tile, const std::vector<Shard>& shards) {
    for (size_t i = 0; i < images_of_tile(); ++i) {
        const Shard& shard = shards[i];
        bool has_goal = bake_.sampling.fixed_rays == 0;
        report_.above_goal += has_goal && double(shard.packed.unseen_share) > bake_.sampling.unseen_goal;
        report_.rows.push_back({which_of(set_, index_of_job(tile, i)), shard.packed.sample_count, shard.packed.bytes.size(),
                                shard.rays, shard.hits, shard.eyes, double(shard.packed.unseen_share), shard.judgement,
                                shard.foreign});
    }
    for (size_t i = images_of_tile(); i < shards.size(); ++i) {
        TextureRow row;
        textures_.textures.push_back(texture_of_shard(shards[i], textures_, row));
        report_.textures.push_back(row);
    }
}

Result<void> SetBake::bake_all(ImageWriter* images, const std::function<void(double)>& progress) {
    uint64_t tiles = uint64_t(set_.context_count) * set_.tile_count;
    for (uint64_t t = 0; t < tiles; ++t) {
        if (t % set_.tile_count >= tiles_tried(bake_, set_)) continue;
        auto done = [&](double share) { progress((double(t) + share) / double(tiles)); };
        std::vector<Shard> shards(images_of_tile() + textures_of_tile());
        if (auto baked = bake_tile(uint32_t(t / set_.tile_count), uint32_t(t % set_.tile_count), shards, done); !baked)
            return baked;
        if (bake_.part_count > 1) continue;
        for (size_t i = 0; images && i < images_of_tile(); ++i)
            if (auto added = images->add(shards[i].packed); !added) return added;
        add_rows(t, shards);
    }
    return {};
}

Result<void> SetBake::write_all(container::Writer& writer, const std::function<void(double)>& progress) {
    auto images = ImageWriter::begin(writer, set_);
    if (!images) return tl::unexpected(images.error());
    if (auto baked = bake_all(&*images, progress); !baked) return baked;
    if (auto ended = images->end(); !ended || !has_textures()) return ended;
    return write_textures(writer, set_, textures_);
}

Result<ImageReport> SetBake::run(container::Writer& writer, const std::function<void(double)>& progress) {
    auto begin = std::chrono::steady_clock::now();
    auto kept = Shards::in(bake_.parts_folder, key_of(tiles_, planting_, models_, bake_, set_));
    if (!kept) return tl::unexpected(kept.error());
    kept_ = std::move(*kept), report_.set = set_, report_.parts = kept_;
    report_.part_count = set_.ldi_count() + (has_textures() ? textures_.texture_count() : 0);
    report_.texture_side_px = bake_.textures.side_px;
    bool is_written = bake_.part_count == 1 && bake_.trial_tiles == 0;
    report_.trial_tiles = bake_.trial_tiles;
    auto outcome = !is_written ? bake_all(nullptr, progress) : write_all(writer, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    progress(1);
    report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(report_);
}

}  // namespace

void take_paper_constants(ImageBake& bake) {
    bake.levels.constants = Constants::paper;
    bake.sampling.fixed_rays = kPaperRays, bake.sampling.rays_per_eye = uint32_t(kPaperRays / kPaperEyes);
    bake.neighbourhoods = 1, bake.is_covering = false;
}

glm::dvec2 heights_of(const Models& models, const Planting& planting) {
    double low = 0, high = 0.1;
    std::vector<glm::dvec2> of_models;
    for (const rays::Mesh& mesh : models.meshes) {
        glm::dvec2 range(0);
        for (const glm::vec3& position : mesh.positions_m)
            range = {std::min(range.x, double(position.z)), std::max(range.y, double(position.z))};
        of_models.push_back(range);
    }
    for (const auto& objects : planting.tiles)
        for (const Planted& object : objects) {
            low = std::min(low, of_models[object.model].x * double(object.scale));
            high = std::max(high, of_models[object.model].y * double(object.scale));
        }
    // Rays end in 32-bit floats.
    double slack = 1e-5 * (high - low);
    return {low < 0 ? low - slack : 0, high + slack};
}

Result<ImageReport> bake_images(container::Writer& writer, const TileSet& tiles, const Planting& planting, const Models& models,
                                const ImageBake& bake, const std::function<void(double)>& progress) {
    LevelOptions levels = bake.levels;
    glm::dvec2 heights = heights_of(models, planting);
    levels.set.tile_m = planting.tile_size_m, levels.set.low_m = heights.x, levels.set.high_m = heights.y;
    levels.set.tile_count = uint32_t(tiles.tiles.size()), levels.set.context_count = bake.has_border_images ? 2 : 1;
    levels.set.has_normals = bake.is_relit, levels.set.is_grouped = true;
    levels.set.to_sun = bake.is_relit ? glm::dvec3(0) : glm::normalize(glm::dvec3(bake.light.to_sun));
    auto set = leveled(levels);
    if (!set) return tl::unexpected(set.error());
    return SetBake(tiles, planting, models, bake, *set).run(writer, progress);
}

}  // namespace overlook::wang_ldi
