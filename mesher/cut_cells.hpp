// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells cut by traces beside which no rows of mirrored seeds fit (traces closer than a grain).
//
// Corners near such a trace are first put onto it where the cells around stay convex, so that no slivers are cut off.
// A cell of whose cut more than half lies on the trace is cut whole, others are not: tips move to a cell's outline, by
// less than half a cell. Pieces smaller than smallest_piece_share of the mean cell join a neighbour with which they are
// convex, never across a trace. Tested by tests/mesher/cut_cells_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

/// Convex cells that share corners bit for bit, and corners on the line between two others of their outline where only
/// a neighbour has one.
struct TracedCells {
    VoronoiCells cells;
    std::vector<int> traces;     ///< by corner: on the edge to the cell's next corner; -1: none
    std::size_t cut = 0;         ///< cells cut
    std::size_t joined = 0;      ///< pieces joined
    std::size_t ends_moved = 0;  ///< tips that are elsewhere than asked
    double largest_move = 0.0;   ///< m
};

/// @param cut_by  edges of the graph to cut along  @param spacing  m, mean of the centres
/// @param least_share  of the mean cell: smaller pieces that join no neighbour are refused, others stay
/// @return the pieces of a cell have its centre
/// @throws MeshError naming traces that cut off a small piece which is convex with no neighbour
TracedCells cut_cells(const TracedCells& whole, const Rectangle& domain, const TraceGraph& graph,
                      std::span<const std::size_t> cut_by, double spacing, double least_share, Patience& patience);

}  // namespace crackle
