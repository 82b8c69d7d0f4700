// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/confine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/linear/elastic.hpp"
#include "solver/membrane/press.hpp"
#include "solver/membrane/wrap.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/elastic/held_parts.hpp"
#include "specimens/loading/displace.hpp"

namespace crackle {
namespace {

constexpr int most_rounds = 100, steps_of_relaxation = 2000;
constexpr double most_left_by_a_solution = 0.5;  // of the force that was left before

/// Of each body of one world its number in another.
std::vector<BodyIndex> numbers_in(const World& other, const World& world) {
    std::unordered_map<int, BodyIndex> of_id;
    for (BodyIndex b = 0; b < other.bodies.size(); ++b) of_id.emplace(other.bodies.info(b).id, b);
    std::vector<BodyIndex> numbers;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) numbers.push_back(of_id.at(world.bodies.info(b).id));
    return numbers;
}

/// What is missing to equilibrium under the pressure.
struct Imbalance {
    double force = 0.0;   ///< largest on a body that bonds hold, over the pressure on a particle's width
    double stress = 0.0;  // N/m, pressure less that of the platens
};

class Confinement {
  public:
    Confinement(VirtualTest& test, const World& bonded, const TestSetup& own)
        : test_(test),
          world_(test.world),
          bonded_(bonded),
          own_(own),
          number_(numbers_in(bonded, test.world)),
          pressure_(*test.description.confinement.pressure),
          particle_(std::sqrt(test.setup.width * test.setup.height / static_cast<double>(test.setup.particles))),
          held_(bonded.bodies.size(), true) {
        for (const BodyIndex b : find_free_motions(bonded, bodies_of_parts(own)).bodies) held_[b] = false;
    }

    void run() {
        const std::vector<BodyState> moving = {world_.bodies.state.begin(), world_.bodies.state.end()};
        const std::int64_t broken = world_.bonds.broken, step = world_.stepping.steps;
        const double time = world_.stepping.time, kick_share = world_.stepping.kick_share;
        const std::size_t events = world_.bonds.events.size();
        displace(world_, std::vector<BodyMotion>(moving.size()));  // at rest
        add_membrane(world_, pressure_, 0.5 * particle_, test_.setup.bottom, test_.setup.top);
        compute_forces(world_);
        Imbalance left = imbalance();
        for (int round = 0; !settled(left); ++round) {
            if (round == most_rounds) refuse(left, "");
            try {
                approach(left);
            } catch (const UnstableRun& error) {
                refuse(left, fmt::format(" ({})", error.what()));
            }
            const double before = left.force;
            left = imbalance();
            if (settled(left) || left.force < most_left_by_a_solution * before) continue;
            relax();
            left = imbalance();
        }
        world_.stepping.steps = step;
        world_.stepping.time = time;
        world_.stepping.kick_share = kick_share;
        for (std::size_t k = events; k < world_.bonds.events.size(); ++k) {
            world_.bonds.events[k].step = step;
            world_.bonds.events[k].time = time;
        }
        if (world_.bonds.broken > broken) {
            test_.setup.notices.push_back(
                fmt::format("{} of {} bonds broke under the confining pressure alone, before loading",
                            world_.bonds.broken - broken, world_.bonds.initial));
        }
        for (BodyIndex b = 0; b < moving.size(); ++b) {
            BodyState& body = world_.bodies.state[b];
            body.vx = moving[b].vx;
            body.vy = moving[b].vy;
            body.omega = moving[b].omega;
        }
        for (const BodyIndex platen : {test_.setup.bottom, test_.setup.top})
            change_velocity(world_, platen, 1, moving[platen].vy);
        restart_account(world_);
        velocities_changed(world_);
        compute_forces(world_);
        strains_begin_at(test_.setup, world_);
        test_.setup.confining_pressure = pressure_;
    }

  private:
    static bool finite(const Imbalance& left) { return std::isfinite(left.force) && std::isfinite(left.stress); }
    bool settled(const Imbalance& left) const {
        return left.force <= most_unbalanced && std::abs(left.stress) <= most_unbalanced * pressure_;
    }

    Imbalance imbalance() const {
        Imbalance left;
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            if (test_.setup.is_platen(b) || !held_[number_[b]]) continue;
            const BodyForce& force = world_.bodies.force[b];
            left.force = std::max(left.force, std::hypot(force.fx, force.fy) / (pressure_ * particle_));
        }
        left.stress = pressure_ - observe_row(world_, test_.setup).axial_stress;
        return left;
    }

    /// One solution: the forces left, and the strain that brings the platens' stress to the pressure.
    void approach(const Imbalance& left) {
        if (!finite(left)) refuse(left, "");
        std::vector<BodyMotion> loads(bonded_.bodies.size());
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            const BodyIndex k = number_[b];
            if (test_.setup.is_platen(b) || !held_[k]) continue;
            const BodyForce& force = world_.bodies.force[b];
            loads[k] = {force.fx, force.fy, force.torque};
        }
        const ElasticSolution solved = solve_elastic(bonded_, {{own_.bottom, {}}, {own_.top, {}}}, loads);
        // Held in place by more force from outside is pressed by as much more from within.
        const double gained = 0.5 * (solved.reaction[0].y - solved.reaction[1].y) / test_.setup.width;
        const Moduli& moduli = test_.small_strain->moduli;
        const double strain = (left.stress - gained) / moduli.youngs_modulus;
        std::vector<BodyMotion> way(world_.bodies.size());
        for (BodyIndex b = 0; b < way.size(); ++b) {
            const BodyMotion &by_load = solved.displacement[number_[b]],
                             &by_strain = moduli.solution.displacement[number_[b]];
            way[b] = {by_load.x - strain * by_strain.x, by_load.y - strain * by_strain.y,
                      by_load.rotation - strain * by_strain.rotation};
        }
        way[test_.setup.bottom] = {};
        way[test_.setup.top] = {0.0, -strain * test_.setup.height, 0.0};
        displace(world_, way);
    }

    /// Where bonds slide, or particles roll until something holds them, no linear solution helps: some steps of motion,
    /// which ends each time that the kinetic energy has passed its peak (Cundall's kinetic damping). Platens stay in
    /// place.
    void relax() {
        double kinetic = 0.0;
        for (int n = 0; n < steps_of_relaxation; ++n) {
            compute_forces(world_);
            advance(world_);
            double now = 0.0;
            for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
                const BodyState& body = world_.bodies.state[b];
                now += world_.bodies.inertia[b].mass * (body.vx * body.vx + body.vy * body.vy) +
                       world_.bodies.info(b).moment * body.omega * body.omega;
            }
            if (now < kinetic) {
                set_velocities(world_, std::vector<BodyMotion>(world_.bodies.size()), 0.0);
                now = 0.0;
            }
            kinetic = now;
        }
        displace(world_, std::vector<BodyMotion>(world_.bodies.size()));  // at rest
    }

    [[noreturn]] void refuse(const Imbalance& left, const std::string& cause) const {
        throw InputError(
            fmt::format("{}: found no equilibrium under {:g} {}: by linear solutions a force of {:.2g} of the pressure "
                        "on a particle "
                        "was left, expected at most {:g}, and {} bonds had broken{}; lower the pressure",
                        test_.description.at("confinement.pressure"), pressure_, test_.description.stress_unit(),
                        left.force, most_unbalanced, world_.bonds.broken, cause));
    }

    VirtualTest& test_;
    World& world_;
    const World& bonded_;
    const TestSetup& own_;
    std::vector<BodyIndex> number_;  // in the bonded world
    double pressure_;                // N/m
    double particle_;                // m
    std::vector<bool> held_;         // by bonds, of the bonded world
};

}  // namespace

void confine(VirtualTest& test, const World& bonded, const TestSetup& own) {
    if (!test.small_strain) {
        throw InputError(
            fmt::format("{}: expected an elastic solution, by which the specimen is brought under pressure: {}",
                        test.description.at("confinement.pressure"), test.no_small_strain));
    }
    Confinement(test, bonded, own).run();
}

}  // namespace crackle
