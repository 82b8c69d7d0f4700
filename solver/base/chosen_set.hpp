// SPDX-License-Identifier: GPL-3.0-or-later
// Calls the kernels of the instruction set that this program has chosen. Included by those few sources alone that call
// kernels, for they are compiled again with each set that a build adds.
// Tested by tests/solver/base/instruction_set_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "solver/base/built_in_sets.hpp"
#include "solver/base/instruction_set.hpp"

namespace crackle {

/// Place of chosen_set() among built_in_sets().
std::size_t chosen_place();

/// call.operator()<S>() of the chosen set S.
template <class Call>
auto of_chosen_set(Call call) {
    using Result = decltype(call.template operator()<sets_of_this_program[0]>());
    const auto call_chosen = [&]<std::size_t... K>(std::index_sequence<K...>) {
        static constexpr std::array<Result (*)(Call&), sizeof...(K)> calls{
            [](Call& of) -> Result { return of.template operator()<sets_of_this_program[K]>(); }...};
        return calls[chosen_place()](call);
    };
    return call_chosen(std::make_index_sequence<sets_of_this_program.size()>{});
}

}  // namespace crackle
