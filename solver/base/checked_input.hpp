// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what cereal::BinaryOutputArchive wrote and trusts none of it: a length that the rest of the stream cannot
// hold, or a flag that is neither 0 nor 1, is an error before memory is taken for it or anybody looks at it.
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

namespace crackle {

class CheckedInput : public cereal::InputArchive<CheckedInput, cereal::AllowEmptyClassElision> {
  public:
    /// From where the stream stands up to `end`. @param refusal whole text of the InputError
    CheckedInput(std::istream& in, std::streamoff end, std::string refusal)
        : InputArchive(this),
          in_(in),
          left_(in ? std::max<std::streamoff>(0, end - in.tellg()) : 0),
          refusal_(std::move(refusal)) {}

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

    /// A length, of things of at least a byte each.
    void expect(std::uint64_t count) const {
        errno = 0;
        if (count > static_cast<std::uint64_t>(left_)) refuse();
    }

    /// With the system's reason where there is one.
    [[noreturn]] void refuse() const {
        throw InputError(errno == 0 ? refusal_ : refusal_ + " (" + std::strerror(errno) + ')');
    }

  private:
    std::istream& in_;
    std::streamoff left_;  // bytes
    std::string refusal_;
};

// What cereal calls, found by the namespace of the archive.
template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> load(CheckedInput& in, T& value) {
    in.read(&value, sizeof value);
}
template <class T>
void serialize(CheckedInput& in, cereal::NameValuePair<T>& named) {
    in(named.value);
}
template <class T>
void serialize(CheckedInput& in, cereal::SizeTag<T>& length) {
    in(length.size);
    in.expect(length.size);
}
template <class T>
void load(CheckedInput& in, cereal::BinaryData<T>& data) {
    in.read(static_cast<std::decay_t<T>>(data.data), static_cast<std::size_t>(data.size));
}

}  // namespace crackle

// Cereal asks for it where enumerations are read.
template <>
struct cereal::traits::detail::get_output_from_input<crackle::CheckedInput> {
    using type = BinaryOutputArchive;
};
