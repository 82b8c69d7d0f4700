// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of a campaign: the values that a key takes. A plan's points combine all values of its grid axes with the
// points of a design, which fill the box of the other axes evenly. The design uses low-discrepancy sequences: Halton,
// Numer. Math. 2, 1960; Sobol after Bratley and Fox, TOMS 14, 1988.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/names.hpp"
#include "specimens/case/case_file.hpp"

namespace crackle {

/// How the values of an axis are spaced.
enum class Spacing : std::uint8_t { linear, logarithmic };
constexpr auto list_names(Spacing) { return in_order("linear", "logarithmic"); }

/// Low-discrepancy sequence that places the points of a design.
enum class Sequence : std::uint8_t { sobol, halton };
constexpr auto list_names(Sequence) { return in_order("sobol", "halton"); }

/// A key whose value varies over a campaign.
struct Axis {
    std::string key;                 ///< key of a case, such as "material.cohesion"
    std::string where;               ///< "file:line" where the plan defines the axis
    bool whole = false;              ///< whether the key takes integers; values are then rounded
    std::vector<std::string> tests;  ///< names of the tests to which the axis applies; if empty, all

    std::vector<CaseValue> values;  ///< values of a grid axis; empty if the design provides them
    double from = 0.0, to = 0.0;    ///< ends of the range of a design axis
    Spacing spacing = Spacing::linear;

    /// Whether the design provides the values, together with those of its other axes.
    bool of_design() const { return values.empty(); }
    /// Value at a given fraction, 0 to 1, of the range.
    CaseValue at(double share) const;
};

/// `count` values from one end of the range to the other, both included. @param count  at least 2
std::vector<CaseValue> spaced_values(const Axis& axis, std::int64_t count);

/// Points that fill the unit cube evenly. The first n points are the same for any number of points, so a design can be
/// extended.
/// @param dimensions  1 to 20
std::vector<std::vector<double>> design_points(Sequence sequence, std::size_t points, std::size_t dimensions);
inline constexpr std::size_t most_design_axes = 20;

}  // namespace crackle
