// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/file_stream.hpp"

namespace crackle {

namespace {

/// The process that has locked a folder, according to /proc/locks; empty if it is not listed there.
std::string holder_of(int descriptor) {
    struct stat folder = {};
    if (::fstat(descriptor, &folder) != 0) return "";
    std::ifstream locks("/proc/locks");
    std::string number, kind, advisory, access, process, place;
    for (std::string line; std::getline(locks, line);) {
        std::istringstream words(line);
        words >> number >> kind >> advisory >> access >> process >> place;
        if (kind == "FLOCK" && place.ends_with(fmt::format(":{}", folder.st_ino)))
            return fmt::format(" (process {})", process);
    }
    return "";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, Hold hold)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0) refuse_output(folder);
    if (::flock(descriptor_, (hold == Hold::to_read ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return;
    const int reason = errno;
    const std::string holder = reason == EWOULDBLOCK ? holder_of(descriptor_) : "";
    ::close(descriptor_);
    errno = reason;
    if (reason != EWOULDBLOCK) refuse_output(folder);
    throw OutputError(
        fmt::format("{}: another crackle{} is writing here, expected an unused folder; wait for it, or choose another "
                    "folder with -o",
                    folder.string(), holder));
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);  // closing the file releases the lock
}

}  // namespace crackle
