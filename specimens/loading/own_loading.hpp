// SPDX-License-Identifier: GPL-3.0-or-later
// Loading by the caller's own rule: the speed of the part that drives the test, set while it runs.
// Tested by tests/specimens/loading/own_loading_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Speed of the driving part in the sense of the test, m/s, negative while it goes back.
double platen_speed(const VirtualTest& test);

/// Sets it from the coming step on. Loading by tolerance ends with it: the speed is the caller's, and so is the error
/// by inertia. Of that the summary has the platens' out-of-balance at the peak; its share above the tolerance is of the
/// strain until then, and the mean rate that of the way gone. A notice says from which strain on. Rows follow the way
/// gone back and forth. Velocities that jump send a wave: change them in steps that are small against the stress wave's
/// transit.
/// @throws InputError where the speed is no number, where the case itself turns the platen round, and where the part is
/// not driven at a velocity any more
void set_platen_speed(VirtualTest& test, double speed);

}  // namespace crackle
