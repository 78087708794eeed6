// stability: runs the cases of the stability suite and says which gates every method keeps.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include "runtime/command/command.h"
#include "tools/measure/options.h"
#include "tools/measure/page_text.h"
#include "tools/measure/stability/kept.h"
#include "tools/measure/stability/report.h"

namespace overlook::measure {
namespace {

struct SuiteOptions {
    std::string folder, scene, out;
    std::vector<std::string> cases, methods{"terrain", "terrain:hard"};
    std::string size = "320x240";
    uint32_t frames = 0;
    double asked_px = 1;
};

void add_suite_options(CLI::App& app, SuiteOptions& options) {
    app.add_option("cases", options.folder, "Folder of the cases, s01.json to s20.json")->required()->type_name("FOLDER");
    app.add_option("--scene", options.scene,
                   "What is flown over: a scene (.json) or a baked terrain (.ovl); default each case's own")
        ->type_name("SCENE");
    app.add_option("--case", options.cases, "S01 ...: these cases alone; may be repeated")->type_name("CASE");
    app.add_option("--method", options.methods, "As of measure; may be repeated; default terrain and terrain:hard")
        ->type_name("METHOD")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--size", options.size, "Size of the pictures in pixels")->type_name("WxH")->capture_default_str();
    app.add_option("--frames", options.frames, "At most so many frames of a flight where pictures are judged; default all")
        ->type_name("N");
    app.add_option("--error-px", options.asked_px, "The error that the gates hold a method to, whatever it was set to")
        ->type_name("PX")
        ->check(command::number_in(0.01, 1000))
        ->capture_default_str();
    app.add_option("--out", options.out, "Folder for stability.json and the page; made if it is not there")
        ->type_name("DIR")
        ->required();
}

// The cases asked for, by their numbers in either case of letter.
Result<std::vector<Case>> chosen_cases(const SuiteOptions& options) {
    Result<std::vector<Case>> all = read_cases(options.folder);
    if (!all || options.cases.empty()) return all;
    std::vector<Case> chosen;
    for (std::string number : options.cases) {
        for (char& c : number) c = char(std::toupper(static_cast<unsigned char>(c)));
        auto found = std::find_if(all->begin(), all->end(), [&](const Case& each) { return each.number == number; });
        if (found == all->end()) return bad_command("--case {}: is no case; S01 to S20 are", number);
        chosen.push_back(*found);
    }
    return chosen;
}

// Of the report: the first case's, unless another is named.
Result<std::string> scene_path(const SuiteOptions& options, const std::vector<Case>& cases) {
    if (!options.scene.empty()) return options.scene;
    for (const Case& each : cases) {
        for (const std::string& path : {each.scene, each.mesh_scene, each.chain_scene, each.planting_scene})
            if (!path.empty()) return path;
    }
    return bad_command("none of these cases has a scene; give --scene");
}

void say_summary(const SuiteResult& result, const std::string& folder, const command::Common& common) {
    for (const Verdict& verdict : result.verdicts) {
        std::string line = fmt::format("stability: {} {}: {}", verdict.number, family_of(verdict.spec), verdict.outcome());
        for (const std::string& number : verdict.numbers()) line += ", " + number;
        command::note(common, line);
    }
    command::note(common, fmt::format("stability: {} owed; the page: {}/index.html", result.owed.size(), folder));
}

Result<bool> run_all(const SuiteOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<std::vector<Case>> cases = chosen_cases(options);
    if (!cases) return tl::unexpected(cases.error());
    Result<std::vector<MethodSpec>> specs = specs_from(options.methods, {});
    if (!specs) return tl::unexpected(specs.error());
    uint32_t width_px = 0, height_px = 0;
    if (Result<void> size = parse_size(options.size, width_px, height_px); !size) return tl::unexpected(size.error());
    Result<std::string> scene = scene_path(options, *cases);
    if (!scene) return tl::unexpected(scene.error());
    Result<World> read = read_world(*scene);
    if (!read) return tl::unexpected(read.error());
    std::string cache_folder = options.out + "/cache", kept_folder = options.out + "/kept";
    for (const std::string& folder : {cache_folder, kept_folder}) {
        std::error_code problem;
        std::filesystem::create_directories(folder, problem);
        if (problem) return cannot_write("{}: cannot make the folder: {}", folder, problem.message());
    }

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    World world = std::move(*read);  // goes before the context, as the others do
    if (Result<void> uploaded = upload(world); !uploaded) return tl::unexpected(uploaded.error());
    std::map<std::string, World> others;
    auto world_of = [&](const Case& each) -> Result<World*> {
        if (!options.scene.empty() || each.scene == *scene) return &world;
        auto known = others.find(each.scene);
        if (known != others.end()) return &known->second;
        Result<World> other = read_world(each.scene);
        if (!other) return tl::unexpected(other.error());
        if (Result<void> uploaded = upload(*other); !uploaded) return tl::unexpected(uploaded.error());
        return &others.emplace(each.scene, std::move(*other)).first->second;
    };
    Result<std::string> program = program_hash();
    if (!program) return tl::unexpected(program.error());
    Stage stage{world,        context->renderer(), width_px, height_px, options.frames, options.asked_px,
                cache_folder, kept_folder,         *program};
    command::Progress progress(common, "running the suite");
    Result<SuiteResult> result = run_suite(
        stage, *cases, *specs, [&](double share) { progress.set(share); }, world_of);
    if (!result) return tl::unexpected(result.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});

    RunSetup setup;
    setup.version = command::version();
    setup.command = words;
    setup.scene = world.name;
    setup.scene_hash = world.content_hash;
    setup.renderer = stage.renderer;
    if (Result<void> written = write_report(*result, setup, stage, options.out); !written) return tl::unexpected(written.error());
    if (common.json) std::fputs(stability_json(*result, setup, stage).c_str(), stdout);
    say_summary(*result, options.out, common);
    return is_kept(*result);
}

}  // namespace
}  // namespace overlook::measure

int main(int argc, char** argv) {
    using namespace overlook;
    CLI::App app(
        "Runs the stability suite: which gates every method keeps. Exit code 1 if one is missed, but by the baseline that pops",
        "stability");
    command::Common common;
    measure::SuiteOptions options;
    measure::add_suite_options(app, options);
    command::add_common(app, common);
    return command::run(app, common, argc, argv, [&] {
        std::vector<std::string> words(argv, argv + argc);
        words[0] = "stability";
        Result<bool> kept = measure::run_all(options, words, common);
        return kept ? int(*kept ? Exit::done : Exit::answer_is_no) : command::fail("stability", kept.error());
    });
}
