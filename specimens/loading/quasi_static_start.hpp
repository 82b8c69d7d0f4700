// SPDX-License-Identifier: GPL-3.0-or-later
// Loading by tolerance begins in steady motion: no shock of the platen runs through the specimen, and the dashpots bear
// their share of the stress from the first step on.
//
// With u(ε) = ε û the linear solution of the specimen between its platens and ε̇ the rate, bodies begin with the
// velocities ε̇ û, and where K w = -C ε̇ û leaves them, w = 0 at the platens: then springs and dashpots balance on every
// body, nothing accelerates while the specimen stays linear, and the stress rises by E from the first row on.
// Tested by tests/specimens/setup/loading_rate_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"
#include "specimens/setup/loading_rate.hpp"

namespace crackle {

/// The rule for a specimen with a linear solution. @param tolerance of the inertia error
/// @throws InputError where the specimen has none
RateRule rate_rule_of(const VirtualTest& test, double tolerance);

/// Sets the specimen moving at the rule's first rate; what carries no load, and everything where the platens are not
/// bonded, moves in proportion to its height.
/// @throws InputError where there is no linear solution to take the rate from
void start_by_tolerance(VirtualTest& test);

/// Sets a specimen that is not between platens moving at the rate that its case gives, as start_by_tolerance() does;
/// without a linear solution everything moves in proportion to its height.
void start_by_rate(VirtualTest& test);

}  // namespace crackle
