// SPDX-License-Identifier: GPL-3.0-or-later
// The world: the flat arrays that a step touches, in groups that each list their fields once. Built from a Scene
// (stepping/build_world.hpp); nothing in it is allocated during a step.
//
// The forces of a body's points are added up in a fixed order, so that the bytes of a result do not depend on the
// number of threads.
#pragma once

#include <cmath>
#include <cstddef>

#include "solver/world/bodies.hpp"
#include "solver/world/bonds.hpp"
#include "solver/world/energy_account.hpp"
#include "solver/world/membrane.hpp"
#include "solver/world/neighbour_list.hpp"
#include "solver/world/points.hpp"
#include "solver/world/settings.hpp"
#include "solver/world/step_control.hpp"
#include "solver/world/workers.hpp"

namespace crackle {

struct World {
    Settings settings;
    Bodies bodies;
    Points points;
    NeighbourList list;
    StepControl stepping;
    Bonds bonds;
    EnergyAccount account;
    Membrane membrane;
    Workers workers;  // never saved

    /// The groups that make up its state: what a checkpoint saves and a hash covers.
    template <class Self, class Visit>
    static constexpr void groups(Self& s, Visit&& visit) {
        visit("settings", s.settings);
        visit("bodies", s.bodies);
        visit("points", s.points);
        visit("list", s.list);
        visit("stepping", s.stepping);
        visit("bonds", s.bonds);
        visit("account", s.account);
        visit("membrane", s.membrane);
    }
};

/// A circle or vertex of a body, by BodyInfo::first_element or by ContactPoint.
inline Element element_of(const World& world, std::size_t body, std::uint32_t element) {
    if (element == own_circle) return {0.0, 0.0, world.bodies.state[body].shape[0], world.settings.thick};
    return world.bodies.elements[element];
}

/// Of two bodies, into Settings::laws.
inline std::size_t law_between(const World& world, BodyIndex i, BodyIndex j) {
    return pair_number(world.bodies.names[i].material, world.bodies.names[j].material);
}

/// The same where their bond cannot break.
inline std::size_t held_law_between(const World& world, BodyIndex i, BodyIndex j) {
    return world.settings.pair_count() + law_between(world, i, j);
}

/// Of a body against the domain's walls, into Settings::laws.
inline std::size_t law_with_wall(const World& world, BodyIndex i) {
    return 2 * world.settings.pair_count() + world.bodies.names[i].material;
}

/// Of the stiffness of a law, of a world with shares.
inline double share_of_stiffness(const World& world, PointIndex k) {
    const double share = world.points.stiffness_share[k];
    return world.points.lap.empty() ? share : share * world.points.lap[k];
}

/// What damping ratios go by, sqrt(kg): Points::root_mass, of flat faces that of a metre.
inline double root_mass_of(const World& world, PointIndex k) {
    const double root = world.points.root_mass[k];
    return world.points.lap.empty() ? root : root * std::sqrt(world.points.lap[k]);
}

/// Law of a point with its own share of strength. @param share of stiffness
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

/// Law of a point with its own share of stiffness and strength.
inline ContactLaw law_of(const World& world, PointIndex k) {
    if (world.points.stiffness_share.empty()) return world.settings.laws[world.points.state[k].law];
    return law_with(world, k, share_of_stiffness(world, k));
}

/// Whether this world keeps the arrays of points that are `remembered` so.
bool keeps(const World& world, Remembered remembered);

/// To be called when velocities were changed from outside a step: forces have to be found again.
inline void velocities_changed(World& world) { world.stepping.forces_current = false; }

/// To be called when places or shapes were changed from outside a step: the neighbour list has to be built again, too.
inline void bodies_moved(World& world) {
    world.list.valid = false;
    velocities_changed(world);
}

/// The account of energy begins again with the next force pass: losses and works so far are forgotten.
void restart_account(World& world);

/// Number of threads of the coming steps; never changes a result. @throws InputError outside 1..1024
void set_threads(World& world, int threads);

}  // namespace crackle
