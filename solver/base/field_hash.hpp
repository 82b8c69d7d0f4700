// SPDX-License-Identifier: GPL-3.0-or-later
// XXH3 hash of any value made of numbers and of structs that list their fields (fields.hpp). It covers members and
// excludes padding.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "solver/base/fields.hpp"

namespace crackle {

/// Hash of a sequence of values.
class FieldHasher {
  public:
    FieldHasher() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

    /// Adds a number, an enumerator, or the fields of a struct.
    template <class T>
    void add(const T& value) {
        if constexpr (HasFields<T>) {
            static_assert(lists_all_fields<T>(), "a member is missing from the struct's fields()");
            T::fields(value, [&](const char* /*name*/, const auto& field, const auto&... /*more*/) { add(field); });
        } else {
            static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
            XXH3_64bits_update(state_.get(), &value, sizeof value);
        }
    }
    /// Adds the length of a vector and its elements.
    template <class T, class Room>
    void add(const std::vector<T, Room>& values) {
        add(values.size());
        if constexpr (std::is_arithmetic_v<T>) {
            XXH3_64bits_update(state_.get(), values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) add(value);
        }
    }
    /// Adds the elements of an array. The length of the array is not hashed, since it is part of the type.
    template <class T, std::size_t N>
    void add(const std::array<T, N>& values) {
        for (const T& value : values) add(value);
    }
    /// Adds the elements of a built-in array.
    template <class T, std::size_t N>
    void add(const T (&values)[N]) {
        for (const T& value : values) add(value);
    }
    /// Adds a flag for whether there is a value, and then the value, if any.
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }

    /// Hash of all values added so far.
    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// Hash of one value.
template <class T>
std::uint64_t hash_of_field(const T& field) {
    FieldHasher hash;
    hash.add(field);
    return hash.digest();
}

}  // namespace crackle
