// SPDX-License-Identifier: GPL-3.0-or-later
// An output stream to a file. It does not follow symbolic links, and it records why writing failed.
// Tested by tests/solver/files/new_file_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <utility>
#include <vector>

namespace crackle {

/// Throws the error «path: cannot be written (reason)», with the reason from errno. @throws OutputError, SystemFailure
[[noreturn]] void refuse_output(const std::filesystem::path& path);

/// Refuses a path that exists and is not a plain file. @throws OutputError for example for a symbolic link, a folder or
/// a device
void refuse_no_plain_file(const std::filesystem::path& path);

/// Stream buffer that writes to a file descriptor and stores errno of the first failure.
class DescriptorBuffer : public std::streambuf {
  public:
    /// @param bytes size of the buffer
    explicit DescriptorBuffer(std::size_t bytes) : bytes_(bytes) {}
    DescriptorBuffer(const DescriptorBuffer&) = delete;
    DescriptorBuffer& operator=(const DescriptorBuffer&) = delete;
    ~DescriptorBuffer() override { close(); }

    /// Directs output to an open descriptor and takes ownership of it.
    void attach(int descriptor);
    /// The file descriptor; -1 if no file is open.
    int descriptor() const { return descriptor_; }
    int error() const { return error_; }  ///< errno of the first failure; 0 if there was none
    /// Writes the buffer and closes the file. @return whether everything was written
    bool close();

  private:
    int_type overflow(int_type letter) override;
    int sync() override;
    std::streamsize xsputn(const char* bytes, std::streamsize count) override;
    bool write_all(const char* bytes, std::size_t count);
    bool write_buffer();

    std::vector<char> bytes_;
    int descriptor_ = -1;
    int error_ = 0;
};

/// Output stream to a file. require_written() reports a failure with the reason that the operating system gave.
class FileStream : public std::ostream {
  public:
    /// What happens to the existing contents of the file.
    enum class Opening : bool {
        fresh,     ///< removes existing contents
        appending  ///< appends to existing contents
    };

    explicit FileStream(std::size_t buffer_bytes = 8192) : std::ostream(nullptr), buffer_(buffer_bytes) {
        rdbuf(&buffer_);
        setstate(badbit);  // the stream cannot be used until a file is opened
    }
    /// Opens a file. @throws OutputError, SystemFailure if it cannot be opened; a symbolic link is refused, and the
    /// message says so
    void open(const std::filesystem::path& path, Opening opening);
    /// Uses the descriptor of a file that is already open.
    void attach(int descriptor);
    /// Writes the buffered output and closes the file; a failure sets the stream's badbit.
    void close();

    /// The file descriptor; -1 if no file is open.
    int descriptor() const { return buffer_.descriptor(); }
    /// Checks that all output was written. @param shown name of the file in messages @throws OutputError, SystemFailure
    void require_written(const std::filesystem::path& shown) const;

  private:
    DescriptorBuffer buffer_;
};

}  // namespace crackle
