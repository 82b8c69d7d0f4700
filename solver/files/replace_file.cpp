// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/replace_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {

void refuse_output(const std::filesystem::path& path) {
    throw OutputError(fmt::format("{}: cannot be written ({}), expected a writable folder with room on the disc",
                                  path.string(), std::strerror(errno)));
}

namespace {

/// @return what the system says of it, 0: done
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
    if (errno != 0 && errno != EINVAL) refuse_output(here);  // EINVAL: a file system that knows no such thing
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error) return;
    errno = error.value();
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

void refuse_replacing(const std::filesystem::path& output, bool force, std::span<const std::filesystem::path> inputs) {
    if (!is_there(output)) return;
    std::error_code error;
    for (const std::filesystem::path& input : inputs) {
        if (std::filesystem::equivalent(output, input, error) && !error) {
            throw InputError(
                fmt::format("{}: found an input of the same command, expected another file to write", output.string()));
        }
    }
    if (!force) {
        throw InputError(fmt::format(
            "{}: found there already, expected a new file; choose another name, or add --force to replace it",
            output.string()));
    }
}

void replace_file(const std::filesystem::path& path, const std::string& contents) {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    errno = 0;
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    file.close();
    const int reason = !file ? errno : bring_to_disc(temporary);
    std::error_code error;
    if (!file || reason != 0) {
        std::filesystem::remove(temporary, error);
        errno = reason;
        refuse_output(path);
    }
    std::filesystem::rename(temporary, path, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw OutputError(fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    }
    bring_names_to_disc(path.parent_path());
}

}  // namespace crackle
