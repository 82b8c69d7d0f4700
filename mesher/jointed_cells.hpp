// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells of a rectangle whose edges follow traces: seeds along traces (mirrored_seeds.hpp), smaller where the
// edges of the cells do not yet cover a trace, until they do.
// Tested by tests/mesher/jointed_voronoi_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "mesher/mirrored_seeds.hpp"
#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

struct JointedCells {
    SeedSet seeds;
    VoronoiCells cells;       ///< of the seeds, by their number
    std::vector<int> traces;  ///< by corner of the cells: on the edge to the cell's next corner; -1: none
};

/// @throws MeshError naming traces along which cells as small as a fifth of the spacing do not fit, and as
/// voronoi_cells() does
JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience);

}  // namespace crackle
