#include "formats/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <thread>
#include <vector>

#include "tests/formats/scratch_folder.h"
#include "tests/formats/small_disk.h"

namespace overlook {
namespace {

using Names = std::set<std::string>;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// Runs in a child process, so that limits and signals stay there. The child's exit code, or -signal if one killed it.
int in_child(const std::function<int()>& body) {
    pid_t child = fork();
    if (child == 0) _exit(body());
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

void expect_refused(const std::string& path, const std::string& reason) {
    Result<void> written = write_file(path, "new");
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(written.error().exit, Exit::cannot_write);
    EXPECT_EQ(written.error().message, path + ": cannot write: " + reason);
}

TEST(AtomicFile, AppearsWholeAndAloneOnCommit) {
    ScratchFolder folder;
    Result<AtomicFile> file = AtomicFile::create(folder / "a.ovl");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(bytes_of("hello, ")));
    ASSERT_TRUE(file->append(bytes_of("valley")));
    ASSERT_TRUE(file->write_at(0, bytes_of("H")));
    EXPECT_FALSE(folder.names().contains("a.ovl"));
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(folder.names(), Names{"a.ovl"});
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "Hello, valley");
}

TEST(AtomicFile, LeavesTheOldFileIfNotCommitted) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "a.ovl", "old"));
    {
        Result<AtomicFile> file = AtomicFile::create(folder / "a.ovl");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->append(bytes_of("new")));
    }
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "old");
    EXPECT_EQ(folder.names(), Names{"a.ovl"});
}

TEST(AtomicFile, ReplacesTheOldFileWhole) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "a.ovl", "an old and longer text"));
    ASSERT_TRUE(write_file(folder / "a.ovl", "new"));
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "new");
}

TEST(AtomicFile, MovesWithoutLosingOrKeepingAFile) {
    ScratchFolder folder;
    {
        Result<AtomicFile> first = AtomicFile::create(folder / "a.ovl");
        Result<AtomicFile> second = AtomicFile::create(folder / "b.ovl");
        ASSERT_TRUE(first && second);
        ASSERT_TRUE(first->append(bytes_of("a")));
        AtomicFile moved(std::move(*first));
        *second = std::move(moved);
        ASSERT_TRUE(second->commit());
    }
    EXPECT_EQ(folder.names(), Names{"a.ovl"});
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "a");
}

TEST(AtomicFile, FollowsALinkAndLeavesIt) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "target.ovl", "old"));
    std::filesystem::create_symlink("target.ovl", folder / "link.ovl");
    ASSERT_TRUE(write_file(folder / "link.ovl", "new"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.ovl"));
    EXPECT_EQ(text_of_file(folder / "target.ovl"), "new");
}

TEST(AtomicFile, TakesTheLongestNameThatTheSystemTakes) {
    ScratchFolder folder;
    std::string name(255, 'n');
    ASSERT_TRUE(write_file(folder / name, "new"));
    EXPECT_EQ(folder.names(), Names{name});
    expect_refused(folder / std::string(256, 'n'), "File name too long");
    EXPECT_EQ(folder.names(), Names{name});
}

TEST(AtomicFile, RefusesWhatIsNotAFile) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "file", "old"));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("nothing", folder / "loose");
    Names before = folder.names();

    expect_refused(folder.path(), "Is a directory; give the name of a file in it");
    expect_refused(folder / "new/", "Is a directory; give the name of a file in it");
    expect_refused(folder / "file/a.ovl", "Not a directory");
    expect_refused(folder / "none/a.ovl", "No such file or directory; make the folder " + folder.path() + "/none first");
    expect_refused(folder / "pipe", "is not a regular file; give the name of a file");
    expect_refused(folder / "loose", "is a link that leads nowhere: No such file or directory");
    expect_refused("/dev/full", "is not a regular file; give the name of a file");
    expect_refused("/dev/null", "is not a regular file; give the name of a file");
    expect_refused("-", "the standard output cannot take this file; give a file's name (./- for a file of that name)");
    EXPECT_EQ(folder.names(), before);
    EXPECT_EQ(write_file("", "new").error().message, "(no name): cannot write: the path is empty");
}

TEST(AtomicFile, SurvivesTheFileSizeLimitAndLeavesNothing) {
    ScratchFolder folder;
    std::string path = folder / "a.ovl";
    int code = in_child([&] {
        struct rlimit limit {
            10000, 10000
        };
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
        Result<AtomicFile> file = AtomicFile::create(path);
        std::vector<std::byte> block(6000);
        if (!file || !file->append(block)) return 3;
        Result<void> second = file->append(block);
        if (second || second.error().message != path + ": cannot write: File too large") return 4;
        // What failed once stays failed: half a file is never committed.
        Result<void> committed = file->commit();
        if (committed || committed.error().exit != Exit::cannot_write) return 5;
        *file = AtomicFile();
        return 0;
    });
    EXPECT_EQ(code, 0);
    EXPECT_EQ(folder.names(), Names{});
}

// A disk of 256 KiB, mounted where only the child sees it.
TEST(AtomicFile, SaysThatTheDiskIsFullAndLeavesTheOldFile) {
    ScratchFolder folder;
    constexpr int kCannotMount = 77;
    int code = in_child([&] {
        if (!mount_small_disk(folder.path(), "256k")) return kCannotMount;
        std::string path = folder / "a.ovl";
        if (!write_file(path, "old")) return 2;
        // 200 KiB fit, the next 200 only in part: a short write, then none.
        std::string block(200 * 1024, 'x');
        {
            Result<AtomicFile> file = AtomicFile::create(path);
            if (!file || !file->append(bytes_of(block))) return 3;
            Result<void> second = file->append(bytes_of(block));
            if (second || second.error().message != path + ": cannot write: No space left on device") return 4;
            if (second.error().exit != Exit::cannot_write || file->commit()) return 5;
        }
        if (text_of_file(path) != "old" || folder.names() != Names{"a.ovl"}) return 6;
        unmount_small_disk(folder.path());
        return 0;
    });
    if (code == kCannotMount) GTEST_SKIP() << "this system lets nobody mount a small disk for a test";
    EXPECT_EQ(code, 0);
}

TEST(AtomicFile, CallsOutOfOrderAreOurOwnFault) {
    ScratchFolder folder;
    Result<AtomicFile> file = AtomicFile::create(folder / "a.ovl");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(bytes_of("abc")));
    EXPECT_EQ(file->write_at(2, bytes_of("de")).error().exit, Exit::our_bug);
    EXPECT_EQ(file->write_at(~uint64_t(0), bytes_of("d")).error().exit, Exit::our_bug);
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(file->commit().error().exit, Exit::our_bug);
    EXPECT_EQ(file->append(bytes_of("d")).error().exit, Exit::our_bug);
    EXPECT_EQ(AtomicFile().append(bytes_of("d")).error().exit, Exit::our_bug);
    EXPECT_EQ(text_of_file(folder / "a.ovl"), "abc");
}

extern "C" void remove_and_end(int) {
    remove_unfinished_files();
    _exit(130);
}

TEST(UnfinishedFiles, AreRemovedInASignalHandler) {
    ScratchFolder folder;
    int code = in_child([&] {
        std::signal(SIGTERM, remove_and_end);
        if (!write_file(folder / "whole", "old")) return 2;
        std::vector<AtomicFile> files;
        for (std::string name : {"a", "b", "whole"}) {
            Result<AtomicFile> file = AtomicFile::create(folder / name);
            if (!file || !file->append(bytes_of("new"))) return 3;
            files.push_back(std::move(*file));
        }
        if (folder.names().size() != 4) return 4;
        std::raise(SIGTERM);
        return 5;
    });
    EXPECT_EQ(code, 130);
    EXPECT_EQ(folder.names(), Names{"whole"});
    EXPECT_EQ(text_of_file(folder / "whole"), "old");
}

TEST(UnfinishedFiles, OfAParentAreNotRemovedByItsChild) {
    ScratchFolder folder;
    Result<AtomicFile> file = AtomicFile::create(folder / "a.ovl");
    ASSERT_TRUE(file);
    in_child([] {
        remove_unfinished_files();
        return 0;
    });
    EXPECT_TRUE(file->commit());
}

TEST(UnfinishedFiles, AreCountedAndSlotsGoBack) {
    ScratchFolder folder;
    for (int round = 0; round < 2; round++) {
        std::vector<AtomicFile> files;
        for (int i = 0; i < 64; i++) {
            Result<AtomicFile> file = AtomicFile::create(folder / std::to_string(i));
            ASSERT_TRUE(file) << file.error().message;
            files.push_back(std::move(*file));
        }
        expect_refused(folder / "one more", "64 files are being written already");
        ASSERT_TRUE(files.front().commit());
        ASSERT_TRUE(write_file(folder / "one more", "new"));
    }
    EXPECT_EQ(folder.names(), (Names{"0", "one more"}));
}

TEST(UnfinishedFiles, OfManyThreadsDoNotMix) {
    ScratchFolder folder;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; t++) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 10; i++) {
                EXPECT_TRUE(write_file(folder / std::to_string(t), std::to_string(t)));
                EXPECT_TRUE(write_file(folder / "shared", "whole"));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(folder.names(), (Names{"0", "1", "2", "3", "shared"}));
    EXPECT_EQ(text_of_file(folder / "shared"), "whole");
    for (int t = 0; t < 4; t++) EXPECT_EQ(text_of_file(folder / std::to_string(t)), std::to_string(t));
}

}  // namespace
}  // namespace overlook
