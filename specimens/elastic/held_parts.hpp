// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that hold and drive a specimen, as boundary conditions of a linear solution.
// Tested by tests/specimens/kinds/test_kind_test.cpp.
#pragma once

#include <vector>

#include "solver/linear/elastic.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Prescribed motions of the parts: the supports are at rest; the driving part is displaced along its axis.
/// @param way  displacement of the driving part, m
inline std::vector<Prescribed> prescribed_parts(const PlacedApparatus& apparatus, double way) {
    std::vector<Prescribed> prescribed;
    prescribed.reserve(apparatus.parts.size());
    for (const SetupPart& part : apparatus.parts) {
        const double own = part.body == apparatus.top ? way : 0.0;
        prescribed.push_back({part.body, apparatus.axis == 1 ? BodyMotion{0.0, own, 0.0} : BodyMotion{own, 0.0, 0.0}});
    }
    return prescribed;
}

/// Points included in a linear solution: bonds and, if walls press on the specimen, also points in contact.
inline ClosedPoints closed_points(const PlacedApparatus& apparatus) {
    return apparatus.has_walls() ? ClosedPoints::touching : ClosedPoints::bonded;
}

/// Nominal stress, N/m: half the difference between the axial force on the driving part and that on the supports,
/// divided by `apparatus.section`.
/// @param reaction  reactions of prescribed_parts(), in the same order
inline double nominal_stress(const PlacedApparatus& apparatus, const std::vector<BodyMotion>& reaction) {
    double sum = 0.0;
    for (std::size_t k = 0; k < apparatus.parts.size(); ++k) {
        if (apparatus.parts[k].wall) continue;
        const double along = apparatus.axis == 1 ? reaction[k].y : reaction[k].x;
        sum += apparatus.parts[k].body == apparatus.top ? along : -along;
    }
    return 0.5 * sum / apparatus.section;
}

/// Bodies of all parts that hold or drive the specimen.
inline std::vector<BodyIndex> bodies_of_parts(const PlacedApparatus& apparatus) {
    std::vector<BodyIndex> bodies;
    bodies.reserve(apparatus.parts.size());
    for (const SetupPart& part : apparatus.parts) bodies.push_back(part.body);
    return bodies;
}

}  // namespace crackle
