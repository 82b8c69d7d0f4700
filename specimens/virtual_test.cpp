// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a specimen for its test and runs it with its files; the loading loop itself is in load_specimen.cpp.

#include "specimens/virtual_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "solver/controls.hpp"
#include "solver/errors.hpp"
#include "specimens/checkpointing/test_checkpoint.hpp"
#include "specimens/companions.hpp"
#include "specimens/elastic_analysis.hpp"
#include "specimens/moduli.hpp"
#include "specimens/observers/test_files.hpp"
#include "specimens/output_folder.hpp"
#include "specimens/platen_hold.hpp"
#include "specimens/sha256.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Circles bond at the overlaps they have whatever the thickness; this one keeps platens thin beside the particles.
constexpr double circle_thick_share = 0.1;  // of the mean radius

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void say(const TestHooks& hooks, const std::string& line) {
    if (hooks.stage) hooks.stage(line);
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
            test.at("numerics.time_step"), *test.numerics.time_step, world.exact_step));
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
    scene.allow_unstable = test.numerics.allow_unstable;
    scene.first_kick = FirstKick::half;
    scene.threads = static_cast<int>(test.numerics.threads);
    scene.intact = {test.numerics.intact, test.numerics.intact, test.numerics.intact};
    Bonded bonded;
    bonded.platens = add_platens(scene, specimen, loading, scene.thick);
    const double thick = scene.thick;
    bonded.world = build_world(std::move(scene));
    bond_all(bonded.world, thick);
    take_given_step(bonded.world, test);
    place_platens(bonded.world, bonded.platens);
    compute_forces(bonded.world);
    return bonded;
}

// Loading by tolerance counts from where this share of the bonded points has given way by the linear solution, which is
// 0.1 to 1.3 of the strain at peak of the guide's six tests; single slivers give way at a thousandth of it.
constexpr double first_yield_share = 0.02;

struct SmallStrain {
    Moduli moduli;
    double yield_strain;  ///< axial, where the first points have given way
};

/// Small-strain solution of a world with bonded platens, or a notice why there is none.
std::optional<SmallStrain> take_moduli(TestState& state, TestSetup& setup, const World& world, const TestSetup& own) {
    try {
        SmallStrain solved{solve_moduli(world, own), 0.0};
        solved.yield_strain = yield_strain(world, own, solved.moduli, first_yield_share);
        state.youngs_modulus = solved.moduli.youngs_modulus;
        state.poissons_ratio = solved.moduli.poissons_ratio;
        state.modulus_residual = solved.moduli.solution.residual;
        return solved;
    } catch (const InputError& error) {
        setup.notices.push_back(fmt::format("no small-strain modulus: {}", error.what()));
        return std::nullopt;
    }
}

/// Sets the specimen moving as its elastic solution does at the first rate of loading by tolerance; what carries no
/// load, and everything where the platens are not bonded, moves in proportion to its height.
/// @throws InputError where there is no elastic solution to take the rate from
void start_by_tolerance(VirtualTest& test, const std::optional<SmallStrain>& solved) {
    if (!solved || !(solved->moduli.youngs_modulus > 0.0)) {
        throw InputError(
            fmt::format("{}: found a specimen without elastic solution, expected one to derive the rate "
                        "from; write axial_strain_rate in its place",
                        test.description.at("loading.rate_tolerance")));
    }
    World& world = test.world;
    TestSetup& setup = test.setup;
    const bool bonded = test.description.loading.platens == "bonded";
    const double sense = setup.compression ? -1.0 : 1.0;
    const double bottom = world.bodies[setup.bottom].y, height = world.bodies[setup.top].y - bottom;
    std::vector<bool> elastic(world.bodies.size(), bonded);
    if (bonded) {
        for (const BodyIndex b : find_free_motions(world, {setup.bottom, setup.top}).bodies) elastic[b] = false;
    }
    double mass = 0.0;
    RateRule& rule = setup.rate_rule;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        BodyState& body = world.bodies[b];
        Motion way{0.0, setup.height * (body.y - bottom) / height, 0.0};  // for a strain of 1 in tension
        if (elastic[b]) way = solved->moduli.solution.displacement[b];
        if (b == setup.bottom) way = {};
        if (b == setup.top) way = {0.0, setup.height, 0.0};
        body.vx = sense * way.x;
        body.vy = sense * way.y;
        body.omega = sense * way.rotation;
        rule.kinetic_per_rate += 0.5 * (world.inertia[b].mass * (way.x * way.x + way.y * way.y) +
                                        world.info[b].moment * way.rotation * way.rotation);
        if (!setup.is_platen(static_cast<BodyIndex>(b))) mass += world.inertia[b].mass;
    }
    const double modulus = solved->moduli.youngs_modulus, area = setup.width * setup.height;
    rule.tolerance = *test.description.loading.rate_tolerance;
    rule.transit_time = setup.height / std::sqrt(modulus / (mass / area));
    rule.first_strain = std::min(solved->yield_strain, test.description.loading.max_axial_strain);
    rule.stress_floor = modulus * rule.first_strain;
    rule.energy_floor = 0.5 * rule.stress_floor * rule.first_strain * area;
    RateState& rate = test.state.rate;
    rate.rate = rate.slowest = rate.fastest = largest_rate(rule);
    for (BodyState& body : world.bodies) {
        body.vx *= rate.rate;
        body.vy *= rate.rate;
        body.omega *= rate.rate;
    }
    change_velocity(world, setup.top, 1, sense * rate.rate * setup.height);
    world.initial_energy_taken = false;  // the account begins with this motion
    world.forces_current = false;
    compute_forces(world);
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
            test.world.threads};
}

/// Loads with files open, and closes the account whatever the end.
TestOutcome run_with_files(VirtualTest& test, const TestOptions& options, const TestHooks& hooks, OutputFolder& folder,
                           TestFiles& files) {
    TestOutcome outcome;
    std::optional<NumericalErrors> errors;
    const auto write_summary = [&] {
        outcome.summary = make_summary(test.description, test.setup, test.state, test.world, timing_of(test, options),
                                       errors ? &*errors : nullptr);
        files.write_summary(outcome.summary);
    };
    const auto write_peak = [&] {
        if (test.state.peak_frame.row >= 0) files.add_frame(test.state.peak_frame, test.state);
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
        if (options.verify) errors = run_companions(test, hooks);
        write_summary();
        folder.finish();
    }
    outcome.folder = folder.path();
    return outcome;
}

}  // namespace

VirtualTest prepare_test(const TestCase& description, const TestHooks& hooks) {
    VirtualTest test;
    test.description = description;
    const TestCase::MaterialKeys& material = description.material;
    if (description.has_table("packing") && !material.damping_ratio && !material.normal_damping) {
        say(hooks, fmt::format("damping ratio {:.4g} by default: a particle ringing on its contacts loses 95 % of its "
                               "energy a period",
                               default_damping_ratio));
    }
    const Specimen specimen = make_specimen(description, hooks);
    Bonded bonded = bond_specimen(specimen, description, description.loading);
    test.world = std::move(bonded.world);
    test.setup = record_setup(test.world, specimen, bonded.platens, description.loading.kind == "compression");
    test.state.failure.share_of_peak = description.loading.stop_at_share_of_peak;
    say(hooks, fmt::format("bonded {} points of {} interfaces, time step {:.3g} s", test.world.bonds_initial,
                           test.world.interfaces_initial, test.world.time_step));
    std::optional<SmallStrain> solved;
    if (bonded.platens.bonded) {
        check_platen_hold(test.world, test.setup, bonded.platens, description);
        solved = take_moduli(test.state, test.setup, test.world, test.setup);
    } else {
        TestCase::Loading held = description.loading;
        held.platens = "bonded";
        const Bonded twin = bond_specimen(specimen, description, held);
        try {
            const TestSetup own = record_setup(twin.world, specimen, twin.platens, test.setup.compression);
            check_platen_hold(twin.world, own, twin.platens, description);
            solved = take_moduli(test.state, test.setup, twin.world, own);
        } catch (const InputError& error) {
            test.setup.notices.push_back(fmt::format("no small-strain modulus: {}", error.what()));
        }
    }
    if (std::isfinite(test.state.youngs_modulus)) {
        say(hooks, fmt::format("small strain: E = {:.4g} N/m, nu = {:.3g}", test.state.youngs_modulus,
                               test.state.poissons_ratio));
    }
    if (description.loading.rate_tolerance) {
        start_by_tolerance(test, solved);
        say(hooks,
            fmt::format("loading by tolerance {}: first rate {:.3g} 1/s, a wave's transit {:.3g} s",
                        *description.loading.rate_tolerance, test.state.rate.rate, test.setup.rate_rule.transit_time));
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
    test.state.command = options.command;
    const std::string text = resolved_case(recorded, folder.target());
    folder.write("case.toml", text);
    TestFiles files(folder, sha256(text), test.state);
    return run_with_files(test, options, hooks, folder, files);
}

TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks) {
    OutputFolder folder = OutputFolder::reopen(options.folder);
    const fs::path checkpoint_path = folder.path() / "checkpoint";
    std::error_code error;
    if (!fs::is_regular_file(checkpoint_path, error)) {
        throw InputError(
            fmt::format("{}: found no checkpoint, expected one to resume from; run the test again with --force",
                        checkpoint_path.string()));
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
    if (!test.state.ended_by.empty()) {
        TestOutcome outcome;
        outcome.summary = nlohmann::ordered_json::parse(read_bytes(folder.path() / "summary.json"), nullptr, false);
        outcome.folder = folder.path();
        outcome.was_finished = true;
        return outcome;
    }
    TestFiles files(folder, checkpoint.case_hash, test.state);
    say(hooks,
        fmt::format("resumed at step {}, axial strain {:.4g}", test.world.step, test.setup.axial_strain(test.world)));
    return run_with_files(test, options, hooks, folder, files);
}

}  // namespace crackle
