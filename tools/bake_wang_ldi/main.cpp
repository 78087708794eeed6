// bake-wang-ldi: plants and how they are to stand in, ground of Wang tiles and layered depth images of it out.

#include <CLI/CLI.hpp>
#include <filesystem>

#include "formats/container.h"
#include "tools/bake_wang_ldi/ground.h"
#include "tools/bake_wang_ldi/images.h"
#include "tools/bake_wang_ldi/scene.h"

using namespace overlook;

namespace {

constexpr const char* kName = "bake-wang-ldi";

struct Args {
    bake_wang_ldi::GroundArgs ground;
    bake_wang_ldi::ImageArgs images;
    bake_wang_ldi::SceneArgs scene;

    bool has_images() const { return ground.only.empty(); }
    bool has_scene() const { return ground.only == "scene"; }
    bool makes_no_file() const { return has_images() && (!images.part.empty() || images.trial_tiles > 0); }
};

struct Reports {
    wang_ldi::ImageReport images;
    wang_ldi::SceneMade scene;
    uint64_t scene_bytes = 0;
};

// 0 bytes of a part or a trial, which makes no file.
Result<uint64_t> write_file(const Args& args, const bake_wang_ldi::GroundDone& done, const command::Common& common,
                            Reports& reports) {
    auto provenance = bake_wang_ldi::provenance_of(args.ground, done);
    if (!provenance) return tl::unexpected(provenance.error());
    auto writer = container::Writer::create(args.ground.output, wang_ldi::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = wang_ldi::write(*writer, done.ground); !written) return tl::unexpected(written.error());
    if (args.has_images()) {
        auto bake = bake_wang_ldi::image_bake_of(args.images, args.ground.output, done.recipe.seed);
        if (!bake) return tl::unexpected(bake.error());
        auto added = bake_wang_ldi::add_images(*writer, done, args.images, *bake, common);
        if (!added) return tl::unexpected(added.error());
        reports.images = std::move(*added);
        bake_wang_ldi::add_image_options_in_words(args.images, *provenance);
    }
    if (args.has_scene()) {
        auto bake = bake_wang_ldi::scene_bake_of(args.scene, args.ground, args.images, done.recipe.seed);
        if (!bake) return tl::unexpected(bake.error());
        auto added = bake_wang_ldi::add_scene(*writer, done, args.images, *bake, common);
        if (!added) return tl::unexpected(added.error());
        reports.scene = std::move(*added);
        bake_wang_ldi::add_scene_options_in_words(args.scene, args.images, bake->view, *provenance);
    }
    if (args.makes_no_file()) return 0;
    if (auto added = writer->add_provenance(*provenance); !added) return tl::unexpected(added.error());
    auto bytes = writer->commit();
    if (!bytes) return bytes;
    reports.images.parts.remove_all(reports.images.part_count);
    if (!args.has_scene()) return bytes;
    auto file = container::Reader::open(args.ground.output);
    if (!file) return tl::unexpected(file.error());
    reports.scene_bytes = wang_ldi::stored_bytes_of_scene_image(*file);
    return bytes;
}

int bake(const Args& args, const command::Common& common) {
    std::error_code is_no_file;
    const std::string& output = args.ground.output;
    if (std::filesystem::equivalent(args.ground.recipe, output, is_no_file))
        return command::fail(
            kName, Error{Exit::bad_command, fmt::format("{}: is read and would be overwritten; give another --output", output)});
    // What the command line says wrongly is said before anything is done.
    if (auto bake = bake_wang_ldi::image_bake_of(args.images, output, 1); !bake) return command::fail(kName, bake.error());
    if (auto scene = bake_wang_ldi::scene_bake_of(args.scene, args.ground, args.images, 1); !scene)
        return command::fail(kName, scene.error());
    auto done = bake_wang_ldi::make_ground(args.ground, common);
    if (!done) return command::fail(kName, done.error());
    Reports reports;
    auto bytes = write_file(args, *done, common, reports);
    if (!bytes) return command::fail(kName, bytes.error());
    bake_wang_ldi::report_ground(args.ground, *done, *bytes, args.has_images() ? &reports.images : nullptr,
                                 args.has_scene() ? &reports.scene : nullptr, reports.scene_bytes, common);
    return int(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Bakes plants into ground of Wang tiles: a few plots that cover any terrain without repeating.", kName);
    command::Common common;
    Args args;
    bake_wang_ldi::add_ground_options(app, args.ground);
    bake_wang_ldi::add_image_options(app, args.images);
    bake_wang_ldi::add_scene_options(app, args.scene);
    command::add_common(app, common, command::Uses::seed | command::Uses::memory);
    return command::run(app, common, argc, argv, [&] {
        args.ground.has_seed = app.count("--seed") > 0;
        bake_wang_ldi::note_scene_options(app, args.scene);
        return bake(args, common);
    });
}
