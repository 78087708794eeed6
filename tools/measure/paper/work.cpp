#include "tools/measure/paper/work.h"

#include <filesystem>
#include <thread>

#include "tools/measure/page_text.h"

namespace overlook::measure::paper {

Result<void> make_folders(const std::string& out, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        std::error_code problem;
        std::filesystem::create_directories(out + "/" + name, problem);
        if (problem) return cannot_write("{}/{}: cannot make the folder: {}", out, name, problem.message());
    }
    return {};
}

RunSetup setup_here(const gl::Renderer& renderer, uint32_t width_px, uint32_t height_px, const std::vector<std::string>& words) {
    RunSetup setup;
    setup.version = command::version();
    setup.command = words;
    setup.processor = processor_name();
    setup.processor_threads = std::thread::hardware_concurrency();
    setup.renderer = renderer;
    setup.width_px = width_px;
    setup.height_px = height_px;
    return setup;
}

std::string machine_html(const RunSetup& setup) {
    std::string software = setup.renderer.is_software ? " <strong class=\"software\">software OpenGL</strong>" : "";
    return fmt::format("{}{}; {}, {} threads; Overlook {}", escaped(setup.renderer.name), software, escaped(setup.processor),
                       setup.processor_threads, escaped(setup.version));
}

}  // namespace overlook::measure::paper
