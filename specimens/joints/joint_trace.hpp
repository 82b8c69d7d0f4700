// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Of straight parts one after another.
inline double length_of(const std::vector<Vec2>& points) {
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) length += norm(points[k + 1] - points[k]);
    return length;
}

/// One trace, or what the box leaves of it.
struct JointTrace {
    std::vector<Vec2> points;  ///< m, two or more, one after another apart
    std::size_t source = 0;    ///< into JointNetwork::sources
    /// m, before the box cut it; infinite of persistent ones.
    double whole_length = 0.0;
    bool centred = false;  ///< its midpoint lies in the box, before the box cut it
    int row = 0;           ///< line of its file where it begins, of joined rows that of the first; 0: of no file

    double length() const { return length_of(points); }
};

/// What remains of a trace once it is faces of a specimen.
struct SpecimenTrace {
    std::string source;   ///< name of the set, or of the [[trace]]
    double length = 0.0;  ///< m, in the box

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("source", s.source);
        visit("length", s.length);
    }
};

}  // namespace crackle
