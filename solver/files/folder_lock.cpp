// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {

FolderLock::FolderLock(const std::filesystem::path& folder, Hold hold)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0) refuse_output(folder);
    if (::flock(descriptor_, (hold == Hold::to_read ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return;
    const int reason = errno;
    ::close(descriptor_);
    errno = reason;
    if (reason != EWOULDBLOCK) refuse_output(folder);
    throw InputError(fmt::format(
        "{}: another crackle is writing here, expected a folder of one's own; wait for it, or choose another -o",
        folder.string()));
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);  // which unlocks
}

}  // namespace crackle
