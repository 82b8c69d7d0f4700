// SPDX-License-Identifier: GPL-3.0-or-later
// Seeds whose Voronoi cells have edges along traces: pairs mirrored across a trace, and rings around the nodes of
// traces.
//
// The Voronoi edge between two mirrored seeds lies on the trace. The four seeds of two neighbouring pairs lie on a
// circle around a point on the trace. If this circle contains no other seed, both edges end at that point, so that a
// row of pairs gives a chain of edges. The pairs are the packing's own seeds on one side with their mirror images; near
// other traces or walls they are evenly spaced rows. Around a node (an end, a bend, a crossing, an end on a wall) the
// seeds lie on a circle, at equal angles on either side of every trace. The chains then end exactly at the node (as in
// Abdelkader et al., ACM Trans. Graph. 39, 2020, in the plane).
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
    std::vector<int> centre;   ///< for each seed, index of its centre, or of the nearest centre for an added seed
    std::vector<char> added;   ///< for each seed, whether it was added for a trace
    std::size_t left_out = 0;  ///< number of centres that were omitted
};

/// Places the seeds. @param spacing mean spacing of the centres, m. It is the width of the rows of pairs, which is
/// reduced where traces are close together
/// @param shrink for each edge of the graph, factor on the width of the rows along that edge
SeedSet mirrored_seeds(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                       double spacing, std::span<const double> shrink);

// Angles are computed only from sums, products and square roots, which all processors round identically. The sine of a
// mathematical library may differ in the last digit between machines, so that the seeds would also differ.

/// Angle of a direction, rad, from -π to π, with an error of about 1e-15. The angle is reduced to half a quadrant. Then
/// the tangent of an eighth of the angle is computed and inserted into the arctangent series.
double angle_of(double x, double y);
/// Unit vector at an angle of at most a few turns, rad: sums the series for 1/64 of the angle and doubles the angle six
/// times.
Point direction_at(double angle);

}  // namespace crackle
