// SPDX-License-Identifier: GPL-3.0-or-later
// Changes one number at a time in a value made of structs that list their fields. Tests that use it need not know the
// fields.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/fields.hpp"

namespace crackle::testing {

/// Adds one element to every empty vector, and a value to every empty optional.
struct Fill {
    template <class T>
    void add(T& value) {
        if constexpr (HasFields<T>) {
            T::fields(value, [&](const char* /*name*/, auto& field, const auto&... /*more*/) { add(field); });
        }
    }
    template <class T, class Room>
    void add(std::vector<T, Room>& values) {
        if (values.empty()) values.emplace_back();
        for (T& value : values) add(value);
    }
    template <class T>
    void add(std::optional<T>& value) {
        if (!value) value.emplace();
        add(*value);
    }
};

/// Another value of the same type.
template <class T>
void make_other(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
        value = !value;
    } else if constexpr (std::is_enum_v<T>) {
        value = static_cast<T>(static_cast<std::underlying_type_t<T>>(value) ^ 1);
    } else if constexpr (std::is_floating_point_v<T>) {
        value = value == T{1} ? T{2} : T{1};  // NaN becomes 1
    } else {
        static_assert(std::is_integral_v<T>);
        value = static_cast<T>(value ^ 1);
    }
}

/// Changes one number, or the length of one vector or text, among the fields visited.
class Change {
  public:
    /// @param which index of the item to change, in the order of visiting, from 0
    explicit Change(int which) : left_(which) {}

    /// Name of the changed item, such as "bodies.state[0].vx"; empty if there are not that many items.
    const std::string& changed() const { return changed_; }

    template <class T>
    void walk(T& value, const std::string& name) {
        if constexpr (HasFields<T>) {
            T::fields(value, [&](const char* field, auto& member, const auto&... /*more*/) {
                walk(member, name + "." + field);
            });
        } else if (chosen(name)) {
            make_other(value);
        }
    }
    void walk(std::string& text, const std::string& name) {
        if (chosen(name)) text += "x";
    }
    template <class T, class Room>
    void walk(std::vector<T, Room>& values, const std::string& name) {
        elements(values, name);
        if (chosen(name + ".size()")) values.emplace_back();
    }
    template <class T, std::size_t N>
    void walk(std::array<T, N>& values, const std::string& name) {
        elements(values, name);
    }
    template <class T, std::size_t N>
    void walk(T (&values)[N], const std::string& name) {
        elements(values, name);
    }
    template <class T>
    void walk(std::optional<T>& value, const std::string& name) {
        if (value) walk(*value, name);
        if (chosen(name + ".has_value()")) value = value ? std::optional<T>{} : std::optional<T>{T{}};
    }
    template <class A, class B>
    void walk(std::pair<A, B>& both, const std::string& name) {
        walk(both.first, name + ".first");
        walk(both.second, name + ".second");
    }

  private:
    bool chosen(const std::string& name) {
        if (left_-- != 0) return false;
        changed_ = name;
        return true;
    }
    template <class Values>
    void elements(Values& values, const std::string& name) {
        std::size_t k = 0;
        for (auto& value : values) walk(value, name + "[" + std::to_string(k++) + "]");
    }

    int left_;
    std::string changed_;
};

}  // namespace crackle::testing
