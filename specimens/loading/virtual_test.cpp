// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a specimen for its test and runs it with its files; the loading loop itself is in load_specimen.cpp.

#include "specimens/loading/virtual_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/time_step.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/loading/companions.hpp"
#include "specimens/loading/quasi_static_start.hpp"
#include "specimens/results/checkpoint.hpp"
#include "specimens/results/files.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/sha256.hpp"
#include "specimens/setup/platen_hold.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace nlohmann::literals;

// Circles bond at the overlaps they have whatever the thickness; this one keeps platens thin beside the particles.
constexpr double circle_thick_share = 0.1;  // of the mean radius

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void say(const TestHooks& hooks, const std::string& line) {
    if (hooks.stage) hooks.stage(line);
}

void tell_work(const TestHooks& hooks, const char* what) {
    if (hooks.working) hooks.working(what);
}

/// What was bonded, and where the step comes from.
void tell_bonded(const TestHooks& hooks, const World& world, const TestSetup& setup, const TestCase& test) {
    if (!hooks.detail) return;
    hooks.detail(fmt::format("{} bodies, {} segments; {} contact points touch, {} of them bonded; {} threads",
                             world.bodies.size(), setup.segments, setup.contacts_initial, world.bonds.initial,
                             world.workers.threads));
    hooks.detail(fmt::format(
        "time step {:.4g} s, {}; exact stable step {:.4g} s{}, guaranteed bound {:.4g} s", world.stepping.time_step,
        test.numerics.time_step ? std::string("given by the case")
                                : fmt::format("{:.3g} of the bound, followed as contacts open and close",
                                              world.stepping.time_step / world.stepping.step_bound),
        setup.stable_time_step, setup.stable_time_step_proved ? "" : " (a bound itself)", setup.time_step_bound));
}

std::string read_bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InputError(fmt::format("{}: cannot be read, expected a file; check the path", path.string()));
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Bonded {
    World world;
    Platens platens;
};

/// The case's step, known to be stable only now that there are bonds.
void take_given_step(World& world, const TestCase& test) {
    if (!test.numerics.time_step) return;
    try {
        set_time_step(world, *test.numerics.time_step);
    } catch (const UnstableRun&) {
        throw InputError(fmt::format(
            "{}: found {} s, expected at most the exact stable step of this specimen, {:.6g} s; give a smaller one, "
            "leave it out to have it derived, or run with --allow-unstable to see the limit",
            test.at("numerics.time_step"), *test.numerics.time_step, world.stepping.exact_step));
    }
}

/// Platens added, world built, bonds made, platens in place.
Bonded bond_specimen(const Specimen& specimen, const TestCase& test, const TestCase::Loading& loading) {
    Scene scene = specimen.scene;
    scene.thick = test.bond.thick ? *test.bond.thick : circle_thick_share * specimen.mean_radius;
    scene.segment_law = segment_law_named("numerics.contact_law", test.numerics.contact_law);
    scene.integrator = integrator_named("numerics.integrator", test.numerics.integrator);
    scene.time_step = 0.0;  // a particle file's own is of its packing
    scene.safety_factor = test.numerics.safety_factor;
    scene.step_scale = test.step_scale;
    scene.allow_unstable = test.numerics.allow_unstable;
    scene.first_kick = FirstKick::half;
    scene.threads = static_cast<int>(test.numerics.threads);
    scene.intact = {test.numerics.intact, test.numerics.intact, test.numerics.intact};
    Bonded bonded;
    bonded.platens = add_platens(scene, specimen, loading, scene.thick);
    const double thick = scene.thick;
    bonded.world = build_world(std::move(scene));
    forget_point_forces(bonded.world);  // platens tell the stress, the curve's rows the springs
    bond_all(bonded.world, thick);
    take_given_step(bonded.world, test);
    place_platens(bonded.world, bonded.platens);
    compute_forces(bonded.world);
    return bonded;
}

// Loading by tolerance counts from where this share of the bonded points has given way by the linear solution, which is
// 0.1 to 1.3 of the strain at peak of the guide's six tests; single slivers give way at a thousandth of it.
constexpr double first_yield_share = 0.02;

// Solving 50,000 cells takes 27 s and 3 GB, and both grow faster than the number of bodies: more are solved on demand.
constexpr std::size_t most_bodies_solved = 200'000;

/// Linear solution of a world with bonded platens, or a notice why there is none.
void take_small_strain(VirtualTest& test, const World& world, const TestSetup& own) {
    if (world.bodies.size() > most_bodies_solved) {
        test.setup.notices.push_back(fmt::format(
            "no small-strain modulus: {} bodies, more than {} are not solved beside a test; `crackle elastic` does it",
            world.bodies.size(), most_bodies_solved));
        return;
    }
    try {
        SmallStrain solved{solve_moduli(world, own), 0.0};
        solved.yield_strain = yield_strain(world, own, solved.moduli, first_yield_share);
        test.state.youngs_modulus = solved.moduli.youngs_modulus;
        test.state.poissons_ratio = solved.moduli.poissons_ratio;
        test.state.modulus_residual = solved.moduli.solution.residual;
        test.small_strain = std::move(solved);
    } catch (const InputError& error) {
        test.setup.notices.push_back(fmt::format("no small-strain modulus: {}", error.what()));
    }
}

/// Bonds as deep as this share of a particle's size reach beyond the faces that lie against each other.
constexpr double deep_bond_share = 0.1;

void notice_deep_bonds(VirtualTest& test) {
    const TestSetup& setup = test.setup;
    if (!setup.polygons) return;
    const double size = std::sqrt(setup.width * setup.height / static_cast<double>(setup.particles));
    const double excess = setup.bond_thick - setup.mesh_thick;
    if (excess <= deep_bond_share * size) return;
    test.setup.notices.push_back(fmt::format(
        "bond.thick = {:.4g} m exceeds the gap of {:.4g} m by {:.2g} of the mean particle size: polygons that share no "
        "face bond too; the excess is the overlap that bonds them, and wants to be small",
        setup.bond_thick, setup.mesh_thick, excess / size));
}

// Times the rate that loading by this tolerance would begin with.
constexpr double noticed_tolerance = 0.01, noticed_rate = 3.0;

void notice_fast_loading(VirtualTest& test) {
    if (!test.small_strain || !(test.small_strain->moduli.youngs_modulus > 0.0)) return;
    const double derived = largest_rate(rate_rule_of(test, noticed_tolerance));
    const double given = *test.description.loading.axial_strain_rate;
    if (given <= noticed_rate * derived) return;
    test.setup.notices.push_back(
        fmt::format("{} = {:.3g} 1/s is {:.2g} times the rate that rate_tolerance = {} would begin with: inertia and "
                    "dashpots bear part of the stress; leave the rate out, or see with --verify what it changes",
                    test.description.at("loading.axial_strain_rate"), given, given / derived, noticed_tolerance));
}

std::string resolved_case(const TestCase& test, const fs::path& folder) {
    std::ostringstream text;
    text << resolved_case_mark << CRACKLE_VERSION << ": every value in the open. Its inputs, with their SHA-256:\n";
    for (const fs::path& input : test.inputs) {
        text << "#   " << sha256(read_bytes(input)) << "  " << input.filename().string() << '\n';
    }
    write_resolved_case(text, test, folder);
    return text.str();
}

TestTiming timing_of(const VirtualTest& test, const TestOptions& options) {
    return {test.state.wall_seconds + seconds_since(options.process_start), test.state.step_seconds,
            test.world.workers.threads};
}

/// Loads with files open, and closes the account whatever the end.
TestOutcome run_with_files(VirtualTest& test, const TestOptions& options, const TestHooks& hooks, OutputFolder& folder,
                           TestFiles& files) {
    TestOutcome outcome;
    std::optional<NumericalErrors> errors;
    const auto write_summary = [&] {
        outcome.summary = make_summary(test.description, test.setup, test.state, test.world, timing_of(test, options),
                                       errors ? &*errors : nullptr);
        files.write_summary(outcome.summary, test.state);
    };
    const auto write_peak = [&] {
        if (test.state.peak_frame.row >= 0) files.add_frame(test.state.peak_frame, test.setup, test.state, test.world);
    };
    try {
        load_specimen(test, hooks, &files);
    } catch (const UnstableRun& error) {
        test.state.ended_by = ended_by_instability;
        test.setup.notices.push_back(error.what());
        files.flush();
        write_peak();
        write_summary();
        throw UnstableRun(error, fmt::format("output so far in {}{}", folder.path().string(),
                                             folder.staged() ? "; earlier results are as they were" : ""));
    }
    outcome.interrupted = test.state.ended_by.empty();
    if (outcome.interrupted) {
        // The checkpoint knows neither this end nor the picture of the peak so far: a resumed test may pass a higher
        // one.
        TestState kept = test.state;
        kept.wall_seconds += seconds_since(options.process_start);
        files.write_checkpoint(test.setup, kept, test.world);
        test.state.ended_by = ended_by_interrupt;
        write_peak();
        write_summary();
    } else {
        write_peak();
        TestState kept = test.state;
        kept.wall_seconds = kept.step_seconds =
            0.0;  // nothing is left to add them to: the same run gives the same bytes
        files.write_checkpoint(test.setup, kept, test.world);
        write_summary();  // complete before the companions begin, whatever becomes of them
        if (options.verify) {
            errors = run_companions(test, hooks);
            outcome.unverified = !errors && test.state.failure.peak_row >= 0;
            write_summary();
        }
        folder.finish();
    }
    outcome.folder = folder.path();
    return outcome;
}

/// A test that has nothing left to be loaded: verified now, if that is asked and has not been done.
TestOutcome finished_test(VirtualTest& test, const TestOptions& options, const TestHooks& hooks,
                          const OutputFolder& folder) {
    TestOutcome outcome;
    outcome.folder = folder.path();
    const fs::path name = folder.path() / "summary.json";
    // Without one the process was stopped in between: what only the clock knew is lost.
    std::error_code error;
    const bool exists = fs::is_regular_file(name, error);
    if (exists) outcome.summary = nlohmann::ordered_json::parse(read_bytes(name), nullptr, false);
    const auto& old = outcome.summary;
    const bool readable = exists && old.is_object() && old.value("ended_by", "") == test.state.ended_by;
    const bool verified = readable && old.contains("/numerical_errors/companions"_json_pointer);
    outcome.was_finished = readable && (verified || !options.verify);
    if (outcome.was_finished) return outcome;
    TestTiming timing{0.0, 0.0, test.world.workers.threads};
    if (readable) timing = {old.value("wall_seconds", 0.0), old.value("step_seconds", 0.0), old.value("threads", 1)};
    std::optional<NumericalErrors> errors;
    const auto write_summary = [&] {
        outcome.summary =
            make_summary(test.description, test.setup, test.state, test.world, timing, errors ? &*errors : nullptr);
        folder.write("summary.json", outcome.summary.dump(2) + '\n');
    };
    write_summary();
    if (options.verify) {
        errors = run_companions(test, hooks);
        outcome.unverified = !errors && test.state.failure.peak_row >= 0;
        write_summary();
    }
    return outcome;
}

}  // namespace

VirtualTest bond_test(const TestCase& description, const TestHooks& hooks) {
    VirtualTest test;
    test.description = description;
    const TestCase::MaterialKeys& material = description.material;
    if (description.has_table("packing") && !material.damping_ratio && !material.normal_damping) {
        say(hooks, fmt::format("damping ratio {:.4g} by default: a particle ringing on its contacts loses 95 % of its "
                               "energy a period",
                               default_damping_ratio));
    }
    const Clock::time_point begun = Clock::now();
    const Specimen specimen = make_specimen(description, hooks);
    test.specimen_seconds = seconds_since(begun);
    tell_work(hooks, "bonding");
    Bonded bonded = bond_specimen(specimen, description, description.loading);
    test.world = std::move(bonded.world);
    test.setup = record_setup(test.world, specimen, bonded.platens, description.loading.kind == "compression");
    if (!description.output.frames)
        test.description.output.frames = default_frames(test.setup.particles, description.output.curve_rows);
    test.state.failure.share_of_peak = description.loading.stop_at_share_of_peak;
    say(hooks, fmt::format("bonded {} points of {} interfaces, time step {:.3g} s", test.world.bonds.initial,
                           test.world.bonds.interfaces_initial, test.world.stepping.time_step));
    tell_bonded(hooks, test.world, test.setup, description);
    tell_work(hooks, "solving for small strain");
    notice_deep_bonds(test);
    if (bonded.platens.bonded) {
        check_platen_hold(test.world, test.setup, bonded.platens, description);
        take_small_strain(test, test.world, test.setup);
    } else {
        TestCase::Loading held = description.loading;
        held.platens = "bonded";
        const Bonded twin = bond_specimen(specimen, description, held);
        try {
            const TestSetup own = record_setup(twin.world, specimen, twin.platens, test.setup.compression);
            check_platen_hold(twin.world, own, twin.platens, description);
            take_small_strain(test, twin.world, own);
        } catch (const InputError& error) {
            test.setup.notices.push_back(fmt::format("no small-strain modulus: {}", error.what()));
        }
    }
    if (std::isfinite(test.state.youngs_modulus)) {
        say(hooks, fmt::format("small strain: E = {:.4g} N/m, nu = {:.3g}", test.state.youngs_modulus,
                               test.state.poissons_ratio));
    }
    return test;
}

VirtualTest prepare_test(const TestCase& description, const TestHooks& hooks) {
    VirtualTest test = bond_test(description, hooks);
    if (description.loading.rate_tolerance) {
        start_by_tolerance(test);
        say(hooks,
            fmt::format("loading by tolerance {}: first rate {:.3g} 1/s, a wave's transit {:.3g} s",
                        *description.loading.rate_tolerance, test.state.rate.rate, test.setup.rate_rule.transit_time));
    } else {
        notice_fast_loading(test);
    }
    for (const std::string& notice : test.setup.notices) say(hooks, "notice: " + notice);
    return test;
}

TestOutcome run_test(const TestCase& description, const TestOptions& options, const TestHooks& hooks) {
    TestCase recorded = description;
    if (description.particles.file)
        recorded.inputs.push_back(description.resolve_path("particles.file", *description.particles.file));
    if (description.packing.sieve)
        recorded.inputs.push_back(description.resolve_path("packing.sieve", *description.packing.sieve));
    OutputFolder folder = OutputFolder::create(options.folder, options.force, recorded.inputs);
    VirtualTest test = prepare_test(description, hooks);
    if (options.threads > 0) set_threads(test.world, options.threads);
    Profile profile;
    if (options.profile) test.world.workers.profile = &profile;
    test.state.command = options.command;
    recorded.output.frames = test.description.output.frames;  // known only now where the case is silent
    const std::string text = resolved_case(recorded, folder.target());
    TestFiles files(folder, sha256(text),
                    test.state);  // empty until loading: by that a test that has only begun is known
    folder.write("case.toml", text);
    return run_with_files(test, options, hooks, folder, files);
}

TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks) {
    OutputFolder folder = OutputFolder::reopen(options.folder);
    const fs::path checkpoint_path = folder.path() / "checkpoint";
    std::error_code error;
    if (!fs::is_regular_file(checkpoint_path, error)) {
        throw InputError(fmt::format("{}: found no checkpoint, {}", checkpoint_path.string(),
                                     holds_test_results(folder.path())
                                         ? "expected one to resume from; run the test again with --force"
                                         : "for the test was stopped before its loading began; nothing is lost, run "
                                           "the test again"));
    }
    const fs::path case_path = folder.path() / "case.toml";
    VirtualTest test;
    test.description = read_case(case_path);
    TestCheckpoint checkpoint = load_test(read_bytes(checkpoint_path), checkpoint_path.string());
    if (checkpoint.case_hash != sha256(read_bytes(case_path))) {
        throw InputError(fmt::format(
            "{}: found another case than the one the checkpoint belongs to, expected it unchanged; restore it, "
            "or run the test again with --force",
            case_path.string()));
    }
    test.setup = std::move(checkpoint.setup);
    test.state = std::move(checkpoint.state);
    test.world = std::move(checkpoint.world);
    set_threads(test.world,
                options.threads > 0 ? options.threads : static_cast<int>(test.description.numerics.threads));
    if (!test.state.ended_by.empty()) return finished_test(test, options, hooks, folder);
    // That of the interrupt: curve and frames go beyond it from here.
    fs::remove(folder.path() / "summary.json", error);
    TestFiles files(folder, checkpoint.case_hash, test.state);
    say(hooks, fmt::format("resumed at step {}, axial strain {:.4g}", test.world.stepping.steps,
                           test.setup.axial_strain(test.world)));
    return run_with_files(test, options, hooks, folder, files);
}

}  // namespace crackle
