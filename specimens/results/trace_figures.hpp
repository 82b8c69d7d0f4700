// SPDX-License-Identifier: GPL-3.0-or-later
// What joints have come to, for summary.json: breaks on them, and by source and by trace how they have opened, slipped
// and failed, at the peak and at the end. Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Keys of summary_keys(). @param world at the end
nlohmann::ordered_json trace_figures(const TestSetup& setup, const TestState& state, const World& world);

}  // namespace crackle
