// SPDX-License-Identifier: GPL-3.0-or-later
// An acoustic event: a group of bond breaks that are close in space and time, and the moment tensor of their source.
// ae.csv has one row per event, ordered by the time at which events ended.
// Tested by tests/specimens/emission/listener_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/quantity.hpp"
#include "specimens/emission/source.hpp"

namespace crackle {

/// Breaks that are close in space and time, treated as one source.
struct AcousticEvent {
    double time = 0.0;          // time of the first break, s
    double axial_strain = 0.0;  ///< axial strain at the first break
    double duration = 0.0;      // time from the first break to the end of the window after the last one, s
    Vec2 centre;                // mean position of the breaks, m
    double radius = 0.0;        // radius of the source disc, m
    std::int64_t breaks = 0, breaks_in_shear = 0;
    double energy = 0.0;     // energy released by its breaks, J
    MomentTensor moment;     // largest moment during the event, N m
    double rise_time = 0.0;  // time from the first break to that moment, s

    CRACKLE_FIELDS(time, axial_strain, duration, centre, radius, breaks, breaks_in_shear, energy, moment, rise_time);
};

/// A column of ae.csv. @param thickness  factor on a world's moments and energies, m; see EmissionRule::thickness
struct AcousticColumn {
    Quantity what;
    std::string (*text)(const AcousticEvent&, double thickness);
};
/// The columns of ae.csv in file order.
const std::vector<AcousticColumn>& acoustic_columns();
std::string acoustic_header();  ///< the header line of ae.csv, including the newline
/// The row of ae.csv for an event, including the newline. @param thickness  out of plane, m
std::string acoustic_line(const AcousticEvent& event, double thickness);

/// Moment magnitude Mw; -infinity for an event without a moment.
double moment_magnitude(const AcousticEvent& event, double thickness);

}  // namespace crackle
