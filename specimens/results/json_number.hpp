// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in JSON, which has no NaN.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace crackle {

/// What is not defined is null. Callers include the JSON library.
nlohmann::ordered_json finite_or_null(double value);

}  // namespace crackle
