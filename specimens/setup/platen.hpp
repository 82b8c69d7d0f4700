// SPDX-License-Identifier: GPL-3.0-or-later
// Loading platens: two flat rigid blocks, wider than the specimen, above and below it.
//
// Positions of their faces (t = segment thickness when bonds are made):
//   - circles: t outside the domain's face, so that a circle overlaps its platen as much as it overlapped the wall
//     against which it was packed;
//   - polygons: half the meshing thickness outside the face; the gap then equals the meshing thickness, as elsewhere;
//   - ragged polygons (no corner within the meshing thickness of the face): one meshing thickness outside the outermost
//     corner;
//   - frictional platens: just touching the outermost particle. They are not bonded, and the test starts at zero force.
// A platen is a solid block rather than a single segment. A corner pressed into a segment by more than t would pass
// through it and be pushed out on the other side. Up to that overlap, block and segment exert the same force.
//
// Walls that press on the sides of a confined specimen (confinement.side = "walls") are smooth blocks. They extend
// beyond both platens and may overlap them. Each moves along x under the confining pressure times the initial height.
// Like frictional platens, walls just touch the outermost particle and are first parked at a distance.
//
// The lower platen is fixed and the upper one moves at constant velocity; both are fixed laterally and in rotation.
// Other kinds of test use the parts described in specimens/kinds: supports first, the driving part last.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"

namespace crackle {

/// The bodies that hold and drive a specimen.
struct Platens {
    int bottom_id = 0, top_id = 0;  ///< ids of the first and the last part; larger than all ids in the input
    Apparatus apparatus;  ///< parts for kinds of test without platens; reference dimensions of stress and strain
    double bottom_y = 0.0, top_y = 0.0;  ///< m, y of the faces at the start of loading
    double velocity = 0.0;               ///< velocity of the upper platen, m/s, positive upwards
    double parked = 0.0;  ///< m, distance of each platen from its initial position while the specimen is being bonded
    double walls_parked = 0.0;  ///< m, distance of each wall from its initial position during bonding
    bool bonded = true;
    bool walls = false;  ///< whether walls press on the sides; ids: lower platen, left wall, right wall, upper platen
};

/// Distance at which frictional platens are parked while a specimen is being bonded, in specimen heights.
inline constexpr double platen_parking_distance = 1.0;

/// Width of a platen relative to the specimen's width; leaves room for bulging and for pieces that break off.
inline constexpr double platen_width_ratio = 2.0;

/// Depth of a platen relative to the specimen's height; no corner is pressed in that far.
inline constexpr double platen_depth_ratio = 0.05;

/// Distance from a cut outline to the face bonded to it, relative to a mean circle's diameter. Circles are kept or
/// removed by their centres, so bonds to the face may also bridge a gap of up to this distance.
inline constexpr double cut_circles_offset = 0.25;

/// Adds both platens and their controls to the specimen's scene, and removes the walls. Every particle gets a velocity
/// that increases linearly from the lower to the upper platen, so that loading starts without a shock. In kinds of test
/// with other parts the particles start at rest.
/// @param thick  segment thickness when bonds are made, m
Platens add_platens(Scene& scene, const Specimen& specimen, const parts::Procedure& test, double thick);

/// Moves frictional platens and walls from their parked positions to the positions where loading starts. Bonded platens
/// are already in place.
void place_platens(World& world, const Platens& platens);

}  // namespace crackle
