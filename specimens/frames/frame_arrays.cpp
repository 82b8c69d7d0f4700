// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/frame_arrays.hpp"

namespace crackle {
namespace {

constexpr Quantity fields_of_a_moment[]{
    {"axial_strain", "-", "axial strain of the frame, positive in the direction of loading"},
    {"axial_stress", "N/m", "mean stress on the two platens, positive in the direction of loading"},
    {"time", "s since loading began", "time of the frame"},
};
constexpr Quantity arrays_of_particles[]{
    {"id", "", "id of the body in the particle file or packing; platens have larger ids than all particles"},
    {"radius", "m", "radius of a circle; 0 for polygons and platens"},
    {"material", "",
     "one-based index of the material in the specimen's file: first the minerals in case order, then `[material]`"},
    {"angle", "rad", "rotation since loading began, positive counter-clockwise"},
    {"displacement", "m", "displacement since loading began; three components"},
    {"velocity", "m/s", "velocity half a time step before the frame; three components"},
    {"rotation_rate", "rad/s", "angular velocity half a time step before the frame, positive counter-clockwise"},
    {"stress_xx", "N/m", "xx component of the mean stress in the particle, positive in compression; 0 for platens",
     "symmetric part of the sum of force times arm over the contacts of the particle, divided by its area. Forces are "
     "those of springs relative to the bonded state, without dashpots, so the stress is 0 before loading"},
    {"stress_yy", "N/m", "yy component of the mean stress in the particle, as for stress_xx"},
    {"stress_xy", "N/m", "xy component of the mean stress in the particle, as for stress_xx"},
    {"fragment", "",
     "zero-based index of the fragment: particles connected by intact bonds, directly or through other particles, "
     "belong to one fragment",
     "fragments are sorted by descending area, those of equal area by their lowest id. Platens have -1 and connect no "
     "particles"},
};
constexpr Quantity arrays_of_contacts[]{
    {"body_i", "", "id of one body; for two polygons, the body whose corner touches the other's outline"},
    {"body_j", "", "id of the other body"},
    {"normal_force", "N", "elastic normal force, positive if it pushes the bodies apart"},
    {"shear_force", "N",
     "elastic shear force on body_i, positive along the normal from body_i to body_j turned by +90°"},
    {"state", "",
     "0: bond; 1: bond that has reached its Coulomb limit; 2: broken bond; 3: broken bond whose surfaces touch again "
     "(its forces are those of the contact); 4: contact without a bond"},
    {"age", "s",
     "time since loading began for an intact bond, and time since the break for a broken bond. For a contact without a "
     "bond, time since the first curve row in which it touched",
     "curve rows that are not written to curve.csv count as well; there are at least 2000 rows up to "
     "`loading.max_axial_strain`"},
    {"moment", "N m",
     "moment of a face on body_i, positive counter-clockwise; only for specimens bonded by faces, as are the two "
     "arrays that follow. They are 0 for contacts that are not faces"},
    {"stress_begin", "N/m",
     "normal stress at the first end of the face, N/L ± 6M/L² with its length L, positive in compression. The stress "
     "is linear along the face",
     "of a broken face, a negative value marks an open end: the pressure falls to 0 before it"},
    {"stress_end", "N/m", "normal stress at the second end of the face, as for stress_begin"},
};
constexpr Quantity arrays_of_cracks[]{
    {"body_i", "", "id of one body, as in events.csv"},
    {"body_j", "", "id of the other body, as in events.csv"},
    {"time", "s since loading began", "time of the break"},
    {"mode", "", "failure mode as in events.csv: 0 for tension, 1 for shear"},
    {"energy", "J", "energy dissipated by the break, as in events.csv"},
    {"orientation", "rad",
     "direction of the contact normal at the break, counter-clockwise from the x axis, in (-π/2, π/2]"},
    {"strength", "N", "strength of the bond, as in events.csv"},
    {"opening", "m",
     "current gap between the surfaces along the normal: 0 when the bond's overlap has just vanished, negative if the "
     "surfaces are pressed together again"},
    {"slip", "m",
     "current slip along a broken face, only for specimens bonded by faces; positive if an observer looking across the "
     "face sees the far side move to the left"},
    {"trace", "", "index of the joint trace as in events.csv, only for jointed specimens"},
};
constexpr Quantity arrays_of_joints[]{
    {"body_i", "", "id of one body"},
    {"body_j", "", "id of the other body"},
    {"trace", "", "zero-based index of the joint trace in `traces` of summary.json"},
    {"state", "", "0: bonded; 2: all bonds broken; 4: never bonded"},
    {"opening", "m",
     "opening along the face's normal since loading began, including the deformation of the face's springs"},
    {"slip", "m",
     "slip along the face since loading began, including the deformation of the face's springs; positive if an "
     "observer looking across the face sees the far side move to the left"},
};

}  // namespace

std::span<const Quantity> frame_fields() { return fields_of_a_moment; }
std::span<const Quantity> particle_arrays() { return arrays_of_particles; }
std::span<const Quantity> contact_arrays() { return arrays_of_contacts; }
std::span<const Quantity> crack_arrays() { return arrays_of_cracks; }
std::span<const Quantity> joint_arrays() { return arrays_of_joints; }

}  // namespace crackle
