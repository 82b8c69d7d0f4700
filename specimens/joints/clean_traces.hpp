// SPDX-License-Identifier: GPL-3.0-or-later
// Traces as cells can follow them: nodes that nearly coincide become one.
//
// The last digit of a survey, or a click beside a node, leaves gaps that no grain can see but that cells would have to
// fill. With one tolerance, snap:
//   - a trace loses the points that lie within snap/4 of a straight line between others (Douglas & Peucker 1973);
//   - an end goes along its own line to the trace or wall to which the mesher would take it;
//   - its points, and crossings, within snap/2 of a wall or of an earlier node go there;
//   - a trace that passes a node within snap/2 goes through it; where two traces run that close to each other for long,
//     the later one follows the earlier, and parts from it at an angle that cells can fill.
// Each step is judged against the trace as it was given: nothing ends up further than snap from there, however long a
// chain of near nodes is. Nodes stand at least snap/2 apart, so their number is bounded and the passes end.
// A trace that none of this concerns keeps its points, bit for bit. The order of the traces decides, nothing else.
// Tested by tests/specimens/joints/clean_traces_test.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {

/// Of the mean spacing of the grains: snap where the case gives none.
inline constexpr double snap_share = 0.2;

/// What cleaning did.
struct Cleaning {
    double snap = 0.0;                         ///< m; 0: nothing
    bool derived = false;                      ///< snap follows from the grain
    std::size_t points_left_out = 0;           ///< of traces, by simplification
    std::size_t brought_together = 0;          ///< nodes that moved to others, and traces that were led through them
    double largest_displacement = 0.0;         ///< m
    double coincident = 0.0;                   ///< m along which traces lay on earlier ones or on walls
    double length_before = 0.0, length = 0.0;  ///< m, of all traces

    bool changed() const { return points_left_out > 0 || brought_together > 0 || coincident > 0.0; }
};

/// One line for people; empty where there was no snap.
std::string cleaning_text(const Cleaning& cleaning);

/// @param traces  within the box or on its boundary; one that lies on earlier ones is left out, or comes in pieces
/// @param reach  m, as trace_graph() has it: what of an end's way to a trace or wall is no displacement
/// @throws MeshError for more near places than memory is meant for
Cleaning clean_traces(std::vector<JointTrace>& traces, const Domain& box, double snap, double reach);

}  // namespace crackle
