// SPDX-License-Identifier: GPL-3.0-or-later
// The world: the flat arrays used by a step, in groups. Each group lists its fields in one place. A world is built from
// a Scene (stepping/build_world.hpp); most steps allocate no memory.
//
// The forces of a body's points are added in a fixed order, so that results are identical for any number of threads.
#pragma once

#include <cmath>
#include <cstddef>

#include "solver/base/fields.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/bonds.hpp"
#include "solver/world/energy_account.hpp"
#include "solver/world/faces.hpp"
#include "solver/world/membrane.hpp"
#include "solver/world/neighbour_list.hpp"
#include "solver/world/points.hpp"
#include "solver/world/settings.hpp"
#include "solver/world/step_control.hpp"
#include "solver/world/workers.hpp"

namespace crackle {

/// The complete state of a run, as flat arrays.
struct World {
    Settings settings;
    Bodies bodies;
    Points points;
    NeighbourList list;
    StepControl stepping;
    Bonds bonds;
    EnergyAccount account;
    Membrane membrane;
    Faces faces;      // empty unless whole faces are bonded
    Workers workers;  // not part of the saved state

    /// Groups of the state that checkpoints save and state hashes cover. If the world has faces, `faces` is added to
    /// them.
    CRACKLE_MEMBERS(groups, settings, bodies, points, list, stepping, bonds, account, membrane);
};

inline BodyView::BodyView(const World& world)
    : state(world.bodies.state.data()),
      names(world.bodies.names.data()),
      shapes(world.bodies.shapes.data()),
      elements(world.bodies.elements.data()),
      pieces(world.bodies.pieces.data()),
      edges(world.bodies.edges.data()),
      segments(world.bodies.segments.data()),
      flat_faces(world.bodies.flat_faces.data()),
      bond_faces(&world.faces),
      convex_outlines(world.bodies.convex_outlines),
      mean_of_discs(world.settings.segment_law == SegmentLaw::demseg_mean),
      thick(world.settings.thick),
      domain(world.settings.domain) {}

/// Index into Settings::laws of the law between two bodies.
inline std::size_t law_between(const World& world, BodyIndex i, BodyIndex j) {
    return pair_number(world.bodies.names[i].material, world.bodies.names[j].material);
}

/// Index into Settings::laws of the law between two bodies with an unbreakable bond.
inline std::size_t held_law_between(const World& world, BodyIndex i, BodyIndex j) {
    return world.settings.pair_count() + law_between(world, i, j);
}

/// Index into Settings::laws of the law between a body and the domain's walls.
inline std::size_t law_with_wall(const World& world, BodyIndex i) {
    return 2 * world.settings.pair_count() + world.bodies.names[i].material;
}

/// Factor on the law's stiffness for point k; for two flat faces it includes their lap (shared length). Requires
/// own_shares().
inline double share_of_stiffness(const World& world, PointIndex k) {
    const double share = world.points.stiffness_share[k];
    return world.points.lap.empty() ? share : share * world.points.lap[k];
}

/// Square root of the effective mass that damping ratios use, sqrt(kg). For two flat faces, Points::root_mass is for a
/// lap (shared length) of one metre.
inline double root_mass_of(const World& world, PointIndex k) {
    const double root = world.points.root_mass[k];
    return world.points.lap.empty() ? root : root * std::sqrt(world.points.lap[k]);
}

/// Law of a point, including the point's own strength factor and a given stiffness factor. @param share the stiffness
/// factor
inline ContactLaw law_with(const World& world, PointIndex k, double share) {
    ContactLaw law = world.settings.laws[world.points.state[k].law];
    const double strength = world.points.strength_share[k];
    law.normal_stiffness *= share;
    law.shear_stiffness *= share;
    law.tensile_strength *= strength;
    law.cohesion *= strength;
    if (!world.points.shear_root.empty()) {
        const double root = world.points.shear_root[k];
        law.shear_stiffness *= root * root;
        law.shear_damping_ratio_term *= root;
    }
    return law;
}

/// Law of a point, including the point's own stiffness and strength factors.
inline ContactLaw law_of(const World& world, PointIndex k) {
    if (world.points.stiffness_share.empty()) return world.settings.laws[world.points.state[k].law];
    return law_with(world, k, share_of_stiffness(world, k));
}

/// Whether a world stores the arrays of Points that have the condition `remembered`.
bool keeps(const World& world, Remembered remembered);

/// Call this after changing velocities outside a step; the forces are then computed again.
inline void velocities_changed(World& world) { world.stepping.forces_current = false; }

/// Call this after changing positions or shapes outside a step; the neighbour list is then rebuilt as well.
inline void bodies_moved(World& world) {
    world.list.valid = false;
    velocities_changed(world);
}

/// Restarts the energy account at the next force pass, and discards previous losses and work.
void restart_account(World& world);

/// Sets the number of threads for the following steps; results do not depend on it. @throws InputError if the number is
/// not from 1 to 1024
void set_threads(World& world, int threads);

}  // namespace crackle
