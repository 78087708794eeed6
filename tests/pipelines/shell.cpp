#include "tests/pipelines/shell.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace overlook::shell {

Ran run(const std::string& script, const std::string& folder) {
    Scratch scratch;
    std::string file = scratch.path() + "/script";
    write_file(file, "export PATH='" OVERLOOK_BINARY_DIR "/bin':\"$PATH\"\ncd '" + folder + "'\n" + script + "\n");
    std::FILE* pipe = popen(("bash -e '" + file + "' 2>&1 </dev/null").c_str(), "r");
    if (!pipe) throw std::runtime_error("cannot start bash");
    Ran ran;
    char part[4096];
    while (size_t count = std::fread(part, 1, sizeof part, pipe)) ran.output.append(part, count);
    int status = pclose(pipe);
    ran.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ran;
}

Scratch::Scratch() {
    path_ = (std::filesystem::temp_directory_path() / "overlook-test.XXXXXX").string();
    if (!mkdtemp(path_.data())) throw std::runtime_error("cannot make a folder: " + path_);
}

Scratch::~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string& path, const std::string& text) {
    std::ofstream out(path, std::ios::binary);
    out << text;
    if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace overlook::shell
