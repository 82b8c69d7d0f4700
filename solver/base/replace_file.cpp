// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/replace_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"

namespace crackle {

void refuse_output(const std::filesystem::path& path) {
    throw InputError(fmt::format("{}: cannot be written ({}), expected a writable folder with room on the disc",
                                 path.string(), std::strerror(errno)));
}

void replace_file(const std::filesystem::path& path, const std::string& contents) {
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
    std::filesystem::rename(temporary, path, error);
    if (error) throw InputError(fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
}

}  // namespace crackle
