// SPDX-License-Identifier: GPL-3.0-or-later
// The traces of a specimen's joints in its box: drawn by the laws of [[joint_set]], or measured ([[trace]]).
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"
#include "specimens/joints/clean_traces.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {

/// What traces come from: a set, or a [[trace]].
struct JointSource {
    std::string name;
    bool drawn = false;   ///< by laws
    std::size_t set = 0;  ///< into TestCase::joint_set, where drawn
    /// rad, mean direction of a set by its laws; not a number of measured traces.
    double direction = std::numeric_limits<double>::quiet_NaN();
    std::string file{};  ///< name of that of measured traces; empty where they have none
};

struct JointNetwork {
    Domain box;
    std::vector<JointSource> sources;  ///< the sets, then the [[trace]] tables, in the case's order
    std::vector<JointTrace> traces;    ///< by source
    Cleaning cleaning;                 ///< what brought nodes together that nearly coincided
    std::vector<std::string> notices;  ///< what may surprise

    double area() const { return (box.x2 - box.x1) * (box.y2 - box.y1); }
};

/// Draws the sets until their amounts are reached and reads the measured traces; both are clipped by the box, on whose
/// faces they then end exactly. A set has random numbers of its own: another one beside it changes nothing in it.
/// Traces of their own are placed as if midpoints were strewn over the whole plane (Poisson), so that the box's rim is
/// no different from its middle: the longest of all lengths says how far off a midpoint may be, and lengths are drawn
/// in strata, each with its own longest (a factor of 2 in the share of longer ones), for a law without an end has none.
/// Lines at a spacing that scatter about their mean direction are drawn from so far off that P10 across that lacks at
/// most one in a thousand (OrientationLaw::stretch).
/// Where joints.snap or joints.shortest is given, or the grain is known, rows of a file that are segments of one fault
/// are joined (joined_rows) and all traces cleaned (clean_traces): what a test, a mesh and a report have are the same
/// traces.
/// @param centres  of cells that will follow the traces, 0 where none will: without joints.shortest, traces shorter
/// than the mean spacing of these are left out; walls cut traces that short, and cells beside them would set the time
/// step
/// @throws InputError for a file that cannot be read, a plane without a trace, an amount beyond 100,000 traces
JointNetwork make_joints(const TestCase& test, const Domain& box, std::size_t centres = 0);

}  // namespace crackle
