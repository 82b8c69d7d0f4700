// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/json_number.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace crackle {

nlohmann::ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace crackle
