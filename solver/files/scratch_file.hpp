// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that wait on the disc instead of in memory, in files that have no name and are gone with the process.
// Tested by tests/solver/files/scratch_file_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <type_traits>
#include <vector>

namespace crackle {

class ScratchFile {
  public:
    /// @throws InputError if the folder takes no file, or keeps its name
    explicit ScratchFile(std::filesystem::path folder);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile();

    /// @throws InputError where the disc is full or fails; so do the others
    void write(std::size_t at, std::span<const std::byte> bytes);
    /// What was never written reads as 0.
    void read(std::size_t at, std::span<std::byte> bytes) const;
    /// A file system over a network may find only now that it has no room, and would read back zeros.
    void bring_to_disc() const;

  private:
    std::filesystem::path folder_;
    int descriptor_;
};

/// An array of which a stretch at a time is in memory: quick where one element comes after the other.
template <class T>
class ScratchArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    explicit ScratchArray(const std::filesystem::path& folder) : file_(folder) {}

    std::size_t size() const { return size_; }
    void resize(std::size_t count) {
        size_ = count;
        begin_ = 0;
        stretch_.clear();
    }
    void assign(std::size_t count, const T& value) {
        generate(count, [&](std::size_t) { return value; });
    }
    /// Puts value(k) everywhere, one after the other: nothing is read.
    template <class Value>
    void generate(std::size_t count, Value&& value) {
        resize(count);
        for (std::size_t begin = 0; begin < count; begin += most) {
            move_to(begin, false);
            for (std::size_t k = 0; k < stretch_.size(); ++k) stretch_[k] = value(begin + k);
        }
    }
    /// Valid until another element is asked for.
    T& operator[](std::size_t k) {
        if (k < begin_ || k >= begin_ + stretch_.size()) move_to(k, true);
        return stretch_[k - begin_];
    }
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
    std::vector<T> stretch_;  // from begin_ on
};

}  // namespace crackle
