// SPDX-License-Identifier: GPL-3.0-or-later
// Loading controlled by the caller, who sets the speed of the driving part during the run.
// Tested by tests/specimens/loading/own_loading_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Speed of the driving part in the direction of loading, m/s; negative if the part moves back.
double platen_speed(const VirtualTest& test);

/// Sets the speed of the driving part from the next step on. If the case gives rate_tolerance, the tolerance no longer
/// controls the rate: the caller now controls the speed and is responsible for the inertia error. The summary still
/// gives the platens' out-of-balance stress at the peak. The fraction of strain above the tolerance then covers only
/// the strain before the first call. The mean rate refers to the travelled strain. A notice states the strain at the
/// first call. Curve rows are spaced by the strain travelled back and forth. A sudden change of velocity sends a stress
/// wave through the specimen. Therefore, change the speed in small increments, at least one wave transit time apart.
/// @throws InputError if the speed is not finite, if the case itself controls unloading or the lateral strain, or if
/// the part is no longer driven at a given velocity
void set_platen_speed(VirtualTest& test, double speed);

}  // namespace crackle
