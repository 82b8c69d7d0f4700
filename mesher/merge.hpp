// SPDX-License-Identifier: GPL-3.0-or-later
// Merges triangles that the inset would destroy with their neighbours.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesher/partition.hpp"

namespace crackle {

/// Polygons that replace merged triangles. Corners are indices into Triangles::points, counter-clockwise. All other
/// triangles are unchanged.
struct JoinedTriangles {
    std::vector<bool> joined;  // for each triangle, whether one of the outlines replaces it
    struct Outline {
        int triangle;  // lowest index of the merged triangles
        std::vector<int> corners;
        // For each corner, the trace on the edge to the next corner, or -1. Empty in a mesh without traces.
        std::vector<int> traces;
    };
    std::vector<Outline> outlines;  // sorted by Outline::triangle
};

/// Merges each destroyed triangle with a neighbour. Among neighbours whose union with it is convex and survives the
/// inset, the one across the longest edge is chosen. If no union survives, the longest edge with a convex union is
/// used, and the process continues from this union.
/// @param destroyed triangles that vanish in the inset
/// @throws MeshError if a destroyed triangle does not form a convex polygon with any neighbour
JoinedTriangles join_destroyed(const Triangles& mesh, const std::vector<int>& destroyed, double depth,
                               double coordinate_scale);

/// Traces on the edges of a triangle and of its neighbours; empty in a mesh without traces.
std::vector<int> traces_about(const Triangles& mesh, std::size_t triangle);
/// The traces as text, for example " by traces 3, 5", or empty.
std::string in_words(const std::vector<int>& traces);

}  // namespace crackle
