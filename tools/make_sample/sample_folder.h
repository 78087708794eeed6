// The folder that a sample is written into.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/result.h"

namespace overlook::sample {

class SampleFolder {
  public:
    // Makes it where there is none. Fails with Exit::cannot_write: "out/a: cannot make the folder: Permission denied".
    static Result<SampleFolder> make(const std::string& path);

    // A file of a bare name. Fails as write_file.
    Result<void> write(const std::string& name, std::span<const std::byte> bytes);
    Result<void> write(const std::string& name, std::string_view text);
    // Names and what is in them.
    Result<void> write(std::span<const std::pair<std::string, std::string>> texts);

    // Paths of what was written, in that order.
    const std::vector<std::string>& files() const { return files_; }

  private:
    std::string path_;
    std::vector<std::string> files_;
};

}  // namespace overlook::sample
