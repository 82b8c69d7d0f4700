// SPDX-License-Identifier: GPL-3.0-or-later
// Lists the fields of a struct once, next to their declaration, for code that must visit every field: checkpoints,
// hashes, and values carried over to a new neighbour list.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

// A macro cannot call itself, so each round of expansion handles one more argument. The rounds suffice for 256
// arguments.
#define CRACKLE_PARENTHESES ()
#define CRACKLE_ROUNDS_4(...) __VA_ARGS__
#define CRACKLE_ROUNDS_16(...) CRACKLE_ROUNDS_4(CRACKLE_ROUNDS_4(CRACKLE_ROUNDS_4(CRACKLE_ROUNDS_4(__VA_ARGS__))))
#define CRACKLE_ROUNDS_64(...) CRACKLE_ROUNDS_16(CRACKLE_ROUNDS_16(CRACKLE_ROUNDS_16(CRACKLE_ROUNDS_16(__VA_ARGS__))))
#define CRACKLE_ROUNDS(...) CRACKLE_ROUNDS_64(CRACKLE_ROUNDS_64(CRACKLE_ROUNDS_64(CRACKLE_ROUNDS_64(__VA_ARGS__))))
#define CRACKLE_VISIT_EACH(field, ...) \
    visit(#field, s.field);            \
    __VA_OPT__(CRACKLE_VISIT_AGAIN CRACKLE_PARENTHESES(__VA_ARGS__))
#define CRACKLE_VISIT_AGAIN() CRACKLE_VISIT_EACH

/// Defines a function NAME(self, visit) that calls `visit("x", self.x)` for each listed member, in order.
#define CRACKLE_MEMBERS(NAME, ...)                       \
    template <class Self, class Visit>                   \
    static constexpr void NAME(Self& s, Visit&& visit) { \
        CRACKLE_ROUNDS(CRACKLE_VISIT_EACH(__VA_ARGS__))  \
    }                                                    \
    static_assert(true)
#define CRACKLE_FIELDS(...) CRACKLE_MEMBERS(fields, __VA_ARGS__)

namespace crackle {

namespace detail {

/// A value that converts to any type, used to count the initialisers that a struct accepts.
struct AnyField {
    template <class T>
    operator T() const;
};

template <class T, std::size_t... N>
constexpr bool takes(std::index_sequence<N...>) {
    return requires { T{(static_cast<void>(N), AnyField{})...}; };
}

/// Whether the aggregate T accepts `Count` initialisers but not one more; each array element counts as one.
template <class T, std::size_t Count>
constexpr bool takes_at_most() {
    return takes<T>(std::make_index_sequence<Count>{}) && !takes<T>(std::make_index_sequence<Count + 1>{});
}

struct AnyVisitor {
    void operator()(auto&&...) const {}
};

/// Visitor that counts the initialisers that the listed fields need. A field that is listed twice counts once.
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

/// Storage for a T that is never constructed; it only provides addresses for members. Not every T can be constructed in
/// a constant expression.
template <class T>
union RoomFor {
    char nothing;
    T value;
    constexpr RoomFor() : nothing{} {}
    constexpr ~RoomFor() {}  // NOLINT(modernize-use-equals-default): a defaulted destructor would be deleted
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

/// Serialises any struct that lists its fields with cereal, member by member, since padding has no defined value.
template <class Archive, HasFields T>
void serialize(Archive& archive, T& value) {
    static_assert(lists_all_fields<T>(), "a member is missing from the struct's fields()");
    T::fields(value, [&](const char* /*name*/, auto& field, const auto&... /*more*/) { archive(field); });
}

}  // namespace crackle
