// What the runs of all papers share: where they write, how far they are, where they ran.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/result.h"
#include "runtime/command/command.h"
#include "runtime/gl/timer.h"
#include "tools/measure/tables.h"

namespace overlook::measure::paper {

// A part of the whole work, told as a share of it, and how long it took when it is done.
class Part {
  public:
    Part(command::Progress& progress, const command::Common& common, std::string name, double from, double to)
        : progress_(progress), common_(common), name_(std::move(name)), from_(from), to_(to) {}
    ~Part() { command::detail(common_, fmt::format("reproduce: {}: {:.0f} s", name_, timer_.elapsed_ms() / 1000)); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    std::function<void(double)> done() {
        return [this](double share) { progress_.set(from_ + share * (to_ - from_)); };
    }

  private:
    command::Progress& progress_;
    const command::Common& common_;
    std::string name_;
    double from_, to_;
    gl::Timer timer_;
};

// Makes folders of these names in `out`. Fails with Exit::cannot_write.
Result<void> make_folders(const std::string& out, const std::vector<std::string>& names);

// Everything but scene and flight. words: the command as it was typed.
RunSetup setup_here(const gl::Renderer& renderer, uint32_t width_px, uint32_t height_px, const std::vector<std::string>& words);

// "llvmpipe (LLVM 15.0.6, 256 bits) software OpenGL; AMD EPYC, 2 threads; Overlook 0.1.0": HTML.
std::string machine_html(const RunSetup& setup);

}  // namespace overlook::measure::paper
