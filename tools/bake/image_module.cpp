#include "tools/bake/image_module.h"

#include <dlfcn.h>

#include <cstring>
#include <filesystem>
#include <system_error>

namespace overlook {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "overlook_images.so";
constexpr const char* kEntry = "overlook_image_library";

// The loader's reason for the last failure, which ends without a line break.
std::string loader_reason() {
    const char* reason = dlerror();
    return reason ? reason : "no reason given";
}

// Opens one file for as long as the process lives: OpenImageIO's threads and what it registered cannot be taken back.
Result<const ImageLibrary*> open_module(const std::string& path) {
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module)
        return impossible("{} cannot be loaded: {}; install what it names (Debian: libopenimageio2.4)", path, loader_reason());
    auto entry = reinterpret_cast<decltype(&overlook_image_library)>(dlsym(module, kEntry));
    if (!entry) return impossible("{} is no module of Overlook's: {}; install it anew (cmake --install)", path, loader_reason());
    const ImageLibrary* library = entry();
    if (std::strcmp(library->version, OVERLOOK_VERSION) != 0)
        return impossible("{} is of Overlook {}, this is {}; install both from one build (cmake --install)", path,
                          library->version, OVERLOOK_VERSION);
    return library;
}

}  // namespace

Result<const ImageLibrary*> open_image_library(const std::string& program_folder) {
    const fs::path beside = program_folder;
    const fs::path installed = (beside / OVERLOOK_MODULES_FROM_PROGRAMS).lexically_normal();
    for (const fs::path& folder : {beside, installed}) {
        std::error_code ignored;
        if (fs::exists(folder / kModule, ignored)) return open_module((folder / kModule).string());
    }
    return impossible("{}, which reads and writes pictures, is neither in {} nor in {}; install Overlook whole (cmake --install)",
                      kModule, beside.string(), installed.string());
}

Result<const ImageLibrary*> image_library() {
    static const Result<const ImageLibrary*> kOpened = []() -> Result<const ImageLibrary*> {
        std::error_code problem;
        const fs::path program = fs::read_symlink("/proc/self/exe", problem);
        if (problem) return impossible("{} is not found: /proc/self/exe: {}; mount /proc", kModule, problem.message());
        return open_image_library(program.parent_path().string());
    }();
    return kOpened;
}

}  // namespace overlook
