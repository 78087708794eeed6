#include "runtime/discrete/draw_sieve.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "runtime/discrete/draw_combination_shaders.h"
#include "runtime/discrete/draw_sieve_shaders.h"
#include "runtime/discrete/draw_turn_shaders.h"

namespace overlook::discrete {
namespace {

constexpr uint32_t kBlocks = 4, kInGroup = 2;  // blocks of a square; squares of a group of invocations
constexpr uint32_t kMostGroups = 65535;        // in one direction, that any renderer takes
constexpr uint32_t kMostLooked_px = 1024;      // for one thing in a block; where more would have to be, it is not sifted
constexpr uint32_t kTile_bytes = 16;           // as in draw_combination_shaders.h

// As OpenGL has it (glDrawArraysIndirect).
struct ArraysCommand {
    uint32_t count = 4, instance_count = 0, first = 0, base_instance = 0;
};
constexpr size_t kCommandWords = 2 * sizeof(ArraysCommand) / sizeof(uint32_t);

}  // namespace

Result<Sieve> Sieve::make(uint32_t samples) {
    std::string source = fmt::format("#version 450 core\n#define SAMPLES {}\n#define BLOCK_PX {}\n#define MOST_PX {}\n", samples,
                                     kBlock_px, kMostLooked_px) +
                         shaders::kSamplers + shaders::kPlaces + shaders::kTwoFrames + shaders::kUnderWay + shaders::kSieve;
    auto program = gl::Program::make("sieve", {{GL_COMPUTE_SHADER, source}});
    if (!program) return tl::unexpected(program.error());
    Sieve made;
    made.program_ = std::move(*program);
    return made;
}

void Sieve::sift(uint32_t width_px, uint32_t height_px, uint32_t one_count, uint32_t tile_count) {
    one_count_ = one_count, tile_count_ = tile_count;
    std::vector<uint32_t> found(kCommandWords + tile_count, 0);
    found[0] = found[kCommandWords / 2] = ArraysCommand().count;
    found_.fill(std::as_bytes(std::span(found)));
    blocks_.reserve(size_t(kBlocks) * kTile_bytes * tile_count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, blocks_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, found_.id());
    program_.use();
    glUniform2i(program_.at("size_px"), GLint(width_px), GLint(height_px));
    glUniform1ui(program_.at("tile_count"), tile_count);
    glUniform1ui(program_.at("one_count"), one_count);
    uint32_t groups = (tile_count + kInGroup - 1) / kInGroup, wide = std::min(groups, kMostGroups);
    glDispatchCompute(wide, (groups + wide - 1) / wide, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void Sieve::draw(const gl::Program& program, bool is_one) const {
    glUniform1ui(program.at("first_tile"), is_one ? 0 : kBlocks * one_count_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, found_.id());
    glDrawArraysIndirect(GL_TRIANGLE_STRIP, reinterpret_cast<const void*>(is_one ? 0 : sizeof(ArraysCommand)));
}

uint32_t Sieve::block_count() const {
    if (tile_count_ == 0) return 0;
    std::array<ArraysCommand, 2> commands;
    glGetNamedBufferSubData(found_.id(), 0, sizeof commands, commands.data());
    return commands[0].instance_count + commands[1].instance_count;
}

}  // namespace overlook::discrete
