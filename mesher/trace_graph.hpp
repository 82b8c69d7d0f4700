// SPDX-License-Identifier: GPL-3.0-or-later
// Traces of joints in a rectangle (box) as a graph. Nodes are the points where traces end, bend or meet; edges are the
// straight parts of traces and walls between nodes. Also computes the areas of the parts into which the edges divide
// the box.
// Tested by tests/mesher/trace_graph_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {

/// Nodes and edges into which traces and walls cut each other.
struct TraceGraph {
    /// A straight part of a trace or wall between two nodes.
    struct Edge {
        int from = -1, to = -1;  ///< indices of nodes
        int trace = -1;          ///< trace of the edge, or the lowest index if several traces coincide; -1 for a wall
    };
    /// An end of a trace that was moved.
    struct MovedEnd {
        int trace = -1;
        bool first = false;  ///< whether this is the end at the trace's first point
        Point place;         ///< new position of the end, on another trace or a wall
        int onto = -1;       ///< trace onto which the end was moved; -1 for a wall
        double by = 0.0;     ///< m, displacement along the trace's own line; negative if the trace was shortened
    };
    /// Two traces that coincide along an edge.
    struct Coincidence {
        int first = -1, second = -1;
        double length = 0.0;  ///< m
    };

    std::vector<Point> nodes;
    std::vector<Edge> edges;
    std::vector<MovedEnd> moved;
    std::vector<Coincidence> coincident;  ///< sorted by trace indices, each pair of traces once
};

/// Pairs i < j of segments that are within a reach of each other, and some that are slightly farther apart, sorted from
/// left to right. They are found by a sweep along x or, if too many segments would overlap, along the direction
/// perpendicular to most segments.
/// @throws MeshError if there are too many pairs for memory
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(std::span<const Segment> segments, double reach);

/// Builds the graph. Each node lies, up to round-off, on the lines of all traces that meet there.
/// @param traces consecutive points of each trace, within the box or on its boundary
/// @param reach distance, m; trace ends within this distance of another trace or a wall, before or beyond it, are moved
/// onto it. They move along their own line, by at most twice this distance
/// @throws MeshError if there are too many crossings for memory
TraceGraph trace_graph(const Rectangle& box, std::span<const std::vector<Point>> traces, double reach);

/// Areas of the parts into which the edges divide the box, m2, in no particular order.
std::vector<double> parted_areas(const TraceGraph& graph);

}  // namespace crackle
