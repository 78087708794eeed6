// Runs what a person would type, for tests of pipelines and documents.
#pragma once

#include <string>

namespace overlook::shell {

struct Ran {
    int exit = -1;
    std::string output;  // stdout and stderr together
};
// Runs bash -e on `script` in `folder`, the commands of this build first on the PATH, with no stdin.
Ran run(const std::string& script, const std::string& folder);

// A new empty folder that is removed with everything in it.
class Scratch {
  public:
    Scratch();
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);

}  // namespace overlook::shell
