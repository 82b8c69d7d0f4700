// SPDX-License-Identifier: GPL-3.0-or-later
// Loading platens: two flat rigid blocks, wider than the specimen, above and below it.
//
// Where their faces lie (t = segment thickness at bonding):
//   - circles: t outside the domain's face, so that a circle overlaps its platen by what it overlapped the wall it was
//     packed against;
//   - polygons: half the meshing thickness outside the face, so that the gap is the meshing thickness as everywhere;
//   - ragged polygons (no corner within the meshing thickness of the face): the meshing thickness outside the outermost
//     corner;
//   - frictional platens: just touching the outermost particle. Nothing bonds them, the test starts without force.
// A block and not one segment: behind a single segment a corner pressed in by more than t would be through, and pushed
// on. Before that, both carry the same force.
// Walls that press the sides of a confined specimen (confinement.side = "walls") are smooth blocks that reach beyond
// both platens, which they pass through; each moves along x by the force of the pressure on the initial height. They
// too just touch the outermost particle, and wait as far outside. The lower platen is fixed, the upper one moves at
// constant velocity; both are held laterally and in rotation. Other kinds of test have the parts that specimens/kinds
// describes: supports first, the one that drives last. Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"

namespace crackle {

struct Platens {
    int bottom_id = 0, top_id = 0;       ///< numbers after the input's largest: of the first part and of the last
    Apparatus apparatus;                 ///< parts of the kinds that have some; what stress and strain refer to
    double bottom_y = 0.0, top_y = 0.0;  ///< m, faces at the start of loading
    double velocity = 0.0;               ///< m/s of the upper one, upwards
    double parked = 0.0;                 ///< m, how far outside its face each waits while the specimen is bonded
    double walls_parked = 0.0;           ///< m, likewise the walls
    bool bonded = true;
    bool walls = false;  ///< that press the sides, numbered between the two: the left one, then the right one
};

/// How far apart platens wait while a specimen with frictional platens is bonded, in specimen heights.
inline constexpr double platen_parking_distance = 1.0;

/// Width of a platen over the specimen's: room for a specimen that bulges and sheds pieces.
inline constexpr double platen_width_ratio = 2.0;

/// Depth of a platen over the specimen's height: more than any corner is ever pressed in.
inline constexpr double platen_depth_ratio = 0.05;

/// Of a mean circle's diameter, from an outline that circles were cut by their centres with to a bonded face along it;
/// by as much more of a gap they are bonded to it.
inline constexpr double cut_circles_offset = 0.25;

/// Adds both platens and their controls to the specimen's scene, removes the walls and gives every particle the
/// velocity that grows linearly from the lower to the upper platen, so that loading sends no shock; of kinds with other
/// parts it stays at rest.
/// @param thick segment thickness at bonding, m
Platens add_platens(Scene& scene, const Specimen& specimen, const TestCase& test, double thick);

/// Brings frictional platens, and walls, from where they waited to where loading starts; bonded ones are there already.
void place_platens(World& world, const Platens& platens);

}  // namespace crackle
