// SPDX-License-Identifier: GPL-3.0-or-later
// Any struct that lists its fields (fields.hpp), through cereal's archives: one member after the other, since padding
// has no defined value.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include "solver/base/fields.hpp"

namespace crackle {

template <class Archive, HasFields T>
void serialize(Archive& archive, T& value) {
    static_assert(lists_all_fields<T>(), "a member is missing in the struct's fields()");
    T::fields(value, [&](const char* /*name*/, auto& field, const auto&... /*more*/) { archive(field); });
}

}  // namespace crackle
