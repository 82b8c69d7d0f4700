// SPDX-License-Identifier: GPL-3.0-or-later
// Message where something is refused.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

#include "solver/base/errors.hpp"

namespace crackle::testing {

/// The words of the InputError that `act` ends in, printed, too; "accepted" where it ends in none.
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
