// SPDX-License-Identifier: GPL-3.0-or-later
// Declarations of keys. A declaration names a member of TestCase, whose type determines the kind of value, and adds the
// key's requirements.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "solver/base/names.hpp"
#include "specimens/case/parameter.hpp"
#include "specimens/case/test_case.hpp"

namespace crackle::declaring {

template <class T>
struct Unwrap {
    using type = T;
    static constexpr bool optional = false;
};
template <class T>
struct Unwrap<std::optional<T>> {
    using type = T;
    static constexpr bool optional = true;
};

/// Returns the member of a case, or of one entry in a list of the case.
template <class Member>
auto& reach(const Member& member, TestCase& c, std::size_t entry) {
    if constexpr (std::is_invocable_v<Member, TestCase&>) {
        return member(c);
    } else {
        return member(c, entry);
    }
}

/// Converts a value to its form in a file: an enumerator is written as its name.
template <class T>
CaseValue value_of(const T& held) {
    if constexpr (std::is_enum_v<T>)
        return std::string(name_of(held));
    else if constexpr (std::is_same_v<T, int>)
        return std::int64_t{held};
    else
        return held;
}

/// Declares the parameter stored in the member that `member` returns; the member's type determines the kind of value.
template <class Member>
Parameter declare(std::string table, std::string key, std::string unit, Member member, std::string sentence) {
    using Held = std::remove_cvref_t<decltype(reach(member, std::declval<TestCase&>(), 0))>;
    using T = typename Unwrap<Held>::type;
    Parameter p;
    p.table = std::move(table);
    p.key = std::move(key);
    p.unit = std::move(unit);
    p.sentence = std::move(sentence);
    p.kind = std::is_same_v<T, bool>                  ? ValueKind::flag
             : std::is_integral_v<T>                  ? ValueKind::integer
             : std::is_same_v<T, double>              ? ValueKind::real
             : std::is_same_v<T, std::string>         ? ValueKind::text
             : std::is_enum_v<T>                      ? ValueKind::text
             : std::is_same_v<T, std::vector<double>> ? ValueKind::reals
                                                      : ValueKind::text_pair;
    if constexpr (std::is_enum_v<T>) p.choices = names_of<T>();
    p.presence = Unwrap<Held>::optional ? Presence::optional : Presence::required;
    p.set = [member](TestCase& c, const CaseValue& value, std::size_t entry) {
        if constexpr (std::is_enum_v<T>)
            reach(member, c, entry) = from_name<T>(std::get<std::string>(value)).value();
        else if constexpr (std::is_same_v<T, int>)
            reach(member, c, entry) = static_cast<int>(std::get<std::int64_t>(value));
        else
            reach(member, c, entry) = std::get<T>(value);
    };
    p.get = [member](const TestCase& c, std::size_t entry) -> std::optional<CaseValue> {
        // const is cast away only to call `member`; nothing is written.
        const Held& held = reach(member, const_cast<TestCase&>(c), entry);
        if constexpr (Unwrap<Held>::optional) {
            return held ? std::optional(value_of(*held)) : std::nullopt;
        } else {
            return value_of(held);
        }
    };
    if constexpr (Unwrap<Held>::optional) p.forget = [member](TestCase& c) { reach(member, c, 0).reset(); };
    return p;
}

/// Constraints on the value of a key, chained after its declaration.
struct With {
    Parameter p;
    With above(double low) && { return p.lowest = low, p.lowest_allowed = false, std::move(*this); }
    With at_least(double low) && { return p.lowest = low, std::move(*this); }
    With below(double high) && { return p.highest = high, p.highest_allowed = false, std::move(*this); }
    With at_most(double high) && { return p.highest = high, std::move(*this); }
    With path() && { return p.is_path = true, std::move(*this); }
    With needed_with_table() && { return p.presence = Presence::required_with_table, std::move(*this); }
    template <class T>
    With otherwise(const T& value) && {
        return p.default_value = value_of(value), p.presence = Presence::defaulted, std::move(*this);
    }
    operator Parameter() && { return std::move(p); }
};

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are member names and call lists
// Different versions of clang-format format a lambda in a macro differently.
// clang-format off
#define CRACKLE_MEMBER(path) [](TestCase& c) -> auto& { return c.path; }
#define CRACKLE_ENTRY(list, path) [](TestCase& c, std::size_t entry) -> auto& { return c.list[entry].path; }
// clang-format on
#define CRACKLE_KEY(table, key, unit, sentence) \
    With { declare(#table, #key, unit, CRACKLE_MEMBER(table.key), sentence) }
#define CRACKLE_LIST_KEY(list, key, unit, sentence) \
    With { declare(#list, #key, unit, CRACKLE_ENTRY(list, key), sentence) }
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace crackle::declaring
