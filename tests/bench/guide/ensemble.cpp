// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/guide/ensemble.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <ctime>
#include <exception>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/measures/curve_analysis.hpp"
#include "specimens/results/sha256.hpp"
#include "tests/bench/guide/experiments.hpp"

namespace crackle::studies {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Stored in every cached result; increment it when other quantities are measured.
constexpr int measures_version = 2;

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time per simulated second, from the first steps of loading. The intact specimen's neighbour list is built
/// only once.
double cost_of_second(World& world) {
    constexpr int warm_up = 20, steps = 300;
    for (int k = 0; k < warm_up; ++k) step(world);
    const double before = thread_seconds();
    for (int k = 0; k < steps; ++k) step(world);
    return (thread_seconds() - before) / (steps * world.stepping.time_step);
}

/// Counts and back-tensions of a specimen without platens.
void take_counts(GuideResult& result, const ResolvedCase& description, const TestHooks& hooks) {
    const Specimen specimen = make_specimen(description, hooks);
    Scene scene = specimen.scene;
    // The thickness does not matter for circles, which bond at their existing overlaps.
    scene.thick = description.bond.thick.value_or(0.1 * specimen.mean_radius);
    scene.segment_law = description.numerics.contact_law;
    scene.time_step = 0.0;  // derived automatically; no step is taken
    scene.domain.wall_present = {false, false, false, false};
    const double thick = scene.thick;
    World world = build_world(std::move(scene));
    bond_all(world, thick);
    double tension = 0.0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        const PointView view = view_point(world, k);
        tension += view.normal_stiffness * view.bond_overlap;
    }
    auto& q = result.quantities;
    q["particles"] = static_cast<double>(specimen.scene.bodies.size());
    q["segments"] = static_cast<double>(specimen.segments);
    q["contacts"] = static_cast<double>(world.bonds.initial);
    q["interfaces"] = static_cast<double>(world.bonds.interfaces_initial);
    q["mean_back_tension"] = tension / static_cast<double>(world.bonds.initial);
    q["mean_back_tension_interface"] = tension / static_cast<double>(world.bonds.interfaces_initial);
}

void take_elastic(GuideResult& result, VirtualTest& test) {
    const ElasticAnalysis analysis = analyse_elastic(test.world, test.setup, moduli_of(test), 1e-4, 0);
    auto& q = result.quantities;
    q["particles"] = static_cast<double>(test.setup.specimen.particles);
    q["segments"] = static_cast<double>(test.setup.origin.segments);
    q["contacts"] = static_cast<double>(test.setup.bonds.contacts_initial);
    q["interfaces"] = static_cast<double>(test.world.bonds.interfaces_initial);
    q["mean_back_tension"] = test.setup.bonds.mean_back_tension;
    q["mean_back_tension_interface"] = test.setup.bonds.mean_back_tension_interface;
    q["youngs_modulus"] = analysis.youngs_modulus;
    q["poissons_ratio"] = analysis.poissons_ratio;
    if (analysis.first_break) q["first_break_stress"] = analysis.first_break->stress;
    if (analysis.first_slip) q["first_slip_stress"] = analysis.first_slip->stress;
    q["time_step"] = analysis.time_step;
    q["processor_seconds_per_second"] = cost_of_second(test.world);
}

void take_loaded(GuideResult& result, const VirtualTest& test, double seconds) {
    const FailureTracker& failure = test.state.failure;
    auto& q = result.quantities;
    // The guide's strengths are the largest stresses of a test, including those after a first peak.
    const std::int64_t largest = failure.largest_row;
    q["failed"] = failure.collapsed ? 1.0 : 0.0;
    q["largest_stress"] = failure.largest_stress;
    q["strain_at_largest_stress"] = failure.strain_at_largest;
    q["secant_modulus"] = failure.largest_stress / failure.strain_at_largest;
    q["initial_tangent_modulus"] = initial_tangent(test.state.rows, largest, test.setup.apparatus.compression).modulus;
    q["tangent_modulus_50"] = tangent_at_half_peak(test.state.rows, largest, test.setup.apparatus.compression).modulus;
    q["bonds_broken_share"] =
        static_cast<double>(test.world.bonds.broken) / static_cast<double>(test.world.bonds.initial);
    q["platen_out_of_balance"] = platen_out_of_balance(test.state.rows, largest);
    q["axial_strain_rate"] = test.state.rows.back().axial_strain / test.state.rows.back().time;
    q["steps"] = static_cast<double>(test.world.stepping.steps);
    q["processor_seconds"] = seconds;
}

std::string case_text(const ResolvedCase& description) {
    std::ostringstream text;
    write_resolved_case(text, description, fs::path("."));
    return text.str();
}

/// Identifies the input of a cached result.
std::string mark_of(const ResolvedCase& description, const GuideTest& test) {
    return sha256(fmt::format("{} {}\n{}", measures_version, test.loading, case_text(description)));
}

std::optional<GuideResult> read_cached(const fs::path& file, const std::string& mark) {
    std::ifstream in(file);
    if (!in) return std::nullopt;
    const Json json = Json::parse(in, nullptr, false);
    if (!json.is_object() || json.value("mark", "") != mark) return std::nullopt;
    GuideResult result;
    result.error = json.value("error", "");
    for (const auto& [name, value] : json["quantities"].items()) {
        if (value.is_number()) result.quantities[name] = value.get<double>();
    }
    return result;
}

/// Writes a cached result; if the program is stopped, the file is either complete or absent.
void write_cached(const fs::path& file, const std::string& mark, const GuideResult& result) {
    Json json{{"mark", mark}, {"error", result.error}, {"quantities", Json::object()}};
    for (const auto& [name, value] : result.quantities) json["quantities"][name] = value;
    const fs::path fresh = file.string() + ".new";
    {
        std::ofstream out(fresh);
        out << json.dump(1) << '\n';
        out.close();
        if (!out) throw InputError(fmt::format("{}: cannot be written, expected a disc with space", fresh.string()));
    }
    fs::rename(fresh, file);
}

}  // namespace

std::string GuideTest::name() const { return fmt::format("{}_{}_{}_{}_{}", experiment, law, specimen, loading, seed); }

GuideTest guide_test(const std::string& experiment, const std::string& law, const std::string& specimen,
                     const std::string& loading, std::int64_t seed) {
    return {experiment, specimen == "circles" ? law_of_circles : law, specimen, loading, seed};
}

std::string unit_of_quantity(const std::string& quantity) {
    static const std::map<std::string, std::string> units{
        {"mean_back_tension", "N"},         {"mean_back_tension_interface", "N"},
        {"youngs_modulus", "N/m"},          {"first_break_stress", "N/m"},
        {"first_slip_stress", "N/m"},       {"time_step", "s"},
        {"largest_stress", "N/m"},          {"secant_modulus", "N/m"},
        {"initial_tangent_modulus", "N/m"}, {"tangent_modulus_50", "N/m"},
        {"axial_strain_rate", "1/s"},       {"processor_seconds", "s"},
    };
    const auto found = units.find(quantity);
    return found == units.end() ? "-" : found->second;
}

ResolvedCase guide_case(const GuideTest& test, const EnsembleOptions& options) {
    const std::string loading = test.loading == "compression" ? "compression" : "tension";
    const CaseFiles shipped(options.cases / (test.specimen + "_" + loading + ".toml"));
    const GuideExperiment& experiment = guide_experiment(test.experiment);
    std::vector<CaseSetting> settings = experiment.settings(shipped.with({}));
    settings.push_back({"packing.seed", test.seed, "guide:1"});
    settings.push_back({"numerics.contact_law", test.law, "guide:1"});
    settings.push_back({"numerics.threads", std::int64_t{1}, "guide:1"});
    return shipped.with(settings, {.rate = options.rate_factor * experiment.rate});
}

GuideResult measure_guide_test(const ResolvedCase& description, const GuideTest& test,
                               const std::function<bool()>& interrupted) {
    TestHooks hooks;
    hooks.interrupted = interrupted;
    GuideResult result;
    try {
        if (guide_experiment(test.experiment).without_platens) {
            take_counts(result, description, hooks);
            return result;
        }
        VirtualTest prepared = prepare_test(description, hooks);
        if (test.loading == elastic_test) {
            take_elastic(result, prepared);
        } else {
            const double before = thread_seconds();
            load_specimen(prepared, hooks);
            if (prepared.state.ended_by.empty()) throw TestInterrupted();
            take_loaded(result, prepared, thread_seconds() - before);
        }
        std::erase_if(result.quantities, [](const auto& entry) { return !std::isfinite(entry.second); });
    } catch (const InputError& error) {
        result.error = error.what();
    } catch (const UnstableRun& error) {
        result.error = error.what();
    }
    return result;
}

GuideResults run_guide_tests(const std::vector<GuideTest>& tests, const EnsembleOptions& options,
                             const EnsembleHooks& hooks) {
    fs::create_directories(options.cache);
    std::vector<std::optional<GuideResult>> results(tests.size());
    std::atomic<std::size_t> next{0}, done{0};
    std::mutex guard;  // protects progress and failure
    std::exception_ptr failure;
    std::atomic<bool> stop{false};
    const auto stopped = [&] { return stop || (hooks.interrupted && hooks.interrupted()); };
    const auto work = [&] {
        try {
            for (std::size_t k = next++; k < tests.size(); k = next++) {
                const ResolvedCase description = guide_case(tests[k], options);
                const fs::path file = options.cache / (tests[k].name() + ".json");
                const std::string mark = mark_of(description, tests[k]);
                results[k] = read_cached(file, mark);
                if (!results[k]) {
                    if (stopped()) continue;  // later tests may still be in the cache
                    try {
                        results[k] = measure_guide_test(description, tests[k], stopped);
                    } catch (const TestInterrupted&) {
                        continue;
                    }
                    write_cached(file, mark, *results[k]);
                }
                ++done;
                const std::lock_guard lock(guard);
                if (hooks.progress) hooks.progress(done, tests.size(), tests[k]);
            }
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!failure) failure = std::current_exception();
            stop = true;
        }
    };
    {
        std::vector<std::jthread> workers;
        for (int k = 1; k < options.jobs; ++k) workers.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
    GuideResults known;
    for (std::size_t k = 0; k < tests.size(); ++k) {
        if (results[k]) known[tests[k]] = std::move(*results[k]);
    }
    return known;
}

}  // namespace crackle::studies
