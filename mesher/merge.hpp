// SPDX-License-Identifier: GPL-3.0-or-later
// Joining of triangles that the inset would destroy with neighbours.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesher/partition.hpp"

namespace crackle {

/// A polygon of joined triangles: corner numbers (into Triangles::points), counter-clockwise. The rest stay as they
/// are.
struct JoinedTriangles {
    std::vector<bool> joined;  // by triangle: its place is taken by one of the outlines
    struct Outline {
        int triangle;  // the lowest of its triangles
        std::vector<int> corners;
        std::vector<int> traces;  // on the edge from each corner to the next, -1: none; empty of a mesh without traces
    };
    std::vector<Outline> outlines;  // in the order of their triangles
};

/// Joins each destroyed triangle to the neighbour across its longest edge with which it is convex and survives the
/// inset; where no such neighbour survives, to the one across the longest edge with which it is convex, and goes on
/// from there.
/// @param destroyed  triangles that the inset leaves nothing of
/// @throws MeshError if a destroyed triangle is convex with none of its neighbours
JoinedTriangles join_destroyed(const Triangles& mesh, const std::vector<int>& destroyed, double depth,
                               double coordinate_scale);

/// Traces on a triangle's edges and on those of its neighbours; none of a mesh without.
std::vector<int> traces_about(const Triangles& mesh, std::size_t triangle);
/// " by traces 3, 5"; empty of none.
std::string in_words(const std::vector<int>& traces);

}  // namespace crackle
