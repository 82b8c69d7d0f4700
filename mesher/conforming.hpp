// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation of a rectangle with edges that follow traces. A constrained Delaunay triangulation is refined
// until all triangles are Delaunay and no angle at a trace is below 20 degrees. Exceptions are traces that meet at a
// smaller angle (Shewchuk, Comput. Geom. 22, 2002).
// Tested by tests/mesher/jointed_delaunay_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

/// Triangles with traces on their edges, and the numbers of omitted and added points.
struct ConformingTriangles {
    Triangles triangles;  ///< the triangles, with their `traces` set
    /// Number of centres omitted because triangles between them and a trace would be badly shaped.
    std::size_t left_out = 0;
    std::size_t added = 0;  ///< number of interior points that are not centres: on traces and near them
};

/// Triangulates centres, points on walls and points on traces. Further points are added near traces where triangles
/// would be badly shaped.
/// @param spacing mean spacing of the centres, m; edges along a trace have about this length
/// @throws MeshError that names the traces, if they are too close together or meet at too small an angle
ConformingTriangles conforming_triangles(std::span<const CellCentre> centres, const Rectangle& domain,
                                         const TraceGraph& graph, double spacing, Patience& patience);

}  // namespace crackle
