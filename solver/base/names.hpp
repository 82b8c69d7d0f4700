// SPDX-License-Identifier: GPL-3.0-or-later
// Names of enum values, as used in case files, options and results. They are listed once, next to the enum, whose
// values must start at 0:
//
//     enum class Jaws { arc, flat };
//     constexpr auto list_names(Jaws) { return in_order("arc", "flat"); }
//
// Tested by tests/solver/base/names_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crackle {

/// Lists the names of an enum's values in the order of the values, starting at 0.
constexpr auto in_order(auto... names) { return std::array<std::string_view, sizeof...(names)>{names...}; }

namespace detail {

template <class Enum>
constexpr bool has_names() {
    return requires { list_names(Enum{}); };
}

}  // namespace detail

/// An enum whose values have names.
template <class Enum>
concept HasNames = detail::has_names<Enum>();

template <HasNames Enum>
inline constexpr auto table_of_names = list_names(Enum{});

/// Whether a value that was read as a number is a valid value of the enum.
template <HasNames Enum>
constexpr bool is_known(Enum value) {
    return static_cast<std::size_t>(value) < table_of_names<Enum>.size();
}

/// Name of an enum value; empty if the value is not valid.
template <HasNames Enum>
constexpr const char* name_of(Enum value) {
    return is_known(value) ? table_of_names<Enum>[static_cast<std::size_t>(value)].data() : "";
}

/// Enum value with this name; empty if no value has it.
template <HasNames Enum>
constexpr std::optional<Enum> from_name(std::string_view name) {
    const auto at = std::ranges::find(table_of_names<Enum>, name);
    if (at == table_of_names<Enum>.end()) return std::nullopt;
    return static_cast<Enum>(at - table_of_names<Enum>.begin());
}

/// All names, in the order in which messages list them.
template <HasNames Enum>
std::vector<std::string> names_of() {
    return {table_of_names<Enum>.begin(), table_of_names<Enum>.end()};
}

/// Refuses an unknown name. @throws InputError «where: found "X", expected "A", "B" or "C"»
[[noreturn]] void refuse_name(const std::string& where, const std::string& found,
                              const std::vector<std::string>& expected);

/// Enum value with this name. @param where location of the name, for the message @throws InputError from refuse_name()
template <HasNames Enum>
Enum value_named(const std::string& where, const std::string& name) {
    if (const std::optional<Enum> value = from_name<Enum>(name)) return *value;
    refuse_name(where, name, names_of<Enum>());
}

}  // namespace crackle
