// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a test is one of what it is meant to be, from where and when its bonds broke. A number is never left out for
// it; it stands beside the number.
//
//   compression, biaxial  the largest crack is not a platen's; the specimen is twenty particles wide
//   tension               the specimen parted between its grips
//   brazilian             before the first drop of the stress by 1 % the energy-weighted mean of the breaks' distance
//   from
//                         the centre along the load is below 0.5 R, and those beyond 0.8 R have less than a quarter of
//                         the energy (not the mean place: two crushed jaws average to the centre); at the end the
//                         largest crack lies within 20 degrees of the load axis and spans half the diameter
//   bending, scb          the largest crack runs from midspan, within a quarter of the height or two particles, and
//   spans
//                         half of what the notch has left
//   direct_shear          two thirds of the energy of breaks come from within a quarter of the height of the gap
// Of kinds that are not between platens a crack is what breaks make that lie within a mean particle of each other.
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

struct Verdict {
    std::string claim;          ///< what must hold
    std::optional<bool> holds;  ///< absent: not known (yet)
    std::string found;          ///< the numbers behind it, or why there are none
};

/// A claim that does not hold, as a sentence with what was found. @param claim, found  of a Verdict, or of summary.json
std::string broken_claim(const std::string& claim, const std::string& found);

/// @param failed whether the peak is known
std::vector<Verdict> verdicts_on(const TestSetup& setup, std::span<const CurveRow> rows, const ContactHistory& history,
                                 bool failed);

}  // namespace crackle
