// A disk that is soon full, for tests of what happens then.
#pragma once

#include <sched.h>
#include <sys/mount.h>

#include <string>

namespace overlook {

// Mounts an empty disk of `size` ("256k") over a folder where only this process sees it; false where the system does not allow
// it. In a chroot "/" is no mount of its own and cannot be made private; then the folder is made one first.
inline bool mount_small_disk(const std::string& folder, const std::string& size) {
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    const char* path = folder.c_str();
    bool is_private =
        mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 ||
        (mount(path, path, nullptr, MS_BIND, nullptr) == 0 && mount(nullptr, path, nullptr, MS_PRIVATE, nullptr) == 0);
    return is_private && mount("tmpfs", path, "tmpfs", 0, ("size=" + size).c_str()) == 0;
}

inline void unmount_small_disk(const std::string& folder) {
    while (umount(folder.c_str()) == 0) continue;
}

}  // namespace overlook
