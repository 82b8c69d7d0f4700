// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangles of a rectangle whose edges follow traces (constrained Delaunay, refined until it is Delaunay and
// no angle at a trace is below 20 degrees, but where traces themselves meet at less; Shewchuk, Comput. Geom. 22, 2002).
// Tested by tests/mesher/jointed_delaunay_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

/// Triangles with the traces on their edges, and what it took.
struct ConformingTriangles {
    Triangles triangles;       ///< `traces` filled
    std::size_t left_out = 0;  ///< centres nearer to a trace than a fair triangle needs
    std::size_t added = 0;     ///< points inside that no centre is: on traces and beside them
};

/// Centres, points of the walls and of the traces, and further ones beside traces where triangles would be poor.
/// @param spacing  m, mean of the centres: about as long are the edges along a trace
/// @throws MeshError naming traces that meet too close together for the domain's digits
ConformingTriangles conforming_triangles(std::span<const CellCentre> centres, const Rectangle& domain,
                                         const TraceGraph& graph, double spacing, Patience& patience);

}  // namespace crackle
