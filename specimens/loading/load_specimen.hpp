// SPDX-License-Identifier: GPL-3.0-or-later
// The loading loop: steps the world until the specimen fails, the largest strain is reached or the run is interrupted.
//
// When a row of the curve is due, results are recorded in a fixed order: row, failure, frame. Bond breaks are recorded
// when they occur. The solver does not depend on what is recorded.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <vector>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

class TestFiles;

/// Loads the specimen until the test ends or is interrupted.
/// @param files  output files; if nullptr, rows and events stay in memory (state.rows, world.bonds.events)
/// @throws UnstableRun if the run becomes unstable; results up to then are kept
void load_specimen(VirtualTest& test, const TestHooks& hooks = {}, TestFiles* files = nullptr);

/// Rows of a loaded test that are written to curve.csv: about output.curve_rows evenly spaced rows, and the last one.
std::vector<CurveRow> written_rows(const VirtualTest& test);

}  // namespace crackle
