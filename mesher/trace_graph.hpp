// SPDX-License-Identifier: GPL-3.0-or-later
// Traces of joints in a box as a graph: nodes where they end, bend and meet, straight edges between, the box's walls
// among them; and the parts into which the edges cut the box.
// Tested by tests/mesher/trace_graph_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {

struct TraceGraph {
    struct Edge {
        int from = -1, to = -1;  ///< nodes
        int trace = -1;          ///< of two that coincide the first; -1: a wall
    };
    /// An end that did not stay where it was given.
    struct MovedEnd {
        int trace = -1;
        bool first = false;  ///< the end before its other points
        Point place;         ///< where it is now, on another trace or a wall
        int onto = -1;       ///< that trace; -1: a wall
        double by = 0.0;     ///< m along its own line, negative: shortened
    };
    /// Traces that lie on each other along an edge.
    struct Coincidence {
        int first = -1, second = -1;
        double length = 0.0;  ///< m
    };

    std::vector<Point> nodes;
    std::vector<Edge> edges;
    std::vector<MovedEnd> moved;
    std::vector<Coincidence> coincident;  ///< by traces, each pair once
};

/// Which segments come within a reach of each other, and some that hardly do not, as i < j: from left to right. Swept
/// along x and, where there most are not, along the direction across most of them.
/// @throws MeshError for more than memory is meant for
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(std::span<const Segment> segments, double reach);

/// Nodes lie on the lines of all traces that meet there, to rounding.
/// @param traces  points one after another, within the box or on its boundary
/// @param reach  m: an end that lies as near to another trace or a wall, or beyond it by so little, goes along its own
///               line to it where that is at most twice as far
/// @throws MeshError for more crossings than memory is meant for
TraceGraph trace_graph(const Rectangle& box, std::span<const std::vector<Point>> traces, double reach);

/// Areas, m2, of the parts of the box that edges part from each other, in no particular order.
std::vector<double> parted_areas(const TraceGraph& graph);

}  // namespace crackle
