// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/replace_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "solver/files/file_stream.hpp"
#include "solver/files/new_file.hpp"

namespace crackle {

namespace {

/// Flushes a file or folder to the disc. @return errno of the failed call, or 0 for success
int bring_to_disc(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const int reason = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    return reason;
}

}  // namespace

void bring_names_to_disc(const std::filesystem::path& folder) {
    const std::filesystem::path here = folder.empty() ? "." : folder;
    errno = bring_to_disc(here);
    if (errno != 0 && errno != EINVAL) refuse_output(here);  // EINVAL: not supported by this file system
}

// std::filesystem::create_directories() is not used, because it queries each folder first and gives up if a query
// fails.
void make_folder(const std::filesystem::path& folder) {
    if (::mkdir(folder.c_str(), 0777) == 0) return;
    if (errno == ENOENT && folder.has_parent_path() && folder.parent_path() != folder) {
        make_folder(folder.parent_path());
        if (::mkdir(folder.c_str(), 0777) == 0) return;
    }
    struct stat found = {};
    if (errno == EEXIST && ::stat(folder.c_str(), &found) == 0) {
        if (S_ISDIR(found.st_mode)) return;
        errno = ENOTDIR;
    }
    refuse_output(folder);
}

void bring_all_to_disc(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) refuse_output(folder);
    const int reason = ::syncfs(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    errno = reason;
    if (reason != 0) refuse_output(folder);
}

void replace_file(const std::filesystem::path& path, const std::string& contents) {
    NewFile file(path);
    file.stream().write(contents.data(), static_cast<std::streamsize>(contents.size()));
    file.bring_to_disc();
    file.take_name();
    bring_names_to_disc(path.parent_path());
}

}  // namespace crackle
