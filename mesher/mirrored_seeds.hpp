// SPDX-License-Identifier: GPL-3.0-or-later
// Seeds whose Voronoi cells have edges along traces: pairs mirrored across a trace, and rings about its nodes.
//
// The Voronoi edge of two mirrored seeds lies on the trace. Four seeds of two neighbouring pairs lie on a circle about
// a place on the trace; where it holds no other seed, both edges end there, so that a row of pairs makes a chain
// of edges. The pairs are the packing's own seeds of one side and their images; even rows where other traces or walls
// are near. About a node (a tip, a bend, a crossing, an end on a wall) the seeds lie on a circle, the same angle on
// either side of every trace: the chains end there exactly (as Abdelkader et al., ACM Trans. Graph. 39, 2020, in the
// plane).
// Tested by tests/mesher/jointed_voronoi_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {

struct SeedSet {
    std::vector<CellCentre> places;
    std::vector<int> centre;   ///< given centre at the place, or for an added seed the one nearest to it
    std::vector<char> added;   ///< whether it belongs to a trace
    std::size_t left_out = 0;  ///< centres that made way
};

/// @param spacing  m, mean of the centres: rows of pairs are as wide, and less where traces come closer
/// @param shrink  by edge of the graph: factor on the width there
SeedSet mirrored_seeds(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                       double spacing, std::span<const double> shrink);

}  // namespace crackle
