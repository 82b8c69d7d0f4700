// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells of a rectangle with edges that follow traces. Seeds are placed in rows along traces
// (mirrored_seeds.hpp), more densely if cell edges do not cover a trace. Some traces get no rows, because cells of a
// fifth of the spacing do not fit or would be below the smallest allowed size. These traces cut the cells they cross
// (cut_cells.hpp). Tested by tests/mesher/jointed_voronoi_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "mesher/cut_cells.hpp"
#include "mesher/mirrored_seeds.hpp"
#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

struct JointedCells {
    SeedSet seeds;       ///< seed of each cell; each piece of a cut cell has its own entry
    TracedCells traced;  ///< the cells, in seed order
};

/// Makes the cells. @throws MeshError that names the traces, if cells cannot follow them; also thrown under
/// the conditions of voronoi_cells()
JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience);

}  // namespace crackle
