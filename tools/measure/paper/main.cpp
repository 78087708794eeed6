// reproduce PAPER: flies what a paper's experiments fly, and writes its figures anew.

#include <CLI/CLI.hpp>

#include "tools/measure/paper/caveclod/verb.h"
#include "tools/measure/paper/fsi/verb.h"
#include "tools/measure/paper/lod_sprite/verb.h"
#include "tools/measure/paper/wang_ldi/verb.h"

int main(int argc, char** argv) {
    using namespace overlook;
    namespace paper = measure::paper;
    CLI::App app("Runs the experiments of a paper anew and writes its figures beside ours", "reproduce");
    app.require_subcommand(1);
    command::Common common;
    paper::sprite::PaperOptions sprite_options;
    paper::cameras::PaperOptions cameras_options;
    paper::fsi::PaperOptions fsi_options;
    paper::wang::PaperOptions wang_options;
    CLI::App* sprite = paper::sprite::add_verb(app, sprite_options);
    CLI::App* cameras = paper::cameras::add_verb(app, cameras_options);
    CLI::App* fsi = paper::fsi::add_verb(app, fsi_options);
    CLI::App* wang = paper::wang::add_verb(app, wang_options);
    for (CLI::App* verb : {sprite, cameras, fsi, wang}) command::add_common(*verb, common);
    return command::run(app, common, argc, argv, [&] {
        std::vector<std::string> words(argv, argv + argc);
        words[0] = "reproduce";
        Result<void> done = sprite->parsed()    ? paper::sprite::run_paper(sprite_options, words, common)
                            : cameras->parsed() ? paper::cameras::run_paper(cameras_options, words, common)
                            : fsi->parsed()     ? paper::fsi::run_paper(fsi_options, words, common)
                                                : paper::wang::run_paper(wang_options, words, common);
        return done ? int(Exit::done) : command::fail("reproduce " + words[1], done.error());
    });
}
