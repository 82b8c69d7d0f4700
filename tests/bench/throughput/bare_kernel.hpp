// SPDX-License-Identifier: GPL-3.0-or-later
// A contact step stripped to its arithmetic: what the engine's rate is measured against.
//
// Discs of one material touch with normal spring and dashpot, and with incremental shear spring and dashpot under a
// Coulomb limit, by the same code as in the engine. Every point writes one record of 32 bytes; every body adds up its
// own in a fixed order and is kicked and drifted. No neighbour search, walls, bonds, ledger, controls or observers. A
// body's state fills a cache line, points are looked at several at a time (solver/base/lanes.hpp). On one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/instruction_set.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"

namespace crackle::throughput {

class BareKernel {
  public:
    /// Copies the discs of an unbonded world and its circle-circle points that touch, bonded or not. They have the
    /// contact law of the first body's material, with the dashpots of a ratio at the first point's effective mass.
    /// Bodies that are no single circles (platens) are left out.
    explicit BareKernel(const World& world);

    void step();
    void compute_forces();

    std::size_t bodies() const { return bodies_.size(); }
    std::size_t points() const { return points_.size(); }

    /// A point with its two bodies of the world and the force on i, as Points::force has it.
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
    // By the kernels (bare_forces.cpp).
    template <InstructionSet>
    void compute_forces_of();
    template <InstructionSet>
    void move_bodies_of();

    Array<Body> bodies_;
    Array<Inertia> inertia_;
    Array<Point> points_;  // padded to a multiple of most_lanes with points of a lone pair
    std::size_t real_points_ = 0;
    Array<PointForce> forces_;
    Array<std::uint32_t> begin_, slots_;
    std::vector<BodyIndex> world_body_;
    ContactLaw law_;
    double root_mass_;  // sqrt(kg), of every point
    double time_step_;
};

}  // namespace crackle::throughput
