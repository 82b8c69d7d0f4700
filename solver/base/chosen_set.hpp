// SPDX-License-Identifier: GPL-3.0-or-later
// Calls the kernels compiled for the instruction set that was chosen at start-up. Include this header only in the few
// sources that call kernels.
// Tested by tests/solver/base/instruction_set_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "solver/base/built_in_sets.hpp"
#include "solver/base/instruction_set.hpp"

namespace crackle {

/// Index of the chosen instruction set in the list that built_in_sets() returns.
std::size_t chosen_place();

/// Returns call.operator()<S>() for the chosen instruction set S.
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
