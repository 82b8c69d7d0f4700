// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/replace_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"

namespace crackle {

void refuse_output(const std::filesystem::path& path) {
    throw InputError(fmt::format("{}: cannot be written ({}), expected a writable folder with room on the disc",
                                 path.string(), std::strerror(errno)));
}

void bring_to_disc(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) refuse_output(path);
    const int failed = ::fsync(file);
    const int reason = errno;
    ::close(file);
    errno = reason;
    if (failed != 0) refuse_output(path);
}

void replace_file(const std::filesystem::path& path, const std::string& contents, Durable durable) {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    errno = 0;
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    file.close();
    std::error_code error;
    if (!file) {
        const int reason = errno;
        std::filesystem::remove(temporary, error);
        errno = reason;
        refuse_output(path);
    }
    if (durable == Durable::yes) bring_to_disc(temporary);
    std::filesystem::rename(temporary, path, error);
    if (error) throw InputError(fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    if (durable == Durable::yes) bring_to_disc(path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace crackle
