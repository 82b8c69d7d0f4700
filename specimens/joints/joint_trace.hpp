// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/vec2.hpp"

namespace crackle {

/// Length of a polyline.
inline double length_of(const std::vector<Vec2>& points) {
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) length += norm(points[k + 1] - points[k]);
    return length;
}

/// One trace, or its part inside the box.
struct JointTrace {
    std::vector<Vec2> points;  ///< m, at least two; consecutive points are distinct
    std::size_t source = 0;    ///< index into JointNetwork::sources
    /// Length before clipping to the box, m; infinite for persistent traces.
    double whole_length = 0.0;
    bool centred = false;  ///< whether the midpoint before clipping lies in the box
    /// Line of the file where the trace begins (for joined rows, the first row); 0 if it is not from a file.
    int row = 0;

    /// Length of the polyline, m.
    double length() const { return length_of(points); }
};

/// A trace along which a specimen has joint faces.
struct SpecimenTrace {
    std::string source;   ///< name of the [[joint_set]] or the [[trace]]
    double length = 0.0;  ///< m, inside the box

    CRACKLE_FIELDS(source, length);
};

}  // namespace crackle
