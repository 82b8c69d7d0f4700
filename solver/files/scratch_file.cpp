// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/scratch_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "solver/base/system_failure.hpp"
#include "solver/files/file_stream.hpp"
#include "solver/files/new_file.hpp"

namespace crackle {

ScratchFile::ScratchFile(std::filesystem::path folder) : folder_(std::move(folder)), descriptor_(-1) {
    // The file has a name only until it is unlinked below, since not every file system can create unnamed files.
    const TemporaryFile file = make_temporary(folder_, folder_);
    descriptor_ = file.descriptor;
    if (::unlink(file.path.c_str()) == 0) return;
    const int reason = errno;
    ::close(descriptor_);
    fail_writing(
        reason,
        fmt::format(
            "{}: cannot be removed ({}), expected a folder in which files can be removed; the file is empty, remove it",
            file.path.string(), std::strerror(reason)));
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
            fail_reading(errno, fmt::format("{}: an unnamed temporary file in this folder cannot be read ({})",
                                            folder_.string(), std::strerror(errno)));
        if (done == 0) {  // the position is beyond the end of the data written
            std::ranges::fill(bytes, std::byte{});
            return;
        }
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void ScratchFile::bring_to_disc() const {
    if (::fdatasync(descriptor_) != 0 && errno != EINVAL)  // EINVAL: not supported by this file system
        refuse_output(folder_);
}

}  // namespace crackle
