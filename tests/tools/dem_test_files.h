// Files that the tests of the bakers' input write and read.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tools/bake/dem.h"

namespace overlook::test {

// A folder of this test alone, gone with it.
class Scratch {
  public:
    Scratch() {
        std::string pattern = (std::filesystem::temp_directory_path() / "overlook-input-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    std::string path(const std::string& name) const { return folder_ + "/" + name; }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }

  private:
    std::string folder_;
};

inline std::string file_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// A file of the shared test data; empty if there is none here.
inline std::string data_file(const std::string& name) {
    const char* folder = std::getenv("OVERLOOK_DATA");
    return folder ? std::string(folder) + "/" + name : "";
}

// The reading of `path` fails with `exit`, in one line that names the file and holds `words`, and prints nothing.
inline void expect_refused(const std::string& path, const dem::Options& options, Exit exit, const std::string& words) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const Result<dem::Raster> raster = dem::open(path, options);
    const std::string out = testing::internal::GetCapturedStdout(), err = testing::internal::GetCapturedStderr();
    EXPECT_EQ(out + err, "") << path;
    ASSERT_FALSE(raster.has_value()) << path;
    EXPECT_EQ(int(raster.error().exit), int(exit)) << raster.error().message;
    EXPECT_EQ(raster.error().message.find('\n'), std::string::npos) << raster.error().message;
    EXPECT_NE(raster.error().message.find(path), std::string::npos) << raster.error().message;
    EXPECT_NE(raster.error().message.find(words), std::string::npos) << raster.error().message;
}

#define OVERLOOK_NEED_DATA(path) \
    if ((path).empty()) GTEST_SKIP() << "OVERLOOK_DATA names no folder of test data"

}  // namespace overlook::test
