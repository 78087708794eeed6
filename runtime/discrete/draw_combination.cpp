#include "runtime/discrete/draw_combination.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/discrete/draw_combination_shaders.h"
#include "runtime/discrete/draw_search_shaders.h"
#include "runtime/discrete/draw_turn_shaders.h"
#include "runtime/gl/surface_shaders.h"

namespace overlook::discrete {
namespace {

constexpr int kTileMargin_px = 1;

std::string define(const char* name, int value) {
    return fmt::format("#define {} {}\n", name, value);
}

// As in draw_combination_shaders.h.
struct PackedTile {
    uint32_t column = 0, row = 0, first = 0, count = 0;
};

// Something under way: of which chain, and how near its middle is.
struct Near {
    const UnderWay* chain = nullptr;
    Fading fading;
    glm::dvec3 from_eye_m{0};
};

std::vector<Near> nearest_first(std::span<const UnderWay> chains, const view::Camera& camera) {
    std::vector<Near> all;
    for (const UnderWay& chain : chains) {
        for (const Fading& fading : chain.frame->fading) {
            all.push_back({&chain, fading, chain.now[fading.instance].at(chain.facts->middle_m) - camera.position_m});
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Near& a, const Near& b) {
        return glm::dot(a.from_eye_m, a.from_eye_m) < glm::dot(b.from_eye_m, b.from_eye_m);
    });
    return all;
}

// has_long_ramps needs weighs_by_phase.
bool has_long_ramps(const Remedies& remedies) {
    return remedies.has_long_ramps && remedies.weighs_by_phase;
}

PackedMoved packed(uint32_t id, const Fading& fading, bool is_eased, const Reprojection& moved, const Extent& extent) {
    PackedMoved made;
    made.old_from_new = moved.old_from_new, made.new_from_old = moved.new_from_old;
    made.id = id, made.from = fading.transition.from, made.to = fading.transition.to;
    made.phase = float(is_eased ? eased(fading.transition.phase) : fading.transition.phase);
    made.near_z = extent.near_z, made.far_z = extent.far_z;
    return made;
}

template <class T>
void fill(gl::StreamBuffer& buffer, const std::vector<T>& from) {
    const T none{};
    buffer.fill(from.empty() ? std::as_bytes(std::span(&none, 1)) : std::as_bytes(std::span(from)));
}

uint64_t pixels_of(const PackedTile& tile, const gl::Target& target) {
    uint64_t wide = std::min(Tiles::kSide_px, target.width_px() - tile.column * Tiles::kSide_px);
    return wide * std::min(Tiles::kSide_px, target.height_px() - tile.row * Tiles::kSide_px);
}

void bind_buffers(const TurnBuffer& newer, const TurnBuffer& older, bool has_depths) {
    GLuint unit = 0;
    for (const TurnBuffer* buffer : {&newer, &older}) {
        glBindTextureUnit(unit++, buffer->colour.id());
        glBindTextureUnit(unit++, buffer->ids.id());
        if (has_depths) glBindTextureUnit(unit++, buffer->depth.id());
    }
}

}  // namespace

Combination combination_of(const FrameOptions& options, std::span<const UnderWay> chains, const view::Camera& old_camera,
                           const view::Camera& new_camera) {
    Combination made;
    const Placement still;
    if (options.reprojects) made.camera = reprojection(old_camera, still, new_camera, still);
    if (options.variant == Variant::fsi_paper) return made;
    bool is_eased = options.remedies.eases_ends && has_long_ramps(options.remedies);
    std::vector<Extent> extents;
    for (const auto& [chain, fading, from_eye_m] : nearest_first(chains, new_camera)) {
        const Placement &before = chain->before[fading.instance], &now = chain->now[fading.instance];
        extents.push_back(extent_of(new_camera, from_eye_m, chain->facts->radius_m * now.scale, kTileMargin_px));
        bool has_own = options.reprojects && options.remedies.moves_instances && before != now;
        made.has_own_motion = made.has_own_motion || has_own;
        Reprojection moved = has_own ? reprojection(old_camera, before, new_camera, now) : made.camera;
        made.moved.push_back(packed(chain->first_instance + fading.instance + 1, fading, is_eased, moved, extents.back()));
    }
    made.tiles = tiles_of(new_camera, extents);
    return made;
}

Result<gl::Program> Combiner::make_program(bool is_one, bool moves) const {
    const Remedies& remedies = options_.remedies;
    std::string defines = define("SAMPLES", int(samples_)) + define("IS_ONE", is_one) + define("MOVES", moves) +
                          define("KEEPS_HIDDEN", remedies.keeps_hidden) + define("SEARCHES", remedies.searches) +
                          define("WEIGHS_BY_PHASE", remedies.weighs_by_phase) +
                          define("HAS_LONG_RAMPS", has_long_ramps(remedies)) + define("HAS_WIDE_IDS", remedies.has_wide_ids) +
                          define("HAS_WIDE_DEPTH", remedies.has_wide_depth);
    std::string vertex = "#version 450 core\n" + defines + shaders::kUnderWay + shaders::kTileVertex;
    std::string fragment = "#version 450 core\n" + defines + shaders::kSamplers + shaders::kCombined + shaders::kPlaces +
                           shaders::kTwoFrames + (is_one ? "" : shaders::kUnderWay) + shaders::kCombinationInputs +
                           shaders::kCombinationParts + shaders::kCombinationMain;
    return gl::Program::make("combination", {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}});
}

Result<Combiner> Combiner::make(const FrameOptions& options, uint32_t samples) {
    Combiner made;
    made.options_ = options, made.samples_ = samples;
    made.nothing_ = gl::make_vertex_array();
    if (options.variant == Variant::fsi_paper) {
        std::string text = "#version 450 core\n" + define("SAMPLES", int(samples)) + shaders::kSamplers + shaders::kCombined +
                           shaders::kPlaces + shaders::kPaperCombination;
        auto paper =
            gl::Program::make("combination", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, text}});
        if (!paper) return tl::unexpected(paper.error());
        made.paper_ = std::move(*paper);
        return made;
    }
    for (bool is_one : {false, true})
        for (bool moves : {false, true}) {
            auto program = made.make_program(is_one, moves);
            if (!program) return tl::unexpected(program.error());
            made.tiled_[is_one][moves] = std::move(*program);
        }
    const Remedies& remedies = options.remedies;
    if (!made.copies_rest() || !remedies.sieves || !remedies.searches || !remedies.has_wide_ids) return made;
    auto sieve = Sieve::make(samples);
    if (!sieve) return tl::unexpected(sieve.error());
    made.sieve_.emplace(std::move(*sieve));
    return made;
}

void Combiner::fill_tiles(const gl::Target& target, const Combination& combination, bool takes_all) {
    const Tiles& tiles = combination.tiles;
    std::vector<PackedTile> ones, others;
    std::vector<uint32_t> entries;
    for (uint32_t row = 0; row < tiles.rows; ++row)
        for (uint32_t column = 0; column < tiles.columns; ++column) {
            const uint32_t* listed = &tiles.entries[(size_t(row) * tiles.columns + column) * Tiles::kMost];
            auto count = uint32_t(std::find(listed, listed + Tiles::kMost, 0u) - listed);
            if (count == 0 && !takes_all) continue;
            (count == 1 ? ones : others).push_back({column, row, uint32_t(entries.size()), count});
            for (uint32_t k = 0; k < count; ++k) entries.push_back(listed[k] - 1);
        }
    one_count_ = uint32_t(ones.size());
    ones.insert(ones.end(), others.begin(), others.end());
    tile_count_ = uint32_t(ones.size());
    combined_px_ = 0;
    for (const PackedTile& tile : ones) combined_px_ += pixels_of(tile, target);
    fill(tiles_, ones), fill(entries_, entries), fill(moved_, combination.moved);
}

// What is copied keeps its depth as it is.
bool Combiner::copies_rest() const {
    return options_.remedies.copies_rest && options_.remedies.has_wide_depth;
}

uint64_t Combiner::searched_px() const {
    if (!sieve_) return combined_px_;
    return std::min(combined_px_, uint64_t(sieve_->block_count()) * Sieve::kBlock_px * Sieve::kBlock_px);
}

// Returns calls made.
uint64_t Combiner::draw_tiles(bool is_one, const gl::Target& target, const Combination& combination, bool is_sifted) {
    uint32_t first = is_one ? 0 : one_count_, end = is_one ? one_count_ : tile_count_;
    if (first == end) return 0;
    const gl::Program& program = use_program(is_one, combination.has_own_motion, target, combination);
    glUniform1f(program.at("tile_px"), float(is_sifted ? Sieve::kBlock_px : Tiles::kSide_px));
    if (is_sifted) {
        sieve_->draw(program, is_one);
        return 1;
    }
    glUniform1ui(program.at("first_tile"), first);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(end - first));
    return 1;
}

// Returns calls made. Both frames' buffers must be bound.
uint64_t Combiner::combine_tiles(const gl::Target& target, const Combination& combination, bool sifts) {
    fill_tiles(target, combination, !copies_rest());
    if (tile_count_ == 0) return 0;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, moved_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, tiles_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, entries_.id());
    bool is_sifted = sifts && sieve_;
    if (is_sifted) {
        sieve_->sift(target.width_px(), target.height_px(), one_count_, tile_count_);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, sieve_->blocks());
    }
    uint64_t calls = is_sifted ? 1 : 0;
    for (bool is_one : {true, false}) calls += draw_tiles(is_one, target, combination, is_sifted);
    return calls;
}

void Combiner::prepare(const gl::Target& target, const TurnBuffer& newer, const TurnBuffer& older) {
    Combination combination;
    if (options_.variant == Variant::fsi_paper) {
        combine(target, newer, older, combination);
        return;
    }
    // One thing in the first square, two in the second; whatever the buffers hold, each way draws something without the sieve.
    combination.moved.resize(2);
    combination.tiles.columns = 2, combination.tiles.rows = 1;
    combination.tiles.entries.assign(2 * Tiles::kMost, 0);
    combination.tiles.entries[0] = combination.tiles.entries[Tiles::kMost] = 1;
    combination.tiles.entries[Tiles::kMost + 1] = 2;
    for (bool moves : {true, false}) {
        combination.has_own_motion = moves;
        for (bool sifts : {true, false}) combine(target, newer, older, combination, sifts);
    }
}

const gl::Program& Combiner::use_program(bool is_one, bool moves, const gl::Target& target, const Combination& combination) {
    const gl::Program& program = tiled_[is_one][moves];
    program.use();
    glUniform2i(program.at("size_px"), GLint(target.width_px()), GLint(target.height_px()));
    glUniform2f(program.at("picture_px"), float(target.width_px()), float(target.height_px()));
    glUniformMatrix4fv(program.at("camera_old_from_new"), 1, GL_FALSE, glm::value_ptr(combination.camera.old_from_new));
    glUniformMatrix4fv(program.at("camera_new_from_old"), 1, GL_FALSE, glm::value_ptr(combination.camera.new_from_old));
    glUniform1f(program.at("softness"), float(options_.remedies.softness));
    if (samples_ == 1) return program;
    std::vector<glm::vec2> places(samples_);
    for (uint32_t i = 0; i < samples_; ++i) glGetMultisamplefv(GL_SAMPLE_POSITION, i, &places[i].x);
    glUniform2fv(program.at("sample_px"), GLsizei(samples_), &places[0].x);
    return program;
}

uint64_t Combiner::combine(const gl::Target& target, const TurnBuffer& newer, const TurnBuffer& older,
                           const Combination& combination, bool sifts) {
    bool is_paper = options_.variant == Variant::fsi_paper;
    uint64_t calls = 1;
    if (!is_paper && copies_rest()) target.copy_from(newer.framebuffer.id());
    target.bind();
    bind_buffers(newer, older, !is_paper);
    glDepthFunc(GL_ALWAYS);
    glBindVertexArray(nothing_.id());
    if (is_paper) {
        paper_.use();
        glUniform2i(paper_.at("size_px"), GLint(target.width_px()), GLint(target.height_px()));
        glUniformMatrix4fv(paper_.at("camera_old_from_new"), 1, GL_FALSE, glm::value_ptr(combination.camera.old_from_new));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        combined_px_ = uint64_t(target.width_px()) * target.height_px();
    } else {
        calls += combine_tiles(target, combination, sifts);
    }
    glDepthFunc(GL_GREATER);
    return calls;
}

}  // namespace overlook::discrete
