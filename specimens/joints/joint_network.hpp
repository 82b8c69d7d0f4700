// SPDX-License-Identifier: GPL-3.0-or-later
// The joint traces of a specimen in its box: drawn from distributions ([[joint_set]]), or measured ([[trace]]).
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/clean_traces.hpp"
#include "specimens/joints/joint_request.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {

/// Origin of traces: a joint set, or measured traces.
struct JointSource {
    std::string name;
    std::optional<Joint> mechanics;  ///< empty: the joints have the properties of the rock
    std::string file{};              ///< name of the file with the measured traces; empty if there is no file
};

/// The joint traces in a box.
struct JointNetwork {
    Domain box;
    /// The sets and then the measured traces, each in the order of the request.
    std::vector<JointSource> sources;
    std::vector<JointTrace> traces;    ///< ordered by source
    Cleaning cleaning;                 ///< result of merging nodes that nearly coincided
    std::vector<std::string> notices;  ///< remarks on unexpected results

    /// Area of the box, m2.
    double area() const { return (box.x2 - box.x1) * (box.y2 - box.y1); }
};

/// Draws the sets until the requested amounts are reached, and reads the measured traces. Both are clipped to the box
/// and end exactly on its faces. Each set uses its own random numbers, so adding a set does not change the others.
///
/// Traces of finite length are placed as if midpoints were distributed over the whole plane (Poisson), so traces are as
/// dense near the walls as in the middle. The largest length limits how far outside the box a midpoint may be, but
/// some distributions have no upper limit. Lengths are therefore drawn in strata, each with its own largest length;
/// from one stratum to the next, the fraction of longer traces is halved. Spaced lines that scatter about their mean
/// direction are also drawn outside the box, up to a limit. This makes P10 perpendicular to that direction too small by
/// at most 0.1 % (OrientationLaw::stretch).
///
/// If `snap` or `shortest` is given, or the grain size is known, rows of a file that are segments of one
/// fault are joined (joined_rows). Finally, all traces are cleaned (clean_traces), so that a test, a mesh and a report
/// use the same traces.
/// @param centres  number of cells that will follow the traces; 0 if there are no cells. Without `shortest`,
/// traces shorter than the mean spacing of the cells are left out: walls cut off such short pieces, and small cells
/// beside them would limit the time step
/// @throws InputError if a file cannot be read, or if a set needs more than 100,000 traces
JointNetwork make_joints(const JointRequest& joints, const Domain& box, std::size_t centres = 0);

/// Checks that the apertures of joints can close. In a mesh, they must not exceed its gap, m. Among circles, they must
/// not exceed the smallest radius. @throws InputError
void check_apertures(const JointRequest& joints, double gap, bool meshed);

}  // namespace crackle
