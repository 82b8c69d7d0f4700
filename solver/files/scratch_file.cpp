// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/scratch_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {

ScratchFile::ScratchFile(std::filesystem::path folder) : folder_(std::move(folder)), descriptor_(-1) {
    // A name for as long as it takes to remove it: not every file system makes files without one.
    std::string name = (folder_ / "scratch.").string() + std::string(6, 'X');  // for mkostemp() to fill in
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) refuse_output(folder_);
    if (::unlink(name.c_str()) == 0) return;
    const int reason = errno;
    ::close(descriptor_);
    throw OutputError(
        fmt::format("{}: cannot be removed ({}), expected a folder whose files can be; it holds nothing, remove it",
                    name, std::strerror(reason)));
}

ScratchFile::~ScratchFile() { ::close(descriptor_); }

void ScratchFile::write(std::size_t at, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) refuse_output(folder_);
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void ScratchFile::read(std::size_t at, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t done = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0)
            throw InputError(fmt::format("{}: a file without a name there cannot be read again ({})", folder_.string(),
                                         std::strerror(errno)));
        if (done == 0) {  // beyond what was written
            std::ranges::fill(bytes, std::byte{});
            return;
        }
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void ScratchFile::bring_to_disc() const {
    if (::fdatasync(descriptor_) != 0 && errno != EINVAL)  // EINVAL: a file system that knows no such thing
        refuse_output(folder_);
}

}  // namespace crackle
