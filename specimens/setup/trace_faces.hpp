// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a specimen that lie on traces of joints, and how they have moved since loading began.
//
// The middle of a face between the bodies i and j is carried along by both; u [m] is what that of j has moved beyond
// that of i, n the unit normal from i to j, turned by the mean of what the two have turned, t = n turned by +90°. Then
//
//     opening = u·n      slip = u·t, positive where who looks across sees the far side go to the left (sinistral)
//
// from either side alike. A face's own springs are in it: one that holds moves a little under load, too.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/vec2.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Where a body was when loading began; of a confined specimen, before the pressure was put on.
struct StartPlace {
    double x = 0.0, y = 0.0, angle = 0.0;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
        visit("angle", s.angle);
    }
};

/// A face that lies on a trace, of a mesh or of two circles whose flat faces lap there, when loading began.
struct TraceFace {
    std::int32_t trace = 0;   ///< into TestSetup::traces
    BodyIndex i = 0, j = 0;   ///< i before j
    std::int32_t bonds = 0;   ///< bonded points; 0 of an open one
    double length = 0.0;      // m
    Vec2 middle{}, normal{};  // m; unit, from i to j

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("trace", s.trace);
        visit("i", s.i);
        visit("j", s.j);
        visit("bonds", s.bonds);
        visit("length", s.length);
        visit("middle", s.middle);
        visit("normal", s.normal);
    }
};

/// How it has moved, and where it is.
struct FaceMotion {
    double opening = 0.0, slip = 0.0;  // m
    Vec2 begin, end;                   // m, means of where both bodies have carried its ends
};

/// Places of the two bodies of a face.
struct FacePlaces {
    StartPlace i, j;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("i", s.i);
        visit("j", s.j);
    }
};
FaceMotion motion_of(const TraceFace& face, const FacePlaces& start, const FacePlaces& now);

/// Of a world with bonds that lies as it was bonded, by bodies.
std::vector<TraceFace> find_trace_faces(const World& world);
/// For each bond the face that it holds, -1 of one on no trace.
std::vector<std::int32_t> faces_of_bonds(const std::vector<TraceFace>& faces, const ContactList& bonds);

}  // namespace crackle
