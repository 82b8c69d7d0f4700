// SPDX-License-Identifier: GPL-3.0-or-later
// A strength envelope as figures: strengths with both laws over confinement, and Mohr circles with both laws'
// envelopes. Tested by tests/tools/commands/envelope_test.cpp.
#pragma once

#include "specimens/envelope/measured_strengths.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/statistics/mean.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// What both are drawn of.
struct EnvelopeFigure {
    StrengthEnvelope laws;
    MeasuredStrengths tests;
    MeanFigure tension;  ///< of tests.tensions; without any a count of 0, and nothing is drawn
};

/// σ1 over σ3: every test, beside it means with their 95 % intervals, both laws from where they have σ1 = 0; tension at
/// σ1 = 0.
Panel strengths_over_confinement(const EnvelopeFigure& figure);

/// τ over σn at equal scales: the upper halves of the circles from σ3 to the mean σ1 of each confinement, and from -T
/// to 0; both laws on the plane of failure (StrengthEnvelope::hoek_brown_on_plane()).
Panel mohr_circles(const EnvelopeFigure& figure);

}  // namespace crackle::plot
