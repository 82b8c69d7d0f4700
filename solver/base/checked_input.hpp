// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the output of cereal::BinaryOutputArchive without trusting it. A length that exceeds the rest of the stream is
// an error, detected before memory is allocated. A flag other than 0 or 1 is an error, detected before it is used.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cereal/archives/binary.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ios>
#include <istream>
#include <string>
#include <type_traits>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"

namespace crackle {

/// A cereal archive that refuses lengths greater than the rest of the stream.
class CheckedInput : public cereal::InputArchive<CheckedInput, cereal::AllowEmptyClassElision> {
  public:
    /// Reads from the current position of the stream to `end`. @param refusal complete message of the InputError
    CheckedInput(std::istream& in, std::streamoff end, std::string refusal)
        : InputArchive(this),
          in_(in),
          left_(in ? std::max<std::streamoff>(0, end - in.tellg()) : 0),
          refusal_(std::move(refusal)) {}

    /// Reads `bytes` bytes from the stream. @throws InputError with the message `refusal` if fewer are left;
    /// SystemFailure if reading fails
    template <class T>
    void read(T* to, std::size_t bytes) {
        errno = 0;
        if (bytes > static_cast<std::size_t>(left_)) refuse();
        const auto count = static_cast<std::streamsize>(bytes);
        if constexpr (std::is_same_v<T, bool>) {
            for (std::size_t k = 0; k < bytes; ++k) {
                const int byte = in_.rdbuf()->sbumpc();
                if (byte != 0 && byte != 1) refuse();
                to[k] = byte == 1;
            }
        } else if (in_.rdbuf()->sgetn(reinterpret_cast<char*>(to), count) != count) {
            refuse();
        }
        left_ -= count;
    }

    /// Number of bytes up to the end.
    std::streamoff left() const { return left_; }

    /// Checks that `count` items of at least one byte each fit into the rest of the stream. @throws InputError
    void expect(std::uint64_t count) const {
        errno = 0;
        if (count > static_cast<std::uint64_t>(left_)) refuse();
    }

    /// Throws the InputError, and includes the reason that the operating system gave, if any.
    [[noreturn]] void refuse() const {
        fail_reading(errno, errno == 0 ? refusal_ : refusal_ + " (" + std::strerror(errno) + ')');
    }

  private:
    std::istream& in_;
    std::streamoff left_;  // bytes
    std::string refusal_;
};

// cereal finds the following functions by argument-dependent lookup, so they are in the archive's namespace.
/// Reads one number or flag; called by cereal. @throws InputError with the message given to CheckedInput
template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> load(CheckedInput& in, T& value) {
    in.read(&value, sizeof value);
}
/// Reads the value of a name-value pair; the stream does not contain the name.
template <class T>
void serialize(CheckedInput& in, cereal::NameValuePair<T>& named) {
    in(named.value);
}
/// Reads the length of a container. @throws InputError if the rest of the stream cannot hold that many elements
template <class T>
void serialize(CheckedInput& in, cereal::SizeTag<T>& length) {
    in(length.size);
    in.expect(length.size);
}
/// Reads a block of bytes.
template <class T>
void load(CheckedInput& in, cereal::BinaryData<T>& data) {
    in.read(static_cast<std::decay_t<T>>(data.data), static_cast<std::size_t>(data.size));
}

}  // namespace crackle

// cereal requires this to read enumerations
template <>
struct cereal::traits::detail::get_output_from_input<crackle::CheckedInput> {
    using type = BinaryOutputArchive;
};
