#include "tools/measure/paper/fsi/combining.h"

#include <array>

#include "runtime/discrete/draw_combination_shaders.h"
#include "runtime/discrete/draw_frames.h"
#include "runtime/gl/program.h"
#include "runtime/gl/surface_shaders.h"
#include "runtime/gl/timer.h"
#include "tools/measure/numbers/percentiles.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr int kRepeats = 15;
constexpr uint32_t kChanging = kBefore + kFading / 2;  // a frame in which all of the arc is half-way

constexpr char kCopyHead[] = R"(#version 450 core
#define Picture sampler2D
#define Numbers usampler2D
)";
constexpr char kCopy[] = R"(
layout(location = 0) out vec4 colour;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uvec2 ids = texelFetch(new_ids, at, 0).xy + texelFetch(old_ids, at, 0).xy;
    vec4 both = texelFetch(new_colour, at, 0) + texelFetch(old_colour, at, 0);
    colour = ids.x == 7u ? both.bgra : both;
    gl_FragDepth = 0.5 * (texelFetch(new_depth, at, 0).r + texelFetch(old_depth, at, 0).r);
}
)";

// Textures as the buffers have them, twice, and as many again to copy to.
struct Copies {
    static constexpr std::array<GLenum, 3> kFormats = {GL_RGBA8, GL_RG32UI, GL_DEPTH_COMPONENT32F};
    std::vector<gl::Texture> from, to;
    gl::Program pass;
    gl::VertexArray nothing;
};

Result<Copies> make_copies(uint32_t side_px) {
    Copies made;
    made.nothing = gl::make_vertex_array();
    for (std::vector<gl::Texture>* into : {&made.from, &made.to})
        for (int buffer = 0; buffer < 2; ++buffer)
            for (GLenum format : Copies::kFormats) {
                GLuint id = 0;
                glCreateTextures(GL_TEXTURE_2D, 1, &id);
                glTextureStorage2D(id, 1, format, GLsizei(side_px), GLsizei(side_px));
                glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
                glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
                into->emplace_back(id);
            }
    std::string fragment = std::string(kCopyHead) + discrete::shaders::kTwoFrames + kCopy;
    auto pass = gl::Program::make("copy", {{GL_VERTEX_SHADER, gl::shaders::kBackgroundVertex}, {GL_FRAGMENT_SHADER, fragment}});
    if (!pass) return tl::unexpected(pass.error());
    made.pass = std::move(*pass);
    return made;
}

// Median of what takes turns.
template <class Work>
double median_ms(const Work& work) {
    std::vector<double> times_ms;
    work();
    for (int i = 0; i < kRepeats; ++i) {
        glFinish();
        gl::Timer timer;
        work();
        times_ms.push_back(timer.finished_ms());
    }
    return percentile(std::span<const double>(times_ms), 0.5);
}

void time_copies(const Copies& copies, const gl::Target& target, Combining& times) {
    times.pass_ms = median_ms([&] {
        target.bind();
        copies.pass.use();
        for (size_t i = 0; i < copies.from.size(); ++i) glBindTextureUnit(GLuint(i), copies.from[i].id());
        glDepthFunc(GL_ALWAYS);
        glBindVertexArray(copies.nothing.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDepthFunc(GL_GREATER);
        target.resolve();
    });
    auto side = GLsizei(target.width_px());
    times.copy_ms = median_ms([&] {
        for (size_t i = 0; i < copies.from.size(); ++i)
            glCopyImageSubData(copies.from[i].id(), GL_TEXTURE_2D, 0, 0, 0, 0, copies.to[i].id(), GL_TEXTURE_2D, 0, 0, 0, 0, side,
                               side, 1);
    });
}

// Drawing the same frame again only puts its buffers together (discrete::FrameDrawer::draw).
Result<double> pass_ms(discrete::FrameDrawer& frames, const gl::Target& target) {
    Result<discrete::FrameCounts> drawn = frames.draw(target, {});
    if (!drawn) return tl::unexpected(drawn.error());
    return median_ms([&] { static_cast<void>(frames.draw(target, {})); });
}

}  // namespace

Result<std::vector<Combining>> time_combining(const World& scene, const Stand& stand, const std::string& name, uint32_t side_px) {
    Result<World> world = film_world(scene, stand);
    if (!world) return tl::unexpected(world.error());
    Result<gl::Target> target = gl::Target::make(side_px, side_px, 1);
    if (!target) return tl::unexpected(target.error());
    Result<Copies> copies = make_copies(side_px);
    if (!copies) return tl::unexpected(copies.error());
    std::vector<view::Camera> cameras = film_cameras(stand, world->base);
    std::vector<discrete::Stand> stands;
    for (const ChainWorld& one : world->chains) stands.push_back({&*one.drawing, one.placements});
    std::vector<Combining> all;
    for (size_t way : {kPaper, kOwn}) {
        Combining times{name, std::string(kWays[way].name), side_px};
        discrete::FrameOptions options =
            discrete::defaults_of(way == kPaper ? discrete::Variant::fsi_paper : discrete::Variant::fsi);
        options.select.criterion = discrete::Criterion::distance, options.select.refine_share = 1;
        options.select.distance_m = first_distance_m(stand);
        auto frames = discrete::FrameDrawer::make(stands, options);
        if (!frames) return tl::unexpected(frames.error());
        for (uint32_t frame = 0; frame <= kChanging; ++frame) {
            view::Camera camera = cameras[frame];
            camera.width_px = camera.height_px = side_px;
            (*frames)->decide(camera, kFilmStep_s, frame * kFilmStep_s);
            Result<discrete::FrameCounts> drawn = (*frames)->draw(*target, {});
            if (!drawn) return tl::unexpected(drawn.error());
            if (frame + 1 != kBefore && frame != kChanging) continue;
            Result<double> ms = pass_ms(**frames, *target);
            if (!ms) return tl::unexpected(ms.error());
            (frame == kChanging ? times.changing_ms : times.rest_ms) = *ms;
            double all_px = double(side_px) * side_px;
            times.changing_share = double(drawn->combined_px) / all_px;
            times.searched_share = double((*frames)->searched_px(target->samples())) / all_px;
        }
        time_copies(*copies, *target, times);
        all.push_back(std::move(times));
    }
    return all;
}

std::string combining_csv(const std::vector<Combining>& all) {
    std::string csv = "scene,method,side_px,rest_ms,changing_ms,copy_pass_ms,copy_memory_ms,changing_share,searched_share\n";
    for (const Combining& one : all)
        csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", one.scene, one.method, one.side_px, one.rest_ms, one.changing_ms,
                           one.pass_ms, one.copy_ms, one.changing_share, one.searched_share);
    return csv;
}

}  // namespace overlook::measure::paper::fsi
