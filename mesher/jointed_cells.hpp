// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells of a rectangle whose edges follow traces: seeds along traces (mirrored_seeds.hpp), smaller where the
// edges of the cells do not yet cover a trace, until they do. Where cells as small as a fifth of the spacing do not
// fit, or would be smaller than pieces may be, the trace has no seeds of its own and cuts the cells that it meets
// (cut_cells.hpp).
// Tested by tests/mesher/jointed_voronoi_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "mesher/cut_cells.hpp"
#include "mesher/mirrored_seeds.hpp"
#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

struct JointedCells {
    SeedSet seeds;       ///< pieces of cut cells have one each
    TracedCells traced;  ///< of the seeds, by their number
};

/// @throws MeshError naming traces that cells cannot follow, and as voronoi_cells() does
JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience);

}  // namespace crackle
