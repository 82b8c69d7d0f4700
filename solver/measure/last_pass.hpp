// SPDX-License-Identifier: GPL-3.0-or-later
// Spring forces in the last force pass, for observers that run after a step. After a step the shear springs still have
// the state of the last force pass, but the bodies have moved by one drift. The drift is therefore subtracted, which is
// exact up to round-off.
// Tested by tests/solver/measure/last_pass_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Load of one contact point in the last force pass.
struct PointLoad {
    // Force of the point's springs on body_i, N, without the back-tension of its bond; body_j receives the opposite
    // force.
    Vec2 force;
    Vec2 place;   // m, position midway between the two surfaces
    Vec2 normal;  // unit vector from i to j
};
/// Load of the springs of a contact point in the last force pass. At least one force pass must have been made.
PointLoad load_of_last_pass(const World& world, PointIndex point);
/// Whether a contact point may have carried load in the last force pass.
inline bool bore_in_last_pass(const World& world, PointIndex point) {
    return (world.points.state[point].flags & (point_touching | point_bonded)) != 0;
}

/// Load of one end of a face in the last force pass. Each end has half the face's force; the moment is a pair of forces
/// along the normal at the ends. @param at_start whether it is the end in the direction of -t
PointLoad end_load_of_last_pass(const World& world, FaceIndex face, bool at_start);
/// Whether a face carried load in the last force pass.
inline bool face_bore_in_last_pass(const World& world, FaceIndex face) {
    const PointForce& force = world.faces.force[face];
    return world.faces.broken_at[face] == no_face || force.fx != 0.0 || force.fy != 0.0;
}

/// Time of the last force pass, s.
double time_of_last_pass(const World& world);

}  // namespace crackle
