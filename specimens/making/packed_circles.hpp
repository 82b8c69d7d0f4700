// SPDX-License-Identifier: GPL-3.0-or-later
// The first stage of making a specimen: circles packed as the case requests.
// Tested by tests/specimens/making/cell_sizes_test.cpp.
#pragma once

#include "specimens/making/hooks.hpp"
#include "specimens/packing/packing.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Packs the circles that a case requests, or obtains the packing through hooks.keep_packing if that is set.
/// @param places  where the case states its values, for error messages
/// @throws InputError that names the case's key if the circles cannot be packed; TestInterrupted
Packing packing_of(const parts::Particles& particles, int threads, const Places& places, const TestHooks& hooks);

}  // namespace crackle
