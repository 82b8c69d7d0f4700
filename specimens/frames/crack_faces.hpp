// SPDX-License-Identifier: GPL-3.0-or-later
// The line that represents a broken bond in a frame: the part of the bodies' common face that belongs to the bond.
//
// At the start of loading a face lies midway between the two surfaces. The face of circles is perpendicular to the
// contact normal and as long as the diameter of the smaller circle. Between polygons, the face runs from the first to
// the last point of the interface and is divided equally among the points. A face shorter than bond.thick (the width
// over which a point bonds) is extended to that length, perpendicular to the normal. The face moves with both bodies
// and is plotted at the mean of the two positions.
// Tested by tests/specimens/observers/contact_history_test.cpp.
#pragma once

#include "specimens/frames/placed_frame.hpp"

namespace crackle {

/// Current position of a broken bond's face.
struct CrackFace {
    Vec2 begin, end;  // m
    /// Current gap between the two points where the bond was attached, along the normal, which rotates with the bodies,
    /// m. It is 0 if the surfaces just touch, and negative if the bodies are pressed together again.
    double opening;
};

/// Face of a broken bond in a frame. @param bond  index into BondRecord::points
CrackFace find_crack_face(const PlacedFrame& placed, PointIndex bond);

/// Length of a bond's face at the start of loading, m.
double length_of_face(const World& world, const TestSetup& setup, PointIndex bond);

}  // namespace crackle
