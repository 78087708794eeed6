// measure: flies methods side by side over a scene and says what each costs and how far it is from the truth.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <thread>

#include "tools/measure/deliver.h"
#include "tools/measure/methods.h"
#include "tools/measure/options.h"

namespace overlook::measure {
namespace {

Result<void> make_folder(const std::string& path) {
    std::error_code problem;
    std::filesystem::create_directories(path, problem);
    if (problem) return cannot_write("{}: cannot make the folder: {}", path, problem.message());
    return {};
}

RunSetup setup_of(const Options& options, const World& world, const Route& route, const gl::Renderer& renderer) {
    RunSetup setup;
    setup.version = command::version();
    setup.scene = world.name;
    setup.scene_hash = world.content_hash;
    setup.flight = route.name;
    setup.flight_hash = route.content_hash;
    setup.processor = processor_name();
    setup.processor_threads = std::thread::hardware_concurrency();
    setup.renderer = renderer;
    setup.is_wall_clock = options.wall_clock;
    setup.width_px = route.cameras.front().width_px;
    setup.height_px = route.cameras.front().height_px;
    setup.step_s = route.step_s;
    return setup;
}

Result<void> measure_all(const Options& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<std::vector<MethodSpec>> specs = specs_from(options.methods, options.sweeps);
    if (!specs) return tl::unexpected(specs.error());
    Result<World> read = read_world(options.scene);
    if (!read) return tl::unexpected(read.error());
    if (Result<void> draws = check_draws(*specs, *read); !draws) return draws;
    Result<Route> route = route_from(options, *read);
    if (!route) return tl::unexpected(route.error());
    std::string cache_folder = options.out + "/cache";
    bool is_compared = compared_from(options) != Compared::none;
    if (Result<void> made = make_folder(is_compared ? cache_folder : options.out); !made) return made;

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    World world = std::move(*read);  // goes before the context
    if (Result<void> uploaded = upload(world); !uploaded) return uploaded;

    Course course{std::move(*specs), route->cameras, route->step_s, compared_from(options)};
    if (is_compared || options.wall_clock) add_floors(course.specs);
    command::Progress progress(common, "measuring");
    auto done = [&](double share) { progress.set(share); };
    Result<CourseResult> result = options.wall_clock ? run_by_wall_clock(world, course, done)
                                                     : run_course(world, course, context->renderer(), cache_folder, done);
    if (!result) return tl::unexpected(result.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});

    RunSetup setup = setup_of(options, world, *route, context->renderer());
    setup.command = words;
    return deliver(*result, setup, options.out, common);
}

}  // namespace
}  // namespace overlook::measure

int main(int argc, char** argv) {
    using namespace overlook;
    CLI::App app("Flies methods side by side over a scene, and says what each costs and how far it is from the truth", "measure");
    command::Common common;
    measure::Options options;
    measure::add_options(app, options);
    command::add_common(app, common);
    return command::run(app, common, argc, argv, [&] {
        std::vector<std::string> words(argv, argv + argc);
        words[0] = "measure";
        Result<void> measured = measure::measure_all(options, words, common);
        return measured ? int(Exit::done) : command::fail("measure", measured.error());
    });
}
