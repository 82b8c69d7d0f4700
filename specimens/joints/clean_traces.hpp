// SPDX-License-Identifier: GPL-3.0-or-later
// Cleans traces so that cells can follow them, by merging nodes that nearly coincide.
//
// Round-off in a survey, or a point digitised beside a node, leaves gaps far below the grain size, which cells would
// have to fill. A single tolerance, snap, controls the cleaning:
//     - points of a trace within snap/4 of a straight line between other points are removed (Douglas & Peucker 1973);
//     - an end is extended along its own line to the trace or wall to which the mesher would extend it;
//     - points and crossings within snap/2 of a wall or of an earlier node are moved onto it;
//     - a trace that passes within snap/2 of a node is routed through the node; if two traces run that close together,
//       the later one follows the earlier, and leaves it at an angle that cells can fill.
// Displacements are measured from the original trace: no point moves farther than snap, however long a chain of nearby
// nodes is. Nodes are at least snap/2 apart, so their number is bounded and the iteration ends. The points of a trace
// that needs no cleaning stay bit-identical. The result depends on the order of the traces.
// Tested by tests/specimens/joints/clean_traces_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {

/// Default value of snap, relative to the mean spacing of the grains.
inline constexpr double snap_share = 0.2;

/// Summary of what the cleaning changed.
struct Cleaning {
    double snap = 0.0;                ///< m; 0 if no cleaning was done
    bool derived = false;             ///< whether snap was derived from the grain spacing
    std::size_t points_left_out = 0;  ///< number of trace points removed by simplification
    /// Number of points moved to a node or wall, and of nodes through which traces were routed.
    std::size_t brought_together = 0;
    double largest_displacement = 0.0;  ///< m, largest displacement of any trace
    double coincident = 0.0;            ///< m, total length of parts of traces that lie on earlier traces or on walls
    double length_before = 0.0, length = 0.0;  ///< m, total length of all traces, before and after cleaning

    /// Whether cleaning has changed any trace.
    bool changed() const { return points_left_out > 0 || brought_together > 0 || coincident > 0.0; }
};

/// The summary as one line of text; empty if no cleaning was done.
std::string cleaning_text(const Cleaning& cleaning);

/// Cleans traces.
/// @param traces  traces within the box or on its boundary; a trace that lies on earlier ones is removed or split into
/// pieces
/// @param reach  as in trace_graph(), m; extending an end to a trace or wall by up to this distance does not count as
/// displacement
/// @throws MeshError if memory is insufficient for the number of nearby edges
Cleaning clean_traces(std::vector<JointTrace>& traces, const Domain& box, double snap, double reach);

}  // namespace crackle
