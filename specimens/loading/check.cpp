// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/check.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/errors.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

// Duration of the speed measurement: another program cannot halve the result, and making the specimen takes longer.
constexpr double seconds_of_steps = 0.5;
constexpr int steps_at_once = 64;

constexpr double fewest_grains_across = 20.0;
constexpr double fewest_steps = 10.0;  // with fewer steps, the test would overshoot max_axial_strain
// Warning thresholds at the estimated strength: mean bond overlap relative to the bond thickness, and displacement of a
// corner relative to its distance from a platen. They allow for errors of the estimate.
constexpr double deep_overlap_share = 0.5, noticed_closing_share = 0.5;

/// Measures the speed of stepping. @param notices  receives a notice if stepping is unstable
double steps_per_second(World& world, std::vector<std::string>& notices) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begun = Clock::now();
    std::int64_t steps = 0;
    double seconds = 0.0;
    const auto look_at_clock = [&] { seconds = std::chrono::duration<double>(Clock::now() - begun).count(); };
    try {
        while (seconds < seconds_of_steps) {
            for (int k = 0; k < steps_at_once; ++k, ++steps) step(world);
            look_at_clock();
        }
    } catch (const UnstableRun& error) {
        notices.push_back(fmt::format("while the speed of stepping was measured, {}", error.what()));
        look_at_clock();
    }
    return static_cast<double>(steps) / seconds;
}

/// Calls `judge` and returns the error message if it throws InputError, for use as a warning.
std::optional<std::string> refusal_of(auto&& judge) {
    try {
        judge();
    } catch (const InputError& error) {
        return error.what();
    }
    return std::nullopt;
}

double largest_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::optional<FirstLoss> loss_of(const ElasticAnalysis& analysis, const std::optional<FirstEvent>& event) {
    if (!event) return std::nullopt;
    const LinearBond& bond = analysis.bonds[event->bond];
    return FirstLoss{event->strain, event->stress, bond.body_i, bond.body_j};
}

void estimate_strength(TestCheck& check, const ElasticAnalysis& analysis, const ResolvedCase& test,
                       const TestSetup& own) {
    // Estimates apply only to unconfined uniaxial specimens.
    if (test.numerics.intact || test.confined() || !test.uniaxial()) return;
    const BreakShare rule = bond_break_share(own);
    const double strain = strain_of_share(analysis.bonds, rule.share);
    if (!std::isfinite(strain)) return;
    check.strength = {analysis.youngs_modulus * strain, strain, rule.share, rule.factor};
}

/// Finds the corner that comes closest to passing through a platen at the estimated strength.
void find_deepest_corner(TestCheck& check, const ElasticAnalysis& analysis, const TestSetup& own) {
    if (!own.apparatus.compression || !own.specimen.polygons || !check.strength) return;
    double deepest = 0.0;
    for (const LinearBond& bond : analysis.bonds) {
        const auto is_platen = [&](int id) { return id == own.apparatus.bottom_id || id == own.apparatus.top_id; };
        if (!is_platen(bond.body_i) && !is_platen(bond.body_j)) continue;
        const double closing = bond.closing / analysis.strain * check.strength->strain;
        const double distance = own.bonds.thick - bond.overlap;
        if (!(closing / distance > deepest)) continue;
        deepest = closing / distance;
        check.corner_closing = closing;
        check.corner_distance = distance;
    }
}

/// Mean friction angle over the bonded points and the intact faces that can break, degrees. For bonds that break in
/// shear it is that of the failure envelope (of faces below the knee), otherwise that of the contacts.
double bond_friction_angle(const World& world) {
    double sum = 0.0, count = 0.0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        const ContactLaw& law = world.settings.laws[world.points.state[k].law];
        sum += std::atan(law.*facts_of(world.settings.bond_law).friction);
        count += 1.0;
    }
    for (FaceIndex k = 0; k < world.faces.size(); ++k) {
        const FaceLaw& law = world.faces.law_of(k);
        if (world.faces.broken_at[k] != no_face || std::isinf(law.cohesion)) continue;
        sum += std::atan(law.friction);
        count += 1.0;
    }
    return sum / std::max(count, 1.0) * 180.0 / std::numbers::pi;
}

/// Estimates the compressive and tensile strength of a disc's rock from one linear solution of the whole packing
/// between platens.
std::optional<DiscOutlook> outlook_of(const ResolvedCase& disc, const TestHooks& hooks) {
    ResolvedCase rock = disc;
    rock.loading.kind = LoadingKind::compression;
    rock.loading.platens = PlatenKind::bonded;
    rock.shape = {};
    DiscOutlook outlook;
    double strains[2] = {0.0, 0.0}, squares = 0.0;
    const auto look = [&](const World& world, const TestSetup& squeezed, const Moduli& moduli) {
        outlook.friction_angle = bond_friction_angle(world);
        for (const bool compression : {true, false}) {
            TestSetup setup = squeezed;
            setup.apparatus.compression = compression;
            const BreakShare rule = bond_break_share(setup);
            strains[compression ? 0 : 1] =
                strain_of_share(analyse_elastic(world, setup, moduli, 1.0, 0).bonds, rule.share);
            squares += std::pow(std::log(rule.factor), 2.0);  // the errors are independent
        }
    };
    TestHooks quietly;
    quietly.interrupted = hooks.interrupted;
    quietly.working = hooks.working;
    try {
        bond_test(rock, quietly, look);
    } catch (const InputError&) {  // platens may fail to hold the whole packing, whereas jaws hold the disc
        return std::nullopt;
    }
    outlook.strength_ratio = strains[0] / strains[1];
    if (!std::isfinite(outlook.strength_ratio) || outlook.strength_ratio <= 0.0) return std::nullopt;
    outlook.factor = std::exp(std::sqrt(squares));
    const double sine = std::sin(outlook.friction_angle * std::numbers::pi / 180.0);
    outlook.needed = 3.0 + (1.0 + sine) / (1.0 - sine);
    return outlook;
}

void estimate_run(TestCheck& check) {
    const VirtualTest& test = check.test;
    const parts::Loading& loading = test.description.loading;
    const double* given = loading.axial_strain_rate();
    check.rate = given != nullptr ? *given : test.state.rate.rate;
    check.slowest_rate = given != nullptr ? check.rate : slowest_rate(test.setup.rate_rule);
    check.to_end = expected_run(test, loading.max_axial_strain, check.steps_per_second);
    if (check.strength && check.strength->strain < loading.max_axial_strain)
        check.to_strength = expected_run(test, check.strength->strain, check.steps_per_second);
}

constexpr double largest_strain_of_a_rock = 0.1;

void warn_of_disc(TestCheck& check) {
    if (!check.disc || check.disc->can_be_valid() == true) return;
    const DiscOutlook& disc = *check.disc;
    check.warnings.push_back(
        fmt::format("a Brazilian test of this rock {} valid: its strength is about {:.2g} times its tensile strength, "
                    "within a factor of {:.2g}; a disc splits at its centre before it is crushed only if this ratio is "
                    "at least 3 + N = {:.3g} (friction angle {:.3g} degrees); {}",
                    disc.can_be_valid() ? "cannot be" : "may not be", disc.strength_ratio, disc.factor, disc.needed,
                    disc.friction_angle,
                    disc.can_be_valid() ? "its peak is not a tensile strength; measure it with kind = \"tension\""
                                        : "check `validity` in the summary after the test"));
}

/// Whether strengths are out of proportion to the stiffness. Other excessive values are then consequences, and are not
/// reported.
bool out_of_proportion(const TestCheck& check) {
    return check.strength && check.test.setup.bonds.facts().strengths_are_given &&
           check.strength->strain > largest_strain_of_a_rock;
}

void warn_of_strength(TestCheck& check) {
    const ResolvedCase& test = check.test.description;
    if (out_of_proportion(check)) {
        check.warnings.push_back(fmt::format(
            "the estimated strength would be reached at a strain of {:.2g}, far beyond the failure strain of any rock: "
            "strengths are {}",
            check.strength->strain,
            test.area_units() ? "in Pa, and so is contact_modulus; check their orders of magnitude"
                              : "in N per contact point here; to give them in Pa, set units = \"area\" with "
                                "contact_modulus and stiffness_ratio"));
    } else if (check.strength && check.strength->strain > test.loading.max_axial_strain) {
        check.warnings.push_back(fmt::format(
            "{} = {:.3g} is less than the strain of the estimated strength, {:.3g}: the test may end before "
            "the specimen fails",
            test.at(CaseKey::loading_max_axial_strain), test.loading.max_axial_strain, check.strength->strain));
    }
}

void warn(TestCheck& check) {
    const TestSetup& setup = check.test.setup;
    const ResolvedCase& test = check.test.description;
    check.warnings = setup.origin.notices;
    warn_of_disc(check);
    if (test.confined()) {
        check.warnings.emplace_back(
            "the first slip and the first break are estimated without the confining pressure, and the strength of "
            "confined tests is not estimated");
    }
    if (setup.specimen.polygons && setup.bonds.mean_overlap > deep_overlap_share * setup.bonds.thick) {
        check.warnings.push_back(
            fmt::format("bonds overlap by {:.3g} m on average, which is {:.2g} of bond.thick = {:.3g} m: corners lie "
                        "close to their neighbours' faces, and a small load may push them through; increase "
                        "mesh.thick, or reduce the difference between bond.thick and mesh.thick",
                        setup.bonds.mean_overlap, setup.bonds.mean_overlap / setup.bonds.thick, setup.bonds.thick));
    }
    if (!out_of_proportion(check) && check.corner_distance > 0.0 &&
        check.corner_closing > noticed_closing_share * check.corner_distance) {
        check.warnings.push_back(fmt::format(
            "at the estimated strength, a platen presses a corner in by {:.3g} m, {:.2g} of the distance from corner "
            "to platen face, {:.3g} m: corners may pass through the platen; increase mesh.thick or the stiffness",
            check.corner_closing, check.corner_closing / check.corner_distance, check.corner_distance));
    }
    if (check.grains_across < fewest_grains_across) {
        check.warnings.push_back(
            fmt::format("the specimen is {} grains wide, fewer than {:g}: strength and modulus depend on the packing "
                        "and the boundary; use more grains, or average over several seeds",
                        spoken_below(check.grains_across, fewest_grains_across), fewest_grains_across));
    }
    if (setup.specimen.polygons && setup.apparatus.uniaxial && !setup.apparatus.compression &&
        test.loading.platens == PlatenKind::bonded) {
        check.warnings.push_back(fmt::format(
            "{}: polygons pulled by bonded platens separate at the platen, so the strength is not the rock's; "
            "use platens = \"glued\"",
            test.at(CaseKey::loading_platens)));
    }
    if (check.to_end.steps < fewest_steps) {
        check.warnings.push_back(
            fmt::format("{} = {:g} is reached after only {:.2g} steps, so the test overshoots it; use a larger strain "
                        "or a lower rate",
                        test.at(CaseKey::loading_max_axial_strain), test.loading.max_axial_strain, check.to_end.steps));
    }
    warn_of_strength(check);
}

}  // namespace

std::optional<bool> DiscOutlook::can_be_valid() const {
    if (strength_ratio >= needed * factor) return true;
    if (strength_ratio * factor < needed) return false;
    return std::nullopt;
}

// Calibrated on the tests in specimens/loading/METHODS.md: specimens fail soon after their first breaks, except Voronoi
// polygons under compression. These interlock and carry load until a fifth of their bonds is broken. With back-tension,
// the overlaps of circles vary, and many weak bonds break early.
BreakShare bond_break_share(const TestSetup& setup) {
    const bool circles = setup.specimen.kind == SpecimenKind::circles,
               voronoi = setup.specimen.kind == SpecimenKind::voronoi;
    if (setup.bonds.facts().strengths_are_given)
        return setup.apparatus.compression && voronoi ? BreakShare{0.2, 2.0} : BreakShare{0.01, 1.9};
    if (!setup.apparatus.compression)
        return circles ? BreakShare{0.05, 1.5} : voronoi ? BreakShare{0.005, 1.3} : BreakShare{0.02, 1.3};
    return circles ? BreakShare{0.03, 1.5} : voronoi ? BreakShare{0.02, 1.5} : BreakShare{0.005, 2.0};
}

double strain_of_share(const std::vector<LinearBond>& bonds, double share) {
    std::vector<double> strains;
    for (const LinearBond& bond : bonds)
        if (std::isfinite(bond.strength)) strains.push_back(bond.break_strain);
    if (strains.empty()) return std::numeric_limits<double>::infinity();
    const auto nth = strains.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(strains.size()));
    std::nth_element(strains.begin(), nth, strains.end());
    return *nth;
}

TestCheck check_test(const ResolvedCase& description, const TestHooks& hooks) {
    TestCheck check;
    check.youngs_modulus = check.poissons_ratio = check.gauge_modulus = std::numeric_limits<double>::quiet_NaN();
    const auto look = [&](const World& world, const TestSetup& own, const Moduli& moduli) {
        constexpr double unit_strain = 1e-3;  // strain for which forces are computed; they are proportional to it
        const ElasticAnalysis analysis = analyse_elastic(world, own, moduli, unit_strain, 0);
        check.youngs_modulus = moduli.youngs_modulus;
        check.poissons_ratio = moduli.poissons_ratio;
        check.gauge_modulus = moduli.gauge_modulus;
        check.first_slip = loss_of(analysis, analysis.first_slip);
        check.first_break = loss_of(analysis, analysis.first_break);
        estimate_strength(check, analysis, description, own);
        find_deepest_corner(check, analysis, own);
    };
    check.test = prepare_test(description, hooks, look);
    if (test_kind(description.loading.kind).valid_failure == ValidFailure::splits_disc && !description.numerics.intact)
        check.disc = outlook_of(description, hooks);
    const auto rests = refusal_of([&] { refuse_resting(check.test); });  // checked before steps are timed
    const TestSetup& setup = check.test.setup;
    check.grains_across = setup.specimen.width / std::sqrt(setup.specimen.width * setup.specimen.height /
                                                           static_cast<double>(setup.specimen.particles));
    hooks.report_work("measuring the number of steps per second");
    check.steps_per_second = steps_per_second(check.test.world, check.test.setup.origin.notices);
    estimate_run(check);
    check.memory = largest_memory();
    warn(check);
    if (rests) check.warnings.push_back(*rests);
    if (const auto endless = refusal_of([&] { refuse_endless(check.test, check.to_end); }))
        check.warnings.push_back(*endless);
    return check;
}

}  // namespace crackle
