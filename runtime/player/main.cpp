// player: draws a scene or a baked terrain, in a window or into pictures.

#include <CLI/CLI.hpp>
#include <algorithm>

#include "runtime/command/command.h"
#include "runtime/player/headless.h"
#include "runtime/player/options.h"
#include "runtime/player/scene.h"
#include "runtime/player/window.h"

namespace overlook::player {
namespace {

// What is streamed, if anything: without a window every picture waits for it, unless it is asked for otherwise.
std::optional<Streaming> streaming_of(const Options& options, bool has_window) {
    if (options.stream_memory_bytes == 0) return std::nullopt;
    Streaming streaming;
    streaming.settings.residency_budget_bytes = options.stream_memory_bytes;
    streaming.settings.upload_budget_bytes = options.upload_budget_bytes;
    streaming.waits = !has_window && options.stream_latency == 0;
    if (!has_window) streaming.settings.latency_frames = std::max(1u, options.stream_latency);
    return streaming;
}

int play(const Options& options, const command::Common& common) {
    Result<Plan> plan = plan_from(options);
    if (!plan) return command::fail("player", plan.error());
    bool has_window = !options.headless && (options.image.empty() || has_display());
    Result<Scene> scene = Scene::read(options.file, streaming_of(options, has_window), !has_window);
    if (!scene) return command::fail("player", scene.error());

    Method method = plan->method.value_or(scene->method());
    Result<void> fit = check_kind(options, method, scene->subject().thing());
    if (fit) fit = check_fit(options, method, scene->subject().thing());
    if (!fit) return command::fail("player", fit.error());

    if (!has_window && !options.headless)
        command::note(common, "player: there is no display; drawing the picture without a window");
    Result<void> played =
        has_window ? run_in_window(*plan, common, std::move(*scene)) : run_headless(*plan, common, std::move(*scene));
    return played ? int(Exit::done) : command::fail("player", played.error());
}

}  // namespace
}  // namespace overlook::player

int main(int argc, char** argv) {
    CLI::App app("Flies over a baked terrain, a mesh, planted ground or a scene: in a window, or --headless into pictures",
                 "player");
    overlook::command::Common common;
    overlook::player::Options options;
    overlook::player::add_options(app, options);
    overlook::command::add_common(app, common);
    return overlook::command::run(app, common, argc, argv, [&] { return overlook::player::play(options, common); });
}
