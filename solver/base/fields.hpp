// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of a struct, listed once beside their declaration, for all that must treat every one of them alike:
// checkpoints, hashes, what a new neighbour list carries over.
//
//     struct Place {
//         double x, y;
//         template <class Self, class Visit>
//         static void fields(Self& self, Visit&& visit) {
//             visit("x", self.x);
//             visit("y", self.y);
//         }
//     };
//
// A visitor that wants to know more of a field receives it as a third argument (world/points.hpp). A list that lacks a
// field does not compile where it is walked: lists_all_fields().
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace crackle {

namespace detail {

/// Converts to whatever a member is.
struct AnyField {
    template <class T>
    operator T() const;
};

template <class T, std::size_t... N>
constexpr bool takes(std::index_sequence<N...>) {
    return requires { T{(static_cast<void>(N), AnyField{})...}; };
}

/// Whether `count` initialisers are all that the aggregate T takes, an array's elements one by one: fewer always do.
template <class T, std::size_t Count>
constexpr bool takes_at_most() {
    return takes<T>(std::make_index_sequence<Count>{}) && !takes<T>(std::make_index_sequence<Count + 1>{});
}

struct AnyVisitor {
    void operator()(auto&&...) const {}
};

/// Counts initialisers of fields that are not listed yet.
struct FieldCounter {
    std::size_t count = 0, seen = 0;
    std::array<const void*, 64> places{};
    template <class T, class... More>
    constexpr void operator()(const char* /*name*/, T& field, const More&... /*more*/) {
        for (std::size_t k = 0; k < seen; ++k)
            if (places[k] == &field) return;
        places[seen++] = &field;
        if constexpr (std::is_array_v<std::remove_reference_t<T>>) {
            count += std::extent_v<std::remove_reference_t<T>>;
        } else {
            ++count;
        }
    }
};

/// Room for a T that is never made, since not every T can be made in a constant expression: its members have addresses.
template <class T>
union RoomFor {
    char nothing;
    T value;
    constexpr RoomFor() : nothing{} {}
    constexpr ~RoomFor() {}  // NOLINT(modernize-use-equals-default): a defaulted one is deleted
};

template <class T>
constexpr bool has_fields() {
    return requires { T::fields(std::declval<T&>(), AnyVisitor{}); };
}

template <class T>
constexpr std::size_t listed_fields() {
    FieldCounter counter;
    RoomFor<T> room;
    T::fields(room.value, counter);
    return counter.count;
}

}  // namespace detail

template <class T>
concept HasFields = detail::has_fields<T>();

/// Whether T::fields() visits every member of T.
template <HasFields T>
constexpr bool lists_all_fields() {
    return detail::takes_at_most<T, detail::listed_fields<T>()>();
}

}  // namespace crackle
