// SPDX-License-Identifier: GPL-3.0-or-later
// Faces and free sides of the polygons of a world, from their outlines before the mesh was inset.
//
// Two edges that coincide form a face over their common length. A part of an outline that no face covers is a free
// side. After traces have cut cells, one edge can have faces with several other cells. Outlines are given, or are
// recovered from the inset polygons by shifting all edges outwards. The inset removes edges whose length is less than
// about the width of the gap. The recovered cells then overlap slightly at that corner and have no face there. Tested
// by tests/solver/faces/find_faces_test.cpp.
#pragma once

#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Face between two bodies.
struct SharedFace {
    BodyIndex i, j;
    Vec2 middle, normal;  // midpoint, m; unit vector from i to j
    double length;        // m
};

/// Part of a body's outline that it does not share with another body.
struct FreeSide {
    BodyIndex body;
    Vec2 middle, normal;  // midpoint, m; outward unit vector
    double length;        // m
};

/// Area and centroid of a cell before the inset.
struct CellArea {
    double area = 0.0;  // m²
    Vec2 centroid;      // m
};

/// Faces and free sides of the polygons of a world, and the area of each polygon.
struct FaceNet {
    std::vector<SharedFace> faces;  // sorted by i, then j, i < j
    std::vector<FreeSide> sides;    // sorted by body
    std::vector<CellArea> cells;    // by body; the area of a body that is not a polygon is 0
};

/// Faces shorter than this fraction of the square root of the smaller cell's area are ignored as round-off.
inline constexpr double shortest_face_share = 1e-9;

/// Outlines of the polygons of a world before the inset, by body, counter-clockwise; empty for a body that is not a
/// polygon.
using Outlines = std::vector<std::vector<Vec2>>;

/// Recovers the outlines before the inset, at the current positions of the bodies. @param gap distance between facing
/// edges, m
Outlines outlines_before_inset(const World& world, double gap);

/// Finds the faces and free sides of polygons.
FaceNet find_faces(const Outlines& outlines);

}  // namespace crackle
