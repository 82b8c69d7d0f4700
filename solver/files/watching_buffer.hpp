// SPDX-License-Identifier: GPL-3.0-or-later
// A stream buffer that also passes its output to an observer, for example to hash a file while it is being written.
// Tested by tests/tools/commands/resume_test.cpp.
#pragma once

#include <array>
#include <functional>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <utility>

namespace crackle {

/// Stream buffer that forwards its output to a stream, and passes each piece to a watcher function.
class WatchingBuffer : public std::streambuf {
  public:
    /// @param to stream that receives all output when the buffer is flushed
    /// @param watch function called with each piece of output
    WatchingBuffer(std::ostream& to, std::function<void(std::string_view)> watch) : to_(to), watch_(std::move(watch)) {
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }

  private:
    int_type overflow(int_type letter) override {
        pass_on();
        if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
        return sputc(traits_type::to_char_type(letter));
    }
    int sync() override {
        pass_on();
        return to_.good() ? 0 : -1;
    }
    void pass_on() {
        const std::string_view piece(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        watch_(piece);
        to_.write(piece.data(), static_cast<std::streamsize>(piece.size()));
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }

    std::ostream& to_;
    std::function<void(std::string_view)> watch_;
    std::array<char, 1 << 16> buffer_{};
};

}  // namespace crackle
