// SPDX-License-Identifier: GPL-3.0-or-later
// The loading loop: steps the world until it fails, reaches its largest strain or is interrupted.
//
// Observers are called in the steps that are measured, in a fixed order: curve row, failure, frame; broken bonds as
// they come. Nothing of this reaches the kernels. Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <vector>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

class TestFiles;

/// Loads to the end. @param files where to write; nullptr: rows and events stay in memory (state.rows,
/// world.bonds.events)
/// @throws UnstableRun with everything so far kept.
void load_specimen(VirtualTest& test, const TestHooks& hooks = {}, TestFiles* files = nullptr);

/// Rows of a loaded test that curve.csv holds: of those that are judged, so many as output.curve_rows asks for, and the
/// last.
std::vector<CurveRow> written_rows(const VirtualTest& test);

}  // namespace crackle
