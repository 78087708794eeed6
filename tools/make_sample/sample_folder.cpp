#include "tools/make_sample/sample_folder.h"

#include <filesystem>
#include <system_error>

#include "formats/atomic_file.h"

namespace overlook::sample {

Result<SampleFolder> SampleFolder::make(const std::string& path) {
    std::error_code reason;
    std::filesystem::create_directories(path, reason);
    if (reason) return cannot_write("{}: cannot make the folder: {}", path, reason.message());
    SampleFolder folder;
    folder.path_ = path;
    return folder;
}

Result<void> SampleFolder::write(const std::string& name, std::span<const std::byte> bytes) {
    files_.push_back((std::filesystem::path(path_) / name).string());
    return write_file(files_.back(), bytes);
}

Result<void> SampleFolder::write(const std::string& name, std::string_view text) {
    return write(name, std::as_bytes(std::span(text)));
}

Result<void> SampleFolder::write(std::span<const std::pair<std::string, std::string>> texts) {
    for (const auto& [name, text] : texts)
        if (Result<void> written = write(name, std::string_view(text)); !written) return written;
    return {};
}

}  // namespace overlook::sample
