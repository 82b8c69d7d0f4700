// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/prepare.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/loading/confine.hpp"
#include "specimens/loading/press.hpp"
#include "specimens/loading/quasi_static_start.hpp"
#include "specimens/loading/unlikely_numbers.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/setup/bonded_specimen.hpp"
#include "specimens/setup/lateral_control.hpp"
#include "specimens/setup/platen_hold.hpp"

namespace crackle {
namespace {

using Clock = std::chrono::steady_clock;

/// Reports the bonds and how the time step was determined.
void report_bonded(const TestHooks& hooks, const World& world, const TestSetup& setup, const ResolvedCase& test) {
    if (!hooks.detail) return;
    hooks.detail(fmt::format("{} bodies, {} segments; {} contact points touch, {} of them bonded; {} threads",
                             world.bodies.size(), setup.origin.segments, setup.bonds.contacts_initial,
                             world.bonds.initial, world.workers.threads));
    hooks.detail(fmt::format(
        "time step {:.4g} s, {}; stability limit {:.4g} s{}, guaranteed bound {:.4g} s", world.stepping.time_step,
        test.numerics.time_step ? std::string("given by the case")
                                : fmt::format("{:.3g} of the bound, updated as contacts open and close",
                                              world.stepping.time_step / world.stepping.step_bound),
        setup.stable_time_step, setup.stable_time_step_proved ? "" : " (a lower bound)", setup.time_step_bound));
}

// A loading rate controlled by a tolerance is derived from the strain at which this fraction of the bonded points has
// failed according to the linear solution. In six tests of the DEMseg guide's example rock, this strain is 0.1 to 1.3
// times the strain at the peak; individual slivers fail at a thousandth of it.
constexpr double first_yield_share = 0.02;
// Fraction for tests without platens, in which the stress is uneven and a disc or a beam fails once a few bonds have
// failed.
constexpr double first_yield_share_uneven = 0.001;

// Solving 50,000 cells takes 27 s and 3 GB; both grow faster than the number of bodies. Worlds with more bodies than
// this limit are therefore solved only on request.
constexpr std::size_t most_bodies_solved = 200'000;

void note_no_small_strain(VirtualTest& test, const std::string& why) {
    test.no_small_strain = why;
    test.setup.origin.notices.push_back("no small-strain modulus: " + why);
}

/// Computes the linear solution of a world with bonded platens, or adds a notice that states why there is none.
void solve_small_strain(VirtualTest& test, const World& world, const TestSetup& own, const SolutionVisitor& visit) {
    if (world.bodies.size() > most_bodies_solved) {
        note_no_small_strain(
            test,
            fmt::format(
                "found {} bodies, expected at most {} for computing this modulus in a test; use `crackle elastic`",
                world.bodies.size(), most_bodies_solved));
        return;
    }
    try {
        SmallStrain solved{solve_moduli(world, own), 0.0};
        solved.yield_strain = yield_strain(world, own.apparatus, solved.moduli,
                                           own.apparatus.uniaxial ? first_yield_share : first_yield_share_uneven);
        test.state.youngs_modulus = solved.moduli.youngs_modulus;
        test.state.poissons_ratio = solved.moduli.poissons_ratio;
        test.state.gauge_modulus = solved.moduli.gauge_modulus;
        test.state.modulus_residual = solved.moduli.solution.residual;
        if (visit) visit(world, own, solved.moduli);
        test.small_strain = std::move(solved);
    } catch (const InputError& error) {
        note_no_small_strain(test, error.what());
    }
}

/// Sets up the detection of acoustic events, which needs the shear wave speed. If this speed is unknown, a notice
/// states that there are no events.
void listen_for_emission(VirtualTest& test) {
    const parts::Output& output = test.description.output;
    if (!output.emission) return;
    try {
        test.state.emission.rule =
            emission_rule(test.world, test.setup, test.state.youngs_modulus, test.state.poissons_ratio,
                          output.out_of_plane_thickness.value_or(1.0));
    } catch (const InputError& error) {
        test.setup.origin.notices.push_back(std::string("no acoustic events: ") + error.what());
    }
}

/// Overlap at bonding, relative to the particle size, above which a notice reports that even polygons without a common
/// face are bonded.
constexpr double deep_bond_share = 0.1;

void notice_deep_bonds(VirtualTest& test) {
    const TestSetup& setup = test.setup;
    if (!setup.specimen.polygons) return;
    const double size =
        std::sqrt(setup.specimen.width * setup.specimen.height / static_cast<double>(setup.specimen.particles));
    const double excess = setup.bonds.thick - setup.specimen.mesh_gap;
    if (excess <= deep_bond_share * size) return;
    test.setup.origin.notices.push_back(fmt::format(
        "bond.thick = {:.4g} m exceeds the gap of {:.4g} m by {:.2g} of the mean particle size, so polygons without a "
        "common face are bonded, too; this excess is the overlap at bonding and should be small",
        setup.bonds.thick, setup.specimen.mesh_gap, excess / size));
}

// A notice is given if the strain rate in the case exceeds noticed_rate times the initial rate that rate_tolerance =
// noticed_tolerance would give.
constexpr double noticed_tolerance = 0.01, noticed_rate = 3.0;

void notice_fast_loading(VirtualTest& test) {
    if (!test.small_strain || !(test.small_strain->moduli.youngs_modulus > 0.0)) return;
    const double derived = largest_rate(rate_rule_of(test, noticed_tolerance));
    const double given = *test.description.loading.axial_strain_rate();
    if (given <= noticed_rate * derived) return;
    test.setup.origin.notices.push_back(fmt::format(
        "{} = {:.3g} 1/s is {:.2g} times the initial rate of rate_tolerance = {}, so that inertia and "
        "dashpots carry part of the stress; leave the rate out, or measure its effect with --verify",
        test.description.at(CaseKey::loading_axial_strain_rate), given, given / derived, noticed_tolerance));
}

/// A copy of the specimen with bonded platens, if the platens of the test are not bonded; otherwise `world` is nullptr.
struct SeparateBonding {
    const World* world = nullptr;
    const TestSetup* setup = nullptr;
    std::function<void()> while_solving;
};

/// Whether the specimen can carry the pressure of the case `lower`.
bool bears(const VirtualTest& refused, const ResolvedCase& lower, const Specimen& specimen,
           const SeparateBonding& twin) {
    VirtualTest attempt;
    attempt.description = lower;
    attempt.small_strain = refused.small_strain;
    BondedSpecimen bonded = bond_specimen(specimen, lower.bond, lower, twin.while_solving);
    attempt.world = std::move(bonded.world);
    compute_forces(attempt.world);
    attempt.setup = record_setup(attempt.world, specimen, bonded.platens, lower.loading.kind, lower.loading.grip);
    try {
        if (twin.world != nullptr)
            confine(attempt, *twin.world, *twin.setup);
        else
            confine(attempt, attempt.world, attempt.setup);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Confines the specimen. If it cannot carry the pressure, lower pressures are tried, and the error recommends one that
/// it can carry.
void confine_or_advise(VirtualTest& test, const Specimen& specimen, const SeparateBonding& twin) {
    try {
        if (twin.world != nullptr)
            confine(test, *twin.world, *twin.setup);
        else
            confine(test, test.world, test.setup);
    } catch (const PressureRefused& error) {
        for (const double share : {0.5, 0.1, 0.01, 0.001}) {
            ResolvedCase lower = test.description;
            lower.confinement->pressure *= share;
            if (bears(test, lower, specimen, twin))
                throw InputError(fmt::format("{}; lower the pressure; there is an equilibrium under {:.3g} {}",
                                             error.what(), lower.confinement->pressure, lower.stress_unit()));
        }
        throw InputError(
            fmt::format("{}; lower pressures, down to a thousandth, do not help either; check the strength of the "
                        "bonds, and whether particles are not held by any bond",
                        error.what()));
    }
}

/// Sets up the records of a bonded test, solves for small strain, and applies the confining pressure and the normal
/// force, under which bonds may break.
VirtualTest measure_and_confine(BondedTest made, const ResolvedCase& description, const TestHooks& hooks,
                                const SolutionVisitor& visit) {
    VirtualTest test = std::move(made.test);
    const Specimen& specimen = made.specimen;
    const std::function<void()>& while_solving = made.while_solving;
    const double grip = description.loading.grip;
    const LoadingKind kind = description.loading.kind;
    test.setup = record_setup(test.world, specimen, made.platens, kind, grip);
    if (!description.output.frames)
        test.description.output.frames = default_frames(test.setup.specimen.particles, description.output.curve_rows);
    test.state.failure.strength_drop = description.loading.strength_drop;
    test.state.failure.share_of_peak = description.loading.stop_at_share_of_peak;
    hooks.report_stage(fmt::format("bonded {} points of {} interfaces, time step {:.3g} s", test.world.bonds.initial,
                                   test.world.bonds.interfaces_initial, test.world.stepping.time_step));
    report_bonded(hooks, test.world, test.setup, description);
    hooks.report_work("solving for the small-strain moduli");
    for (std::string& notice : unlikely_numbers(description, test.setup.specimen))
        test.setup.origin.notices.push_back(std::move(notice));
    notice_deep_bonds(test);
    if (made.platens.bonded) {
        check_platen_hold(test.world, test.setup, made.platens, description.places);
        solve_small_strain(test, test.world, test.setup, visit);
        if (description.confined()) confine_or_advise(test, specimen, {nullptr, nullptr, while_solving});
        if (test.setup.apparatus.normal_force > 0.0 || test.setup.apparatus.normal_spring > 0.0) press(test);
    } else {
        parts::Procedure held = description;
        held.loading.platens = PlatenKind::bonded;
        BondedSpecimen twin = bond_specimen(specimen, description.bond, held, while_solving);
        compute_forces(twin.world);
        const TestSetup own = record_setup(twin.world, specimen, twin.platens, kind, grip);
        try {
            check_platen_hold(twin.world, own, twin.platens, description.places);
            solve_small_strain(test, twin.world, own, visit);
        } catch (const InputError& error) {
            note_no_small_strain(test, error.what());
        }
        // Outside the try block, because a specimen that cannot be confined cannot be tested.
        if (description.confined()) confine_or_advise(test, specimen, {&twin.world, &own, while_solving});
    }
    listen_for_emission(test);
    if (description.confined())
        hooks.report_stage(
            fmt::format("confined by {:.4g} {}", test.setup.apparatus.confining_pressure, description.stress_unit()));
    if (std::isfinite(test.state.youngs_modulus) && !test.setup.apparatus.uniaxial) {
        hooks.report_stage(fmt::format("small strain: nominal modulus {:.4g} {}", test.state.youngs_modulus,
                                       description.stress_unit()));
    } else if (std::isfinite(test.state.youngs_modulus)) {
        hooks.report_stage(fmt::format("small strain: E = {:.4g} {}, nu = {:.3g}", test.state.youngs_modulus,
                                       description.stress_unit(), test.state.poissons_ratio));
    }
    return test;
}

}  // namespace

BondedTest make_and_bond(const ResolvedCase& description, const TestHooks& hooks) {
    BondedTest made;
    VirtualTest& test = made.test;
    test.description = description;
    if (description.material.damping_by_default) {
        hooks.report_stage(
            fmt::format("damping ratio {:.4g} by default: a particle that vibrates on its contacts loses 95 % of its "
                        "energy per period",
                        default_damping_ratio));
    }
    const Clock::time_point begun = Clock::now();
    made.specimen = make_specimen(description, hooks);
    test.specimen_seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    if (description.mesh && std::holds_alternative<parts::DerivedGap>(description.mesh->gap))
        test.description.mesh->gap = parts::MeshGap{made.specimen.mesh_thick, {}};
    hooks.report_work("bonding");
    if (hooks.interrupted)
        made.while_solving = [asked = hooks.interrupted] {
            if (asked()) throw TestInterrupted();
        };
    BondedSpecimen bonded = bond_specimen(made.specimen, description.bond, description, made.while_solving);
    test.world = std::move(bonded.world);
    test.world.bonds.watch_slips = description.output.slips;
    made.platens = std::move(bonded.platens);
    return made;
}

VirtualTest bond_test(const ResolvedCase& description, const TestHooks& hooks, const SolutionVisitor& visit) {
    BondedTest made = make_and_bond(description, hooks);
    compute_forces(made.test.world);
    return measure_and_confine(std::move(made), description, hooks, visit);
}

VirtualTest prepare_test(const ResolvedCase& description, const TestHooks& hooks, const SolutionVisitor& visit) {
    BondedTest bonded = make_and_bond(description, hooks);
    compute_forces(bonded.test.world);
    return prepare_test(std::move(bonded), description, hooks, visit);
}

VirtualTest prepare_test(BondedTest bonded, const ResolvedCase& description, const TestHooks& hooks,
                         const SolutionVisitor& visit) {
    VirtualTest test = measure_and_confine(std::move(bonded), description, hooks, visit);
    if (const double* tolerance = description.loading.rate_tolerance()) {
        start_by_tolerance(test);
        hooks.report_stage(
            fmt::format("loading with rate_tolerance = {}: initial rate {:.3g} 1/s, wave transit time {:.3g} s",
                        *tolerance, test.state.rate.rate, test.setup.rate_rule.transit_time));
        // Called only as a check: it throws if the lateral strain cannot control the loading.
        lateral_rule_of(description.loading, description.places, test.setup.rate_rule, test.state.poissons_ratio);
    } else {
        if (!test.setup.apparatus.uniaxial) start_by_rate(test);
        notice_fast_loading(test);
    }
    for (const std::string& notice : test.setup.origin.notices) hooks.report_stage("notice: " + notice);
    test.world.workers
        .while_solving = {};  // the loading loop polls for interrupts itself, because it has results to keep
    return test;
}

Moduli moduli_of(const VirtualTest& test) {
    return test.small_strain ? test.small_strain->moduli : solve_moduli(test.world, test.setup);
}

}  // namespace crackle
