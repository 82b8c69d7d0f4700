// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/file_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "solver/base/system_failure.hpp"

namespace crackle {

void refuse_output(const std::filesystem::path& path) {
    const int reason = errno;
    fail_writing(reason, fmt::format("{}: cannot be written ({}), expected a writable folder with room on the disc",
                                     path.string(), std::strerror(reason)));
}

void refuse_no_plain_file(const std::filesystem::path& path) {
    struct stat found = {};
    if (::lstat(path.c_str(), &found) != 0) {
        if (errno == ENOENT || errno == ENOTDIR) return;  // opening the file reports the error
        refuse_output(path);
    }
    if (S_ISREG(found.st_mode)) return;
    const char* const kind = S_ISLNK(found.st_mode)   ? "a symbolic link"
                             : S_ISDIR(found.st_mode) ? "a folder"
                                                      : "a device or a pipe";
    const char* const remedy =
        S_ISLNK(found.st_mode) ? "; give the name of the file that the link points to, or remove the link" : "";
    fail_writing(EEXIST, fmt::format("{}: found {}, expected a file or nothing{}", path.string(), kind, remedy));
}

void DescriptorBuffer::attach(int descriptor) {
    close();
    descriptor_ = descriptor;
    error_ = 0;
    setp(bytes_.data(), bytes_.data() + bytes_.size());
}

bool DescriptorBuffer::close() {
    if (descriptor_ < 0) return error_ == 0;
    bool whole = write_buffer();
    if (::close(descriptor_) != 0 && whole) {  // a network file system may report only now that it is full
        error_ = errno;
        whole = false;
    }
    descriptor_ = -1;
    setp(nullptr, nullptr);
    return whole;
}

bool DescriptorBuffer::write_all(const char* bytes, std::size_t count) {
    while (count > 0 && error_ == 0) {
        const ssize_t done = ::write(descriptor_, bytes, count);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) {
            error_ = done == 0 ? EIO : errno;
        } else {
            bytes += done;
            count -= static_cast<std::size_t>(done);
        }
    }
    return error_ == 0;
}

bool DescriptorBuffer::write_buffer() {
    const bool whole = write_all(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(bytes_.data(), bytes_.data() + bytes_.size());
    return whole;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type letter) {
    if (descriptor_ < 0 || !write_buffer()) return traits_type::eof();
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    return sputc(traits_type::to_char_type(letter));
}

int DescriptorBuffer::sync() { return descriptor_ >= 0 && write_buffer() ? 0 : -1; }

std::streamsize DescriptorBuffer::xsputn(const char* bytes, std::streamsize count) {
    if (descriptor_ < 0) return 0;
    if (count <= epptr() - pptr()) {
        std::copy_n(bytes, count, pptr());  // the pointer of an empty text may be null
        pbump(static_cast<int>(count));
        return count;
    }
    return write_buffer() && write_all(bytes, static_cast<std::size_t>(count)) ? count : 0;
}

void FileStream::open(const std::filesystem::path& path, Opening opening) {
    refuse_no_plain_file(path);
    const int what = opening == Opening::appending ? O_APPEND : O_TRUNC;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | what, 0666);
    if (descriptor < 0) refuse_output(path);
    attach(descriptor);
}

void FileStream::attach(int descriptor) {
    buffer_.attach(descriptor);
    clear();
}

void FileStream::close() {
    if (!buffer_.close()) setstate(badbit);
}

void FileStream::require_written(const std::filesystem::path& shown) const {
    if (!fail()) return;
    errno = buffer_.error();
    refuse_output(shown);
}

}  // namespace crackle
