// SPDX-License-Identifier: GPL-3.0-or-later
// Diagrams of a strength envelope: strength against confinement with both fitted laws (Mohr-Coulomb, Hoek-Brown), and
// Mohr circles with the envelopes of both laws.
// Tested by tests/tools/commands/envelope_test.cpp.
#pragma once

#include "specimens/envelope/measured_strengths.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/recordings/measured_curve.hpp"
#include "specimens/statistics/mean.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// Data for both diagrams.
struct EnvelopeFigure {
    StrengthEnvelope laws;
    MeasuredStrengths tests;
    MeanFigure tension;  ///< mean of tests.tensions; if its count is 0, tension is not drawn
    std::string measured_label = {};
    std::vector<StrengthOfCores> measured = {};  ///< drawn with their errors; usually empty
};

/// Diagram of σ1 against σ3 with every test, means with 95 % intervals, and both laws. The laws start at the value of
/// σ3 at which σ1 = 0. Tension tests are drawn at σ1 = 0.
Panel strengths_over_confinement(const EnvelopeFigure& figure);

/// Diagram of τ against σn with the same scale on both axes. It shows the upper halves of the Mohr circles from σ3 to
/// the mean σ1 for each confinement, and from -T to 0. Both laws are drawn on the failure plane
/// (StrengthEnvelope::hoek_brown_on_plane()).
Panel mohr_circles(const EnvelopeFigure& figure);

}  // namespace crackle::plot
