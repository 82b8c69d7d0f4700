// SPDX-License-Identifier: GPL-3.0-or-later
// Judges from where and when bonds broke whether a test is valid for its purpose. The results of an invalid test are
// still reported, together with the verdict.
//
//   compression, biaxial   the largest crack does not run along a platen; the specimen is at least twenty
//                          particles wide
//   tension                the specimen broke between its grips
//   brazilian              before the stress first drops by 1 %, the mean distance of bond breaks from the centre along
//                          the load axis, weighted by energy, is less than 0.5 R, and breaks beyond 0.8 R release less
//                          than a quarter of the energy (the mean position is unsuitable: two crushed jaws average to
//                          the centre); at the end the largest crack is at most 20 degrees from the load axis and spans
//                          at least half the diameter
//   bending, scb           the largest crack lies within a quarter of the height, or two particles, of midspan
//                          and spans at least half of the height above any notch
//   direct_shear           bond breaks within a quarter of the height from the gap release at least two thirds of the
//                          energy
// In kinds of test without platens, bond breaks within one mean particle size of each other count as one crack.
// Tested by tests/specimens/measures/verdicts_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "specimens/observers/contact_history.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A condition for a valid test, and whether it holds.
struct Verdict {
    std::string claim;          ///< condition for validity
    std::optional<bool> holds;  ///< empty if unknown, or not yet known
    std::string found;          ///< the values on which the judgement is based, or why there are none
};

/// A sentence stating that a claim does not hold, with the values found. @param claim, found  from a Verdict, or from
/// summary.json
std::string broken_claim(const std::string& claim, const std::string& found);

/// @param failed  whether the specimen has failed, so that its peak is final
std::vector<Verdict> verdicts_on(const TestSetup& setup, std::span<const CurveRow> rows, const ContactHistory& history,
                                 bool failed);

}  // namespace crackle
