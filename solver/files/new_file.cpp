// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/new_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <string>
#include <system_error>
#include <utility>

#include "solver/base/system_failure.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t digits_of_a_name = 16;
constexpr std::size_t buffer_bytes = std::size_t{1}
                                     << 18;  // a large buffer, since pictures are written in pieces of a few bytes
constexpr std::time_t seconds_of_an_old_one = 60;

std::string drawn_name(const fs::path& shown) {
    std::uint64_t number = 0;
    if (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) refuse_output(shown);
    return fmt::format("{:016x}{}", number, temporary_suffix);
}

/// Whether a file was left by an interrupted process of this user. Locks it, unless a running process holds the lock.
bool is_left_behind(int descriptor, Leftovers which) {
    struct stat found = {};
    return ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_uid == ::geteuid() &&
           (which == Leftovers::all || std::time(nullptr) - found.st_mtime > seconds_of_an_old_one) &&
           ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

}  // namespace

bool is_temporary_name(const std::string& name) {
    return name.size() == digits_of_a_name + temporary_suffix.size() && name.ends_with(temporary_suffix) &&
           name.find_first_not_of("0123456789abcdef") == digits_of_a_name;
}

TemporaryFile make_temporary(const fs::path& folder, const fs::path& shown) {
    while (true) {
        fs::path path = folder / drawn_name(shown);
        const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST) continue;
        if (descriptor < 0) refuse_output(shown);
        // Not every file system supports locks. Without a lock, the file is protected by its age for a minute, or by
        // the lock on its folder.
        struct stat made = {};
        const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        if (::fstat(descriptor, &made) != 0) {
            const int reason = errno;
            ::unlink(path.c_str());
            ::close(descriptor);
            errno = reason;
            refuse_output(shown);
        }
        if (locked && made.st_nlink > 0) return {std::move(path), descriptor};
        ::close(descriptor);  // another process removed the file as a leftover before it was locked
    }
}

NewFile::NewFile(fs::path path) : path_(std::move(path)), stream_(buffer_bytes) {
    refuse_no_plain_file(path_);
    TemporaryFile file = make_temporary(path_.parent_path(), path_);
    temporary_ = std::move(file.path);
    stream_.attach(file.descriptor);
}

NewFile::~NewFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void NewFile::flush() {
    stream_.flush();
    stream_.require_written(path_);
}

void NewFile::bring_to_disc() {
    flush();
    if (::fsync(stream_.descriptor()) != 0 && errno != EINVAL)  // EINVAL: not supported by this file system
        refuse_output(path_);
}

void NewFile::take_name() {
    stream_.close();
    stream_.require_written(path_);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        const int reason = errno;
        fail_writing(reason, fmt::format("{}: cannot be replaced ({})", path_.string(), std::strerror(reason)));
    }
    temporary_.clear();
}

void remove_leftovers(const fs::path& folder, Leftovers which) {
    std::error_code unreadable;  // failures are ignored, since nothing depends on the removal
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, unreadable), end; !unreadable && entry != end;
         entry.increment(unreadable)) {
        const fs::path& path = entry->path();
        if (!is_temporary_name(path.filename().string())) continue;
        const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (is_left_behind(descriptor, which)) ::unlink(path.c_str());
        ::close(descriptor);
    }
}

}  // namespace crackle
