// SPDX-License-Identifier: GPL-3.0-or-later
// Broken faces: pressure against an integral over the face, energy over a cycle, and a cell that rolls over another
// one. Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/faces/two_cells.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"

namespace crackle::verification {
namespace broken_faces {
namespace {

// ---- pressure

/// Integral of the pressure over a face, in panels. @param stiffness Pa/m
FaceForces integral(double stiffness, double half_lap, double opening, double turn) {
    constexpr int panels = 20'000;
    const double width = 2.0 * half_lap / panels;
    FaceForces sum;
    for (int n = 0; n < panels; ++n) {
        const double at = (n + 0.5) * width - half_lap;
        const double traction = stiffness * std::min(0.0, opening - turn * at) * width;
        sum.normal += traction;
        sum.moment -= at * traction;
    }
    return sum;
}

/// Integral with the pressures of both cells, which depend on the face's own forces: p̄ L/k_n adds to the opening.
FaceForces integral(const TwoCells& cells, double half_lap, double opening, double turn) {
    const double stiffness = cells.moduli.contact, share = 0.5;
    double low = -1.0, high = 1.0;  // Pa
    FaceForces forces;
    for (int n = 0; n < 60; ++n) {
        const double pressure = 0.5 * (low + high);
        forces = integral(stiffness, half_lap, opening + pressure / stiffness, turn);
        const double stretch = (forces.normal - pressure * TwoCells::length) / stiffness;
        (pressure > cells.pressure_per_area() * share * TwoCells::length * stretch ? high : low) = pressure;
    }
    return forces;
}

std::vector<ClaimRow> broken_face_presses_as_an_integral_does() {
    Rows rows;
    constexpr double turn = 0.01;  // rad, too small for contact points to replace the face
    FaceLaw law;
    law.tensile_strength = law.cohesion = 0.0;
    for (const bool pressure : {false, true}) {
        for (const double sliding : {0.0, 0.3}) {
            for (const double share : {-1.5, -0.5, 0.0, 0.5, 1.5}) {
                TwoCells cells = pressure ? two_cells(law, 0.4, 0.8) : two_cells(law, 0.0, 1.0);
                cells.place(1e-6, 0.0, 0.0);
                const double half_lap = 0.5 * (TwoCells::length - sliding), opening = share * half_lap * turn;
                // The pressure lags by one call, so it converges by a factor of ten per call.
                for (int n = 0; n < 100; ++n) cells.place(opening, sliding, turn);
                const FaceForces got = cells.forces(), expected = integral(cells, half_lap, opening, turn);
                const double scale = cells.moduli.contact * turn * half_lap * half_lap;  // N
                const std::string name =
                    fmt::format("{}slid by {} m, opening {} of that of the ends: ", pressure ? "with pressures, " : "",
                                sliding, share);
                rows.absolute(name + "force over k φ a²", got.normal / scale, expected.normal / scale, 1e-7, "panels");
                rows.absolute(name + "moment over k φ a³", got.moment / (scale * half_lap),
                              expected.moment / (scale * half_lap), 1e-7, "panels");
            }
        }
    }
    return rows.take();
}

// ---- energy

/// Work done on both cells by the prescribed motion, compared with their energy and losses, J.
class Account {
  public:
    explicit Account(TwoCells& cells) : cells_(cells), last_(now()), start_(energy()) {}

    void place(double opening, double sliding, double turn) {
        const std::vector<double> before = last_;
        cells_.place(opening, sliding, turn);
        last_ = now();
        // Coordinates are followed by the forces along them.
        for (std::size_t k = 0; k < last_.size(); k += 2)
            work_ -= 0.5 * (before[k + 1] + last_[k + 1]) * (last_[k] - before[k]);
    }
    double work() const { return work_; }
    double unaccounted() const { return work_ - (energy() - start_); }

  private:
    std::vector<double> now() const {
        std::vector<double> all;
        for (BodyIndex b = 0; b < 2; ++b) {
            const BodyState& body = cells_.world.bodies.state[b];
            const BodyForce& force = cells_.world.bodies.force[b];
            all.insert(all.end(), {body.x, force.fx, body.y, force.fy, body.angle, force.torque});
        }
        return all;
    }
    double energy() const {
        const EnergyAccount& account = cells_.world.account;
        return face_energy(cells_.world.faces) + account.friction_loss + account.fracture_loss + account.law_loss;
    }

    TwoCells& cells_;
    std::vector<double> last_;
    double start_, work_ = 0.0;
};

std::vector<ClaimRow> broken_face_accounts_for_its_work() {
    FaceLaw law;
    law.tensile_strength = 1e-3;
    law.cohesion = 2e-3;
    law.friction = law.residual_friction = 0.4;
    law.residual_cohesion = 5e-4;
    law.softening_slip = 0.02;
    law.residual_tensile_strength = 8e-4;
    law.softening_opening = 0.003;
    Rows rows;
    const auto unaccounted = [&](int steps) {
        TwoCells cells = two_cells(law, 0.26, 1.0 / 1.6);
        const auto place = [&](auto& at, double phase) {
            const double p = 2.0 * std::numbers::pi * phase;
            at.place(-0.002 + 0.004 * std::sin(p) - 0.001 * std::sin(2.0 * p), 0.02 * std::sin(p + 0.3),
                     0.015 * std::sin(3.0 * p));
        };
        place(cells, 0.0);  // breaks the face
        Account account(cells);
        for (int n = 1; n <= steps; ++n) place(account, static_cast<double>(n) / steps);
        return account.unaccounted() / account.work();
    };
    const double coarse = unaccounted(4'000), fine = unaccounted(40'000);
    rows.absolute("work less energy and losses, of the work", fine, 0.0, 1e-7, "second order")
        .converging({coarse, fine, 10.0, 2.0});
    return rows.take();
}

std::vector<ClaimRow> rubbed_face_loses_the_area_of_its_loop() {
    Rows rows;
    constexpr double closure = 1e-4, friction = 0.4;  // m, -
    FaceLaw law;
    law.tensile_strength = law.cohesion = 0.0;
    law.friction = law.residual_friction = friction;
    for (const double amplitude : {1e-3, 4e-4, 1e-4}) {
        TwoCells cells = two_cells(law, 0.0, 1.0);
        cells.place(-closure, 0.0, 0.0);
        constexpr int steps = 20'000;
        double start = 0.0;
        for (int n = 0; n <= 2 * steps; ++n) {
            cells.place(-closure, amplitude * std::sin(2.0 * std::numbers::pi * n / steps), 0.0);
            if (n == steps) start = cells.world.account.friction_loss;
        }
        const double limit = friction * cells.moduli.contact * closure;  // N, and k_t = E_c as κ = 1
        rows.relative(fmt::format("loss of a cycle of ±{} m, J", amplitude), cells.world.account.friction_loss - start,
                      4.0 * limit * (amplitude - limit / cells.moduli.contact), 0.5 * amplitude / TwoCells::length,
                      "shorter lap");
    }
    return rows.take();
}

// ---- rolling

constexpr double gap = 1e-3, pressing = 1e-4;  // m, N
constexpr int top_id = 2;

/// A square of side 1 m on a long cell, which is glued to a held block; nothing bonds the square, which is pressed
/// down.
World square_on_a_cell() {
    Scene scene;
    Material rock = any_material();
    rock.shear_stiffness = 1.0;
    rock.friction_angle = rock.residual_friction_angle = 60.0;
    scene.materials.push_back(rock);
    scene.time_step = 5e-3;
    scene.allow_unstable = true;
    scene.units = StiffnessUnits::area;
    scene.bond_law = BondLaw::face;
    scene.domain = {-10.0, 20.0, -10.0, 20.0, {false, false, false, false}};
    scene.thick = gap;
    const auto add = [&](int id, double x, double y, double width) {
        constexpr double half = 0.5 * gap;
        return static_cast<int>(scene.add_chain_body(id, 0,
                                                     {{x + half, y + half},
                                                      {x + width - half, y + half},
                                                      {x + width - half, y + 1.0 - half},
                                                      {x + half, y + 1.0 - half}},
                                                     true));
    };
    add(1, 0.0, 0.0, 4.0);
    Control pushed;
    pushed.body = add(top_id, 0.5, 1.0, 1.0);
    pushed.y = {Drive::force, -pressing};
    Control held;
    held.body = add(3, 0.0, -1.0, 4.0);
    held.x.drive = held.y.drive = held.rotation.drive = Drive::velocity;
    scene.controls = {pushed, held};
    World world = build_world(scene);
    FaceBonding bonding;
    bonding.materials.push_back({face_moduli(1.0, 0.0, 1.0, 0.0), {}});
    bonding.materials[0].law.friction = bonding.materials[0].law.residual_friction = 1.7;
    bonding.gap = gap;
    bonding.platens = PlatenFaces::glued;
    bonding.leaves = [&](BodyIndex i, BodyIndex j) {
        return world.bodies.names[i].id == top_id || world.bodies.names[j].id == top_id;
    };
    bond_by_faces(world, bonding);
    return world;
}

std::vector<ClaimRow> cell_rolls_over_another_as_a_rigid_block() {
    Rows rows;
    World world = square_on_a_cell();
    const BodyIndex top = body_of_id(world, top_id);
    BodyState& body = world.bodies.state[top];
    const double mass = world.bodies.inertia[top].mass, moment = world.bodies.info(top).moment;
    const auto kinetic = [&] {
        return 0.5 * mass * (body.vx * body.vx + body.vy * body.vy) + 0.5 * moment * body.omega * body.omega;
    };
    // The square turns about its lower right corner, with 1.5 times the energy that it needs to tip over the corner.
    const double diagonal = std::sqrt(0.5), energy = 1.5 * pressing * (diagonal - 0.5);
    body.omega = -std::sqrt(2.0 * energy / (moment + 0.5 * mass));
    body.vx = body.vy = -0.5 * body.omega;
    velocities_changed(world);
    const BodyState start = body;
    const double start_energy = kinetic();
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        for (int n = 0; n < 100'000 && start.angle - body.angle < angle; ++n) step(world);
        const double along = 0.75 * std::numbers::pi - (start.angle - body.angle);  // direction of the diagonal
        const std::string name = fmt::format("turned by {:.0f} degrees: ", degrees);
        rows.absolute(name + "kinetic energy given up over the force, m", (start_energy - kinetic()) / pressing,
                      diagonal * std::sin(along) - 0.5, 3.0 * gap, "round corner");
        rows.absolute(name + "way of the centre along the cell, m", body.x - start.x, diagonal * std::cos(along) + 0.5,
                      3.0 * gap, "round corner");
    }
    return rows.take();
}

}  // namespace
}  // namespace broken_faces

std::vector<Claim> broken_face_claims() {
    using namespace broken_faces;
    constexpr const char* group = "Faces";
    return {
        {.name = "broken_face_presses_as_an_integral_does",
         .group = group,
         .statement = "force and moment of a broken face are the integrals of k min(0, w) over the lap of its edges, "
                      "where the overlap w is linear; with pressures, p̄ L/k_n adds to w",
         .check = broken_face_presses_as_an_integral_does,
         .note = "20,000 panels; only the one in which w changes its sign has an error. The pressure of the cells is "
                 "found by bisection."},
        {.name = "broken_face_accounts_for_its_work",
         .group = group,
         .statement = "over a cycle of opening, sliding, turning and tearing, the work on two cells is the change of "
                      "their energy plus the losses to friction, fracture and the late pressure",
         .check = broken_face_accounts_for_its_work},
        {.name = "rubbed_face_loses_the_area_of_its_loop",
         .group = group,
         .statement = "a closed face that slides by ±a loses 4 μN(a − μN/k_t) per cycle",
         .check = rubbed_face_loses_the_area_of_its_loop,
         .note = "The lap, and with it N, falls by up to a/L, and by half of that on average."},
        {.name = "cell_rolls_over_another_as_a_rigid_block",
         .group = group,
         .statement = "a square pressed by a constant force rolls over its corner on another cell, gives up N times "
                      "the rise of its centre, and does not slip",
         .check = cell_rolls_over_another_as_a_rigid_block,
         .note = "The face ends at a turn of 0.04, and contact points take over. The corner is round with half the "
                 "gap, and N presses it in by about a tenth of that."},
    };
}

}  // namespace crackle::verification
