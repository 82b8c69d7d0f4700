// SPDX-License-Identifier: GPL-3.0-or-later
// Faces and free sides of the polygons of a world, from their outlines before the mesh was inset.
//
// Two edges that lie on each other share a face, where they lap. What of an outline no face covers is a free side.
// Cells cut by traces can share an edge with several others. Outlines are given, or recovered from those after the
// inset by shifting all edges outwards. An inset takes edges away that are about as short as the gap is wide; recovered
// cells then overlap a little at that corner, and have no face there. Tested by tests/solver/faces/find_faces_test.cpp.
#pragma once

#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Face between two bodies.
struct SharedFace {
    BodyIndex i, j;
    Vec2 middle, normal;  // m; unit vector from i to j
    double length;        // m
};

/// Part of a body's outline without a neighbour.
struct FreeSide {
    BodyIndex body;
    Vec2 middle, normal;  // m; unit vector out of the body
    double length;        // m
};

/// Area and centroid of a cell before the inset.
struct CellArea {
    double area = 0.0;  // m²
    Vec2 centroid;      // m
};

/// How the polygons of a world divide the plane.
struct FaceNet {
    std::vector<SharedFace> faces;  // sorted by i, then j, i < j
    std::vector<FreeSide> sides;    // sorted by body
    std::vector<CellArea> cells;    // by body; an area of 0 for a body that is no polygon
};

/// Faces shorter than this fraction of the root of the smaller cell's area are round-off.
inline constexpr double shortest_face_share = 1e-9;

/// Outlines of the polygons of a world before the inset, by body, counter-clockwise; empty for a body that is no
/// polygon.
using Outlines = std::vector<std::vector<Vec2>>;

/// Recovers outlines at the current positions. @param gap distance between facing edges, m
Outlines outlines_before_inset(const World& world, double gap);

/// Finds the faces of polygons.
FaceNet find_faces(const Outlines& outlines);

}  // namespace crackle
