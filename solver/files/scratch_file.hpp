// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers stored on disc instead of in memory, in unnamed files that are deleted when the process ends.
// Tested by tests/solver/files/scratch_file_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <type_traits>
#include <vector>

namespace crackle {

/// An unnamed file for data that need not be in memory.
class ScratchFile {
  public:
    /// Creates the file. @throws InputError if no file can be created in the folder, or if its name cannot be removed
    explicit ScratchFile(std::filesystem::path folder);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile();

    /// Writes bytes at an offset. @throws InputError if the disc is full or fails; the other functions throw the same
    /// error
    void write(std::size_t at, std::span<const std::byte> bytes);
    /// Reads bytes at an offset. Bytes that were never written are read as 0.
    void read(std::size_t at, std::span<std::byte> bytes) const;
    /// Flushes the data to the disc. A network file system may report only then that it is full; without the flush,
    /// reads could return zeros.
    void bring_to_disc() const;

  private:
    std::filesystem::path folder_;
    int descriptor_;
};

/// An array stored on disc; only one section at a time is in memory. Sequential access is fast.
template <class T>
class ScratchArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    /// Creates an empty array. @throws InputError if no file can be created in the folder
    explicit ScratchArray(const std::filesystem::path& folder) : file_(folder) {}

    /// Number of elements.
    std::size_t size() const { return size_; }
    /// Changes the number of elements. All values must then be set again.
    void resize(std::size_t count) {
        size_ = count;
        begin_ = 0;
        stretch_.clear();
    }
    /// Changes the number of elements and sets each to `value`.
    void assign(std::size_t count, const T& value) {
        generate(count, [&](std::size_t) { return value; });
    }
    /// Changes the number of elements and sets each element k to value(k), in ascending order and without reading the
    /// file.
    template <class Value>
    void generate(std::size_t count, Value&& value) {
        resize(count);
        for (std::size_t begin = 0; begin < count; begin += most) {
            move_to(begin, false);
            for (std::size_t k = 0; k < stretch_.size(); ++k) stretch_[k] = value(begin + k);
        }
    }
    /// Element k. The reference is valid until another element is accessed.
    T& operator[](std::size_t k) {
        if (k < begin_ || k >= begin_ + stretch_.size()) move_to(k, true);
        return stretch_[k - begin_];
    }
    /// Copy of all elements in memory. @throws InputError if the disc is full or fails
    std::vector<T> values() {
        write_stretch();
        file_.bring_to_disc();
        std::vector<T> all(size_);
        file_.read(0, std::as_writable_bytes(std::span(all)));
        return all;
    }

  private:
    static constexpr std::size_t most = (std::size_t{256} << 10) / sizeof(T);

    void write_stretch() { file_.write(begin_ * sizeof(T), std::as_bytes(std::span(stretch_))); }
    void move_to(std::size_t k, bool read) {
        write_stretch();
        begin_ = k / most * most;
        stretch_.resize(std::min(most, size_ - begin_));
        if (read) file_.read(begin_ * sizeof(T), std::as_writable_bytes(std::span(stretch_)));
    }

    ScratchFile file_;
    std::size_t size_ = 0, begin_ = 0;
    std::vector<T> stretch_;  // the section in memory; its first element has index begin_
};

}  // namespace crackle
