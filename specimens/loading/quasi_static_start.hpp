// SPDX-License-Identifier: GPL-3.0-or-later
// Starts loading in steady motion if the loading rate is controlled by a tolerance. The platen sends no shock through
// the specimen, and the dashpots carry their part of the stress from the first step on.
//
// Let u(ε) = ε û be the linear solution of the specimen between its platens, and ε̇ the strain rate. Bodies start with
// velocities ε̇ û, at positions displaced by w, where K w = -C ε̇ û and w = 0 at the platens. Springs and dashpots then
// balance on every body. Nothing accelerates while the specimen stays linear, and the stress rises with slope E from
// the first row.
// Tested by tests/specimens/setup/loading_rate_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"
#include "specimens/setup/loading_rate.hpp"

namespace crackle {

/// Rule for the loading rate of a specimen with a linear solution. @param tolerance  tolerance of the inertia error
/// @throws InputError if the specimen has no linear solution
RateRule rate_rule_of(const VirtualTest& test, double tolerance);

/// Sets the specimen in motion at the initial loading rate that rate_rule_of() gives. Bodies that carry no load move in
/// proportion to their height. If the platens are frictional, all bodies do.
/// @throws InputError if there is no linear solution from which to derive the rate
void start_by_tolerance(VirtualTest& test);

/// Sets a specimen without platens in motion at the rate of its case, as start_by_tolerance() does. Without a linear
/// solution, all bodies move in proportion to their height.
void start_by_rate(VirtualTest& test);

}  // namespace crackle
