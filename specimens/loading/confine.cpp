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
// Dynamic steps follow a linear solution unless it reduces the largest residual force to less than this fraction.
constexpr double most_left_by_a_solution = 0.5;
// The stage gives up after most_rounds_in_vain consecutive rounds in which the residual does not fall to half its
// smallest value.
constexpr int most_rounds_in_vain = 10;
constexpr double most_left_by_rounds = 0.5;
// The specimen slides as a whole if the magnitude of the summed forces along x on its particles is at least this
// fraction of the sum of their magnitudes.
constexpr double share_of_one_way = 0.5;
// Parts are moved until the undeformed specimen carries their force: relative tolerance of the force, and first and
// largest displacement relative to the particle size.
constexpr double near_enough = 1e-3, first_way = 1e-5, farthest_way = 0.25;
constexpr int most_tries = 100;  // largest number of doublings and bisections, enough to reach round-off

/// Index in world `other` of each body of `world`.
std::vector<BodyIndex> numbers_in(const World& other, const World& world) {
    std::unordered_map<int, BodyIndex> of_id;
    for (BodyIndex b = 0; b < other.bodies.size(); ++b) of_id.emplace(other.bodies.info(b).id, b);
    std::vector<BodyIndex> numbers;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) numbers.push_back(of_id.at(world.bodies.info(b).id));
    return numbers;
}

/// Deviation from equilibrium under the pressure.
struct Imbalance {
    double force = 0.0;   ///< largest force on a body held by bonds, relative to the pressure times the particle size
    double stress = 0.0;  // N/m; pressure minus the stress on the platens
};

class Confinement {
  public:
    Confinement(VirtualTest& test, const World& bonded, const TestSetup& own)
        : test_(test),
          world_(test.world),
          bonded_(bonded),
          own_(own),
          number_(numbers_in(bonded, test.world)),
          pressure_(test.description.pressure()),
          particle_(std::sqrt(test.setup.specimen.width * test.setup.specimen.height /
                              static_cast<double>(test.setup.specimen.particles))),
          held_(bonded.bodies.size(), true) {
        find_held();
    }

    void run() {
        const std::vector<BodyState> moving = {world_.bodies.state.begin(), world_.bodies.state.end()};
        const std::int64_t broken = world_.bonds.broken, step = world_.stepping.steps;
        const double time = world_.stepping.time, kick_share = world_.stepping.kick_share;
        const std::size_t events = world_.bonds.events.size();
        displace(world_, std::vector<BodyMotion>(moving.size()));  // sets all velocities to 0
        if (test_.setup.apparatus.has_walls()) {
            bring_parts();
            find_held();
        } else {
            add_membrane(world_, pressure_, 0.5 * particle_, test_.setup.apparatus.bottom, test_.setup.apparatus.top);
            compute_forces(world_);
        }
        settle();
        world_.stepping.steps = step;
        world_.stepping.time = time;
        world_.stepping.kick_share = kick_share;
        for (std::size_t k = events; k < world_.bonds.events.size(); ++k) {
            world_.bonds.events[k].step = step;
            world_.bonds.events[k].time = time;
        }
        if (world_.bonds.broken > broken) {
            test_.setup.origin.notices.push_back(
                fmt::format("{} of {} bonds broke under the confining pressure alone, before loading",
                            world_.bonds.broken - broken, world_.bonds.initial));
        }
        for (BodyIndex b = 0; b < moving.size(); ++b) {
            BodyState& body = world_.bodies.state[b];
            body.vx = moving[b].vx;
            body.vy = moving[b].vy;
            body.omega = moving[b].omega;
        }
        for (const BodyIndex platen : {test_.setup.apparatus.bottom, test_.setup.apparatus.top})
            change_velocity(world_, platen, 1, moving[platen].vy);
        // Loading starts with a solution in which the walls move outwards as the specimen widens.
        if (test_.setup.apparatus.has_walls()) test_.small_strain->moduli.solution = stretched();
        restart_account(world_);
        velocities_changed(world_);
        compute_forces(world_);
        strains_begin_at(test_.setup, world_);
        test_.setup.apparatus.confining_pressure = pressure_;
    }

  private:
    static bool finite(const Imbalance& left) { return std::isfinite(left.force) && std::isfinite(left.stress); }
    /// Residual force or stress relative to its limit, whichever is larger.
    double missing(const Imbalance& left) const {
        return std::max(left.force, std::abs(left.stress) / pressure_) / most_unbalanced;
    }
    bool settled(const Imbalance& left) const { return finite(left) && missing(left) <= 1.0; }

    void find_held() {
        held_.assign(held_.size(), true);
        for (const BodyIndex b :
             find_free_motions(bonded_, bodies_of_parts(own_.apparatus), closed_points(own_.apparatus)).bodies)
            held_[b] = false;
    }

    /// Moves the bodies until all forces are in equilibrium.
    void settle() {
        Imbalance left = imbalance();
        double least = missing(left);
        const auto or_refuse = [&](const auto& move) {
            try {
                move();
            } catch (const UnstableRun& error) {
                refuse(left, fmt::format(" ({})", error.what()));
            }
        };
        for (int round = 0, in_vain = 0; !settled(left); ++round, ++in_vain) {
            if (missing(left) <= most_left_by_rounds * least) {
                least = missing(left);
                in_vain = 0;
            }
            if (round == most_rounds || in_vain == most_rounds_in_vain) refuse(left, "");
            or_refuse([&] { approach(left); });
            const double before = left.force;
            left = imbalance();
            if (settled(left) || left.force < most_left_by_a_solution * before) continue;
            or_refuse([&] { relax(); });
            left = imbalance();
        }
    }

    /// Force along x with which a wall is driven, N.
    double force_of(BodyIndex wall) const {
        const auto control = std::ranges::find(world_.bodies.controls, wall, &ControlState::body);
        return control->force(0, world_.bodies.state[wall]);
    }
    double left_on(BodyIndex wall) const { return world_.bodies.force[wall].fx + force_of(wall); }

    /// Moves each wall, and each platen that is not bonded, until the specimen carries its force. Particles stay at
    /// rest meanwhile, so the force increases with the displacement.
    void bring_parts() {
        struct Way {
            BodyIndex part;
            bool wall;
            double start, inwards, force, way;      // m, -, N, m
            double too_little = 0.0, enough = 0.0;  // m, bounds of the displacement; 0 until found
            bool done = false;
        };
        const auto place = [&](const Way& one) -> double& {
            BodyState& body = world_.bodies.state[one.part];
            return one.wall ? body.x : body.y;
        };
        const bool platens_touch = test_.description.loading.platens == PlatenKind::frictional;
        std::vector<Way> ways;
        for (const SetupPart& part : test_.setup.apparatus.parts) {
            if (!part.wall && !platens_touch) continue;
            const bool low = part.wall ? force_of(part.body) > 0.0 : part.body != test_.setup.apparatus.top;
            const double force = pressure_ * (part.wall ? test_.setup.specimen.height : test_.setup.specimen.width);
            ways.push_back({part.body, part.wall, 0.0, low ? 1.0 : -1.0, force, first_way * particle_});
            ways.back().start = place(ways.back());
        }
        for (int n = 0; !std::ranges::all_of(ways, &Way::done); ++n) {
            world_.workers.hear();
            const auto late = std::ranges::find(ways, false, &Way::done);
            if (n == most_tries || late->way > farthest_way * particle_)
                refuse_part(late->wall, late->way, late->force);
            for (const Way& one : ways) place(one) = one.start + one.inwards * one.way;
            bodies_moved(world_);
            compute_forces(world_);
            for (Way& one : ways) {
                const BodyForce& borne = world_.bodies.force[one.part];
                const double left = one.force + one.inwards * (one.wall ? borne.fx : borne.fy);
                one.done = std::abs(left) <= near_enough * one.force;
                if (one.done) continue;
                (left > 0.0 ? one.too_little : one.enough) = one.way;
                one.way = one.enough > 0.0 ? 0.5 * (one.too_little + one.enough) : 2.0 * one.way;
            }
        }
    }

    /// Linear solution for a strain of 1 between the platens. It is the solution in Moduli or, with walls, one in which
    /// the walls keep their force.
    ElasticSolution stretched() const {
        return solve_elastic(bonded_, prescribed_parts(own_.apparatus, own_.apparatus.length), {},
                             closed_points(own_.apparatus));
    }

    Imbalance imbalance() const {
        Imbalance left;
        for (const SetupPart& part : test_.setup.apparatus.parts)
            if (part.wall) left.force = std::max(left.force, std::abs(left_on(part.body) / force_of(part.body)));
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            if (test_.setup.apparatus.is_platen(b) || !held_[number_[b]]) continue;
            const BodyForce& force = world_.bodies.force[b];
            left.force = std::max(left.force, std::hypot(force.fx, force.fy) / (pressure_ * particle_));
        }
        left.stress = pressure_ - observe_row(world_, test_.setup).axial_stress;
        return left;
    }

    /// Moves the bodies by one linear solution, for the residual forces and for the strain that makes the platens'
    /// stress equal to the pressure.
    void approach(const Imbalance& left) {
        if (!finite(left)) refuse(left, "");
        std::vector<BodyMotion> loads(bonded_.bodies.size());
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            const BodyIndex k = number_[b];
            if (test_.setup.apparatus.is_platen(b) || !held_[k]) continue;
            const BodyForce& force = world_.bodies.force[b];
            loads[k] = {force.fx, force.fy, force.torque};
        }
        for (const SetupPart& part : own_.apparatus.parts)
            if (part.wall) loads[part.body].x = left_on(part.body);
        const ElasticSolution solved =
            solve_elastic(bonded_, prescribed_parts(own_.apparatus, 0.0), loads, closed_points(own_.apparatus));
        // The stress in the specimen changes by as much as the external stress.
        const double gained = -nominal_stress(own_.apparatus, solved.reaction);
        const ElasticSolution with_walls = own_.apparatus.has_walls() ? stretched() : ElasticSolution{};
        const ElasticSolution& stretch = own_.apparatus.has_walls() ? with_walls : test_.small_strain->moduli.solution;
        const double strain = (left.stress - gained) / nominal_stress(own_.apparatus, stretch.reaction);
        std::vector<BodyMotion> way(world_.bodies.size());
        for (BodyIndex b = 0; b < way.size(); ++b) {
            const BodyMotion &by_load = solved.displacement[number_[b]], &by_strain = stretch.displacement[number_[b]];
            way[b] = {by_load.x - strain * by_strain.x, by_load.y - strain * by_strain.y,
                      by_load.rotation - strain * by_strain.rotation};
        }
        displace(world_, way);
    }

    /// Takes dynamic steps, because linear solutions do not help if bonds slide or particles roll until something stops
    /// them. All velocities are set to zero whenever the kinetic energy has passed a peak (Cundall's kinetic damping).
    /// Platens stay in place.
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
        displace(world_, std::vector<BodyMotion>(world_.bodies.size()));  // sets all velocities to 0
    }

    /// Net force along x that pushes the specimen out from between its platens, N; 0 unless it slides as a whole.
    double push_sideways() const {
        if (test_.setup.apparatus.has_walls()) return 0.0;
        double sum = 0.0, sizes = 0.0;
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            if (test_.setup.apparatus.is_platen(b) || !held_[number_[b]]) continue;
            const BodyForce& force = world_.bodies.force[b];
            sum += force.fx;
            sizes += std::hypot(force.fx, force.fy);
        }
        return std::abs(sum) >= share_of_one_way * sizes ? std::abs(sum) : 0.0;
    }

    [[noreturn]] void refuse(const Imbalance& left, const std::string& cause) const {
        const double push = push_sideways();
        const std::string text = fmt::format(
            "{}: found no equilibrium under {:g} {}: linear solutions left a force of {:.2g} of the pressure on a "
            "particle, expected at most {:g}, and {} bonds had broken{}",
            test_.description.at(CaseKey::confinement_pressure), pressure_, test_.description.stress_unit(), left.force,
            most_unbalanced, world_.bonds.broken, cause);
        if (!(push > 0.0)) throw PressureRefused(text);
        throw InputError(
            fmt::format("{}; the specimen slides between its platens, since the membrane's ends push it "
                        "sideways by {:.3g} N more than the platens hold; raise loading.platen_friction_angle",
                        text, push));
    }

    [[noreturn]] void refuse_part(bool wall, double way, double force) const {
        throw PressureRefused(fmt::format(
            "{}: found no position of the {} where the specimen carries {:.4g} N: {:.3g} m beyond first contact, "
            "expected less than a quarter of a particle, {:.3g} m",
            test_.description.at(CaseKey::confinement_pressure), wall ? "walls" : "platens", force, way,
            farthest_way * particle_));
    }

    VirtualTest& test_;
    World& world_;
    const World& bonded_;
    const TestSetup& own_;
    std::vector<BodyIndex> number_;  // indices of the bodies in bonded_
    double pressure_;                // N/m
    double particle_;                // m, particle size
    std::vector<bool> held_;         // whether bonds hold a body, by body of bonded_
};

}  // namespace

void confine(VirtualTest& test, const World& bonded, const TestSetup& own) {
    if (!test.small_strain) {
        throw InputError(fmt::format("{}: expected an elastic solution, which is needed to apply the pressure: {}",
                                     test.description.at(CaseKey::confinement_pressure), test.no_small_strain));
    }
    if (test.setup.apparatus.has_walls())
        Confinement(test, test.world, test.setup).run();
    else
        Confinement(test, bonded, own).run();
}

}  // namespace crackle
