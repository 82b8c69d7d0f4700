// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of a campaign: which values a key takes. A plan's points are all combinations of its grid axes, for each
// point of a design that fills the box of the others evenly (low-discrepancy sequences: Halton, Numer. Math. 2, 1960;
// Sobol as of Bratley and Fox, TOMS 14, 1988).
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "specimens/case/test_case.hpp"

namespace crackle {

enum class Spacing : std::uint8_t { linear, logarithmic };
enum class Sequence : std::uint8_t { sobol, halton };

struct Axis {
    std::string key;                 ///< of a case, "material.cohesion"
    std::string where;               ///< "file:line" of the plan
    bool whole = false;              ///< its key takes whole numbers: values are rounded to them
    std::vector<std::string> tests;  ///< of the plan that it is for; empty: all

    std::vector<CaseValue> values;  ///< of a grid axis; empty: the design gives them
    double from = 0.0, to = 0.0;    ///< ends of a design axis
    Spacing spacing = Spacing::linear;

    bool of_design() const { return values.empty(); }
    /// Value at a share of the way between the ends, 0 to 1.
    CaseValue at(double share) const;
};

/// `count` values from one end to the other, both included. @param count at least 2
std::vector<CaseValue> spaced_values(const Axis& axis, std::int64_t count);

/// Points that fill the unit cube evenly; the first n are the same for every number of points, so that a design can
/// be gone on with. @param dimensions 1 to 20
std::vector<std::vector<double>> design_points(Sequence sequence, std::size_t points, std::size_t dimensions);
inline constexpr std::size_t most_design_axes = 20;

}  // namespace crackle
