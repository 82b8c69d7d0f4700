// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/scratch_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <utility>

#include "solver/files/replace_file.hpp"

namespace crackle {

ScratchFile::ScratchFile(std::filesystem::path folder) : folder_(std::move(folder)), descriptor_(-1) {
    // A name for as long as it takes to remove it: not every file system makes files without one.
    std::string name = (folder_ / "scratch.").string() + std::string(6, 'X');  // for mkostemp() to fill in
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) refuse();
    ::unlink(name.c_str());
}

ScratchFile::~ScratchFile() { ::close(descriptor_); }

void ScratchFile::refuse() const { refuse_output(folder_); }

void ScratchFile::write(std::size_t at, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) refuse();
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void ScratchFile::read(std::size_t at, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t done = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) refuse();
        if (done == 0) {  // beyond what was written
            std::ranges::fill(bytes, std::byte{});
            return;
        }
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

}  // namespace crackle
