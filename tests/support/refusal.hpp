// SPDX-License-Identifier: GPL-3.0-or-later
// Returns messages of refusals.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

#include "solver/base/errors.hpp"

namespace crackle::testing {

/// Message of the InputError thrown by `act`, which is also printed; "accepted" if there is none.
inline std::string refusal(const std::function<void()>& act) {
    try {
        act();
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return "accepted";
}

}  // namespace crackle::testing
