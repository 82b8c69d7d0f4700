// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in JSON, which has no NaN.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace crackle {

/// What is not defined is null.
inline nlohmann::ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace crackle
