// SPDX-License-Identifier: GPL-3.0-or-later
// A step reduced to the arithmetic of contacts, with which the engine's speed is compared.
//
// Discs of one material interact through normal and incremental shear springs with dashpots and a Coulomb limit, by the
// engine's own code. Each point writes a record of 32 bytes; each body sums its records in a fixed order, then kick and
// drift follow. There are no neighbour search, walls, bonds, energy account, controls or observers. A body's state
// fills a cache line, and several points are processed at once (solver/base/lanes.hpp). The kernel uses one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/instruction_set.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"

namespace crackle::throughput {

class BareKernel {
  public:
    /// Copies the discs of a world and its touching circle-circle points, which are treated as unbonded. They get the
    /// contact law of the first body's material, with dashpots for the effective mass at the first point. Other bodies,
    /// such as platens, are left out.
    explicit BareKernel(const World& world);

    void step();
    void compute_forces();

    std::size_t bodies() const { return bodies_.size(); }
    std::size_t points() const { return points_.size(); }

    /// A point with the indices of its two bodies in the world, and the force on body i as in Points::force.
    struct Contact {
        BodyIndex i, j;
        PointForce force;
    };
    std::vector<Contact> contacts() const;

  private:
    struct alignas(64) Body {
        double x, y, vx, vy, omega, angle, radius, padding;
    };
    struct Inertia {
        double inverse_mass, inverse_moment;
    };
    struct Point {
        std::uint32_t i, j;
        double shear_force;
    };

    void move_bodies();
    // Defined in bare_forces.cpp, once for each instruction set.
    template <InstructionSet>
    void compute_forces_of();
    template <InstructionSet>
    void move_bodies_of();

    Array<Body> bodies_;
    Array<Inertia> inertia_;
    Array<Point> points_;  // padded to a multiple of most_lanes with points of a separate pair
    std::size_t real_points_ = 0;
    Array<PointForce> forces_;
    Array<std::uint32_t> begin_, slots_;
    std::vector<BodyIndex> world_body_;
    ContactLaw law_;
    double root_mass_;  // sqrt(kg), the same for all points
    double time_step_;
};

}  // namespace crackle::throughput
