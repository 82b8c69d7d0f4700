// SPDX-License-Identifier: GPL-3.0-or-later
// How keys are declared: a key is a member of TestCase, whose type gives the kind of value, and what is asked of it.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "specimens/case/parameter.hpp"

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

/// The member of a case, or of an entry of one of its lists.
template <class Member>
auto& reach(const Member& member, TestCase& c, std::size_t entry) {
    if constexpr (std::is_invocable_v<Member, TestCase&>) {
        return member(c);
    } else {
        return member(c, entry);
    }
}

/// Declares a parameter held by the member that `member` returns; its type gives the kind of value.
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
             : std::is_same_v<T, std::int64_t>        ? ValueKind::integer
             : std::is_same_v<T, double>              ? ValueKind::real
             : std::is_same_v<T, std::string>         ? ValueKind::text
             : std::is_same_v<T, std::vector<double>> ? ValueKind::reals
                                                      : ValueKind::text_pair;
    p.presence = Unwrap<Held>::optional ? Presence::optional : Presence::required;
    p.set = [member](TestCase& c, const CaseValue& value, std::size_t entry) {
        reach(member, c, entry) = std::get<T>(value);
    };
    p.get = [member](const TestCase& c, std::size_t entry) -> std::optional<CaseValue> {
        // It only reaches in; nothing is written.
        const Held& held = reach(member, const_cast<TestCase&>(c), entry);
        if constexpr (Unwrap<Held>::optional) {
            if (!held) return std::nullopt;
            return CaseValue(*held);
        } else {
            return CaseValue(held);
        }
    };
    if constexpr (Unwrap<Held>::optional) p.forget = [member](TestCase& c) { reach(member, c, 0).reset(); };
    return p;
}

/// Refinements of a declaration, chained behind it.
struct With {
    Parameter p;
    With above(double low) && { return p.lowest = low, p.lowest_allowed = false, std::move(*this); }
    With at_least(double low) && { return p.lowest = low, std::move(*this); }
    With below(double high) && { return p.highest = high, p.highest_allowed = false, std::move(*this); }
    With at_most(double high) && { return p.highest = high, std::move(*this); }
    With one_of(std::vector<std::string> choices) && { return p.choices = std::move(choices), std::move(*this); }
    With path() && { return p.is_path = true, std::move(*this); }
    With needed_with_table() && { return p.presence = Presence::required_with_table, std::move(*this); }
    With otherwise(CaseValue value) && {
        return p.default_value = std::move(value), p.presence = Presence::defaulted, std::move(*this);
    }
    operator Parameter() && { return std::move(p); }
};

// NOLINTBEGIN(bugprone-macro-parentheses): names of members and lists of calls
// Its versions differ on a lambda in a macro.
// clang-format off
#define CRACKLE_MEMBER(path) [](TestCase& c) -> auto& { return c.path; }
#define CRACKLE_ENTRY(list, path) [](TestCase& c, std::size_t entry) -> auto& { return c.list[entry].path; }
// clang-format on
#define CRACKLE_KEY(table, key, unit, sentence) \
    With { declare(#table, #key, unit, CRACKLE_MEMBER(table.key), sentence) }
#define CRACKLE_LIST_KEY(list, key, unit, sentence) \
    With { declare(#list, #key, unit, CRACKLE_ENTRY(list, key), sentence) }
// NOLINTEND(bugprone-macro-parentheses)

inline CaseValue whole(std::int64_t n) { return CaseValue(n); }
inline CaseValue words(const char* text) { return CaseValue(std::string(text)); }

}  // namespace crackle::declaring
