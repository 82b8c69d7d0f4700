// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that enum values and their names correspond. Tested by tests/solver/base/names_test.cpp.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/base/names.hpp"

namespace crackle::testing {

/// Name of a value in the source: "flat" for Jaws::flat.
template <auto value>
std::string identifier_of() {
    const std::string_view text = __PRETTY_FUNCTION__;
    const std::string_view begun = text.substr(text.find("value = "));
    const std::string_view whole = begun.substr(0, begun.find_first_of(";]"));
    return std::string(whole.substr(whole.rfind(':') + 1));
}

template <class Enum, std::size_t... place>
void expect_names_in_order(std::index_sequence<place...> /*places*/) {
    const std::string identifiers[] = {identifier_of<static_cast<Enum>(place)>()...};
    for (std::size_t k = 0; k < sizeof...(place); ++k) {
        std::string name = name_of(static_cast<Enum>(k)), identifier = identifiers[k];
        if (identifier.ends_with('_')) identifier.pop_back();
        std::ranges::replace_if(
            name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
        const bool in_other_words = name == "seeds" || name == "reached_within_its_error";
        EXPECT_TRUE(in_other_words || name == identifier) << name << " of " << identifier;
    }
}

template <class Enum>
void expect_names() {
    const std::vector<std::string> names = names_of<Enum>();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        EXPECT_EQ(from_name<Enum>(names[k]), static_cast<Enum>(k)) << names[k];
        EXPECT_EQ(name_of(static_cast<Enum>(k)), names[k]);
        EXPECT_FALSE(from_name<Enum>(names[k] + " ").has_value()) << names[k];
    }
    EXPECT_FALSE(from_name<Enum>("").has_value());
    EXPECT_STREQ(name_of(static_cast<Enum>(names.size())), "");
    constexpr std::size_t count = table_of_names<Enum>.size();
    expect_names_in_order<Enum>(std::make_index_sequence<count>{});
    const std::string beyond = identifier_of<static_cast<Enum>(count)>();
    EXPECT_NE(beyond.find(')'), std::string::npos) << beyond << " has no name";
}

template <class... Enums>
void expect_names_of() {
    (expect_names<Enums>(), ...);
}

}  // namespace crackle::testing
