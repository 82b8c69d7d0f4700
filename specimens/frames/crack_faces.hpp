// SPDX-License-Identifier: GPL-3.0-or-later
// Where a broken bonded point is drawn: its share of the face along which the two bodies were held together.
//
// When loading begins a face lies midway between the two surfaces. A circle's is square to the contact's normal, and as
// long as the diameter of the smaller of the two. Between polygons the points of an interface share its face, which
// runs from the first to the last of them: in the order in which they lie along it each has an equal part. One that is
// shorter than bond.thick, the width that a point bonds across, is taken as so long, square to the normal. Both bodies
// carry the face along; it is drawn at the mean of the two places.
// Tested by tests/specimens/observers/contact_history_test.cpp.
#pragma once

#include "specimens/frames/placed_frame.hpp"

namespace crackle {

struct CrackFace {
    Vec2 begin, end;  // m
    /// m, present gap along the normal, which turns with the bodies, between the places where the bond held them: 0 as
    /// the bond's overlap is used up, negative where the bodies are pressed together again.
    double opening;
};

/// @param bond  into TestSetup::bonds
CrackFace find_crack_face(const PlacedFrame& placed, PointIndex bond);

/// m, of the same share of the face when loading begins.
double length_of_face(const World& world, const TestSetup& setup, PointIndex bond);

}  // namespace crackle
