// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts Voronoi cells along traces that are too close together for rows of mirrored seeds (less than about a grain
// apart).
//
// Corners near such a trace are first moved onto it, if the cells around them stay convex, so that no slivers are cut
// off. A cell in which a trace ends is cut along the whole line of the trace, and the end becomes a corner on the cut.
// The cell is not cut if less than 0.15 of the cut would lie on the trace, or if a small piece would be cut off. The
// end is then moved back to the cell's outline. If less than 0.15 of the cut lies beyond the end, the end is moved
// forward to the outline. Pieces smaller than smallest_piece_share of the mean cell are merged with a neighbour if the
// union is convex, but never across a trace. Tested by tests/mesher/cut_cells_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

/// Convex cells whose shared corners have identical coordinates. A cell may have flat corners, where only its neighbour
/// has a real corner.
struct TracedCells {
    VoronoiCells cells;
    std::vector<int> traces;     ///< for each corner: trace on the edge to the cell's next corner, or -1
    std::size_t cut = 0;         ///< number of cells that were cut
    std::size_t joined = 0;      ///< number of pieces merged with a neighbour
    std::size_t ends_moved = 0;  ///< number of trace ends that were moved
    double largest_move = 0.0;   ///< m, largest distance by which a trace end was moved
};

/// How to treat pieces that cannot be merged with a neighbour into a convex cell.
struct SmallPieces {
    double least_share;  ///< smallest area that is accepted, relative to the mean cell area
    bool divided_again;  ///< whether a smaller piece is united with a neighbour and the union is cut again
};

/// Cuts cells along traces. @param cut_by indices of the graph's edges along which to cut @param spacing mean spacing
/// of the centres, m
/// @return cells; all pieces of a cell keep its centre
/// @throws MeshError that names the traces, if they cut off a piece that is too small and there is no way to enlarge it
TracedCells cut_cells(const TracedCells& whole, const Rectangle& domain, const TraceGraph& graph,
                      std::span<const std::size_t> cut_by, double spacing, SmallPieces small_pieces,
                      Patience& patience);

}  // namespace crackle
