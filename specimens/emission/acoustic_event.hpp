// SPDX-License-Identifier: GPL-3.0-or-later
// An acoustic event: breaks that belong together in place and time, and the moment of their source. ae.csv has a row
// for each, in the order in which they ended. Tested by tests/specimens/emission/listener_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "specimens/emission/source.hpp"

namespace crackle {

struct AcousticEvent {
    double time = 0.0;          // s, of the first break
    double axial_strain = 0.0;  ///< then
    double duration = 0.0;      // s, from the first break to the end of the window that the last one left
    Vec2 centre;                // m, mean place of the breaks
    double radius = 0.0;        // m, of the source disc
    std::int64_t breaks = 0, breaks_in_shear = 0;
    double energy = 0.0;     // J, taken by its breaks
    MomentTensor moment;     // N m, the largest over the duration
    double rise_time = 0.0;  // s, from the first break to that moment

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("time", s.time);
        visit("axial_strain", s.axial_strain);
        visit("duration", s.duration);
        visit("centre", s.centre);
        visit("radius", s.radius);
        visit("breaks", s.breaks);
        visit("breaks_in_shear", s.breaks_in_shear);
        visit("energy", s.energy);
        visit("moment", s.moment);
        visit("rise_time", s.rise_time);
    }
};

/// m, that makes N m of a world's N m; see EmissionRule::thickness.
struct AcousticColumn {
    Quantity what;
    std::string (*text)(const AcousticEvent&, double thickness);
};
/// In the order of the file.
const std::vector<AcousticColumn>& acoustic_columns();
std::string acoustic_header();  ///< with line end
std::string acoustic_line(const AcousticEvent& event, double thickness);

/// Mw; -infinity of an event without a moment.
double moment_magnitude(const AcousticEvent& event, double thickness);

}  // namespace crackle
