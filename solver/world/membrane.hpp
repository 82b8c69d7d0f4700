// SPDX-License-Identifier: GPL-3.0-or-later
// A membrane around the bodies of a world: chains of points on bodies, straight pieces between these points, and a
// pressure on the pieces. Empty in worlds without a membrane. The code in solver/membrane/ wraps it around the bodies
// and applies the pressure.
// Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/bodies.hpp"

namespace crackle {

/// A point of the membrane on a body, and the straight piece from the previous point to this point.
struct MembranePoint {
    BodyIndex body;
    double x, y;     // m, position relative to the centroid in the body's frame
    double longest;  // m, largest allowed length of the piece; if exceeded, the membrane is wrapped again

    CRACKLE_FIELDS(body, x, y, longest);
};

/// A membrane under pressure, which passes through points on bodies.
struct Membrane {
    double pressure = 0.0;  // N/m (force per length in the plane)
    double probe = 0.0;     // m, radius of the probe disc that is rolled around the bodies to find the points
    /// Bodies between which the membrane is stretched (lower and upper platen); no_body if it encloses all bodies.
    BodyIndex bottom = no_body, top = no_body;
    /// Points in clockwise order around the bodies. With platens, the points before `left_end` run up the left side and
    /// the others down the right side. Each side starts and ends on a platen.
    std::vector<MembranePoint> points;
    std::uint64_t left_end = 0;

    bool known = false;  // whether `area` has been computed
    // Whether a piece has become too long; the membrane is then wrapped again before the next force pass.
    bool parted = false;
    std::int64_t list_builds = 0;  // value of NeighbourList::builds at the last wrapping
    double area = 0.0;             // m², enclosed area in the last force pass, without the area swept by the platens
    double work = 0.0;             // J, work done by the membrane on the bodies
    double jumped = 0.0;           // m², sum of the changes of area due to wrapping, which do no work
    std::int64_t wrapped = 0;      // number of times the membrane was wrapped
    // Number of times that wrapping failed because the bodies no longer formed a path from platen to platen.
    std::int64_t open = 0;

    /// Whether the world has a membrane.
    bool present() const { return probe > 0.0; }

    CRACKLE_FIELDS(pressure, probe, bottom, top, points, left_end, known, parted, list_builds, area, work, jumped,
                   wrapped, open);
};

}  // namespace crackle
