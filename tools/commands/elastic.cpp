// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle elastic CASE.toml`: prints the linear solution for a specimen, without time stepping.

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/elastic/jointed_compliance.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

Json event(const ElasticAnalysis& a, const std::optional<FirstEvent>& first) {
    if (!first) return nullptr;
    const LinearBond& bond = a.bonds[first->bond];
    return {{"strain", first->strain},       {"stress", first->stress}, {"body_i", bond.body_i},
            {"body_j", bond.body_j},         {"x", bond.position.x},    {"y", bond.position.y},
            {"bond_strength", bond.strength}};
}

Json stress_of(const std::optional<FirstEvent>& first) { return first ? Json(first->stress) : Json(nullptr); }

std::string event_text(const VirtualTest& test, const ElasticAnalysis& a, const std::optional<FirstEvent>& first) {
    if (!first) return "none";
    const LinearBond& bond = a.bonds[first->bond];
    return fmt::format("{} at strain {:.3e}, bodies {} and {}",
                       spoken_stress(first->stress, test.description.stress_unit()), first->strain, bond.body_i,
                       bond.body_j);
}

void print(const VirtualTest& test, const ElasticAnalysis& a, double seconds) {
    print_out("{}, {}: {} particles, {} bonds, {} unknowns, {:.0f} ms\n", name_of(test.setup.specimen.kind),
              name_of(test.description.loading.kind), test.setup.specimen.particles, a.bonds.size(), a.unknowns,
              1e3 * seconds);
    if (test.setup.apparatus.uniaxial)
        print_out("  Young's modulus   {}, Poisson's ratio {:.4g} (residual {:.1e})\n",
                  spoken_stress(a.youngs_modulus, test.description.stress_unit(), 6), a.poissons_ratio, a.residual);
    else
        print_out(
            "  nominal modulus   {}, stress divided by strain as this kind of test defines them (residual {:.1e})\n",
            spoken_stress(a.youngs_modulus, test.description.stress_unit(), 6), a.residual);
    print_out("  first slip        {}\n", event_text(test, a, a.first_slip));
    print_out("  first break       {} (linear, no slip)\n", event_text(test, a, a.first_break));
    print_out("  stable time step  {:.6g} s{}; guaranteed bound {:.3f} of it; a test uses {:.3f} of it\n",
              a.stable_time_step,
              a.stable_time_step_proved ? ", proved"
              : test.world.settings.segment_law != SegmentLaw::rounded
                  ? " (a lower bound, since the contact law's stiffness is unsymmetric)"
                  : " (not proved; at most 2 % below the exact value)",
              a.time_step_bound / a.stable_time_step, a.time_step / a.stable_time_step);
    if (a.free.count > 0) {
        std::string ids;
        constexpr std::size_t shown = 12;
        for (std::size_t k = 0; k < a.free_ids.size() && k < shown; ++k) ids += fmt::format(" {}", a.free_ids[k]);
        print_out("  {} motions store no energy; they move bodies{}{}\n", a.free.count, ids,
                  a.free_ids.size() > shown ? fmt::format(" and {} more (--json lists them)", a.free_ids.size() - shown)
                                            : "");
    }
    for (std::size_t k = 0; k < a.frequencies.size(); ++k)
        print_out("  mode {:<3} {:.6g} rad/s\n", k + 1, a.frequencies[k]);
}

std::string bonds_table(const ElasticAnalysis& a) {
    std::string text = "body_i,body_j,x_m,y_m,strength_N,normal_force_N,shear_force_N,break_strain,slip_strain\n";
    for (const LinearBond& b : a.bonds) {
        text += fmt::format("{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", b.body_i, b.body_j,
                            b.position.x, b.position.y, b.strength, b.normal_force, b.shear_force, b.break_strain,
                            b.slip_strain);
    }
    return text;
}

}  // namespace

ResolvedCase elastic_case(ResolvedCase description, std::vector<std::string>& notices) {
    if (description.loading.platens == PlatenKind::frictional) {
        notices.push_back(
            fmt::format("the linear solution supports only bonded platens, which are used in place of {} platens",
                        name_of(description.loading.platens)));
        description.loading.platens = PlatenKind::bonded;
    }
    if (description.confined()) {
        notices.push_back("the linear solution is computed without confining pressure");
        description.loading.kind = LoadingKind::compression;
        description.confinement.reset();
    }
    return description;
}

namespace {

Json moduli_along(const Compliance& s) {
    return {{"x", 1.0 / s[0][0]}, {"y", 1.0 / s[1][1]}, {"shear", 1.0 / s[2][2]}};
}

Json compliance_as_json(const JointedCompliance& found) {
    Json json{{"jointed", found.jointed},
              {"welded", found.welded},
              {"expected", found.expected ? Json(*found.expected) : Json(nullptr)},
              {"moduli", {{"jointed", moduli_along(found.jointed)}, {"welded", moduli_along(found.welded)}}}};
    if (found.expected)
        json["moduli"]["expected"] = moduli_along(*found.expected);
    else
        json["no_expected"] = found.why_not;
    return json;
}

void print(const JointedCompliance& found, const std::string& stress) {
    const auto print_row = [&](const char* name, std::size_t k) {
        print_out("    {:<8} {:>11.5g} {:>11.5g}", name, 1.0 / found.jointed[k][k], 1.0 / found.welded[k][k]);
        if (found.expected) print_out(" {:>11.5g}", 1.0 / (*found.expected)[k][k]);
        print_out("\n");
    };
    print_out("  moduli of the rock without platens, {} (--json prints the full tensor)\n", stress);
    print_out("             with joints      welded{}\n", found.expected ? "   by theory" : "");
    print_row("E along x", 0);
    print_row("E along y", 1);
    print_row("G", 2);
    print_out("    {}\n",
              found.expected
                  ? "by theory: compliance of the welded rock plus that of persistent joints (Amadei and Goodman)"
                  : "no theory for comparison: " + found.why_not);
}

}  // namespace

std::string elastic_as_json(const VirtualTest& test, const ElasticAnalysis& a,
                            const std::optional<JointedCompliance>& compliance, double seconds, int indent) {
    Json json{{"title", test.description.title},
              {"kind", name_of(test.description.loading.kind)},
              {"platens", name_of(test.description.loading.platens)},
              {"specimen", name_of(test.setup.specimen.kind)},
              {"particles", test.setup.specimen.particles},
              {"bonds", a.bonds.size()},
              {test.setup.apparatus.uniaxial ? "youngs_modulus" : "nominal_modulus", a.youngs_modulus},
              {"poissons_ratio", a.poissons_ratio},
              {"stable_time_step", a.stable_time_step},
              {"stable_time_step_proved", a.stable_time_step_proved},
              {"time_step_bound", a.time_step_bound},
              {"time_step", a.time_step},
              {"first_break_stress", stress_of(a.first_break)},
              {"first_break", event(a, a.first_break)},
              {"first_slip_stress", stress_of(a.first_slip)},
              {"first_slip", event(a, a.first_slip)},
              {"zero_energy_modes", a.free.count},
              {"zero_energy_bodies", a.free_ids},
              {"unknowns", a.unknowns},
              {"residual", a.residual},
              {"seconds", seconds}};
    if (!a.frequencies.empty()) json["angular_frequencies"] = a.frequencies;
    if (compliance) json["compliance"] = compliance_as_json(*compliance);
    const std::string stress = test.description.stress_unit();
    json["units"] = {
        {"youngs_modulus", stress + ", at small strain, with all bonds intact and no slip. Tests without platens have "
                                    "nominal_modulus instead: "
                                    "stress divided by strain, as the kind of test defines them"},
        {"poissons_ratio", "-, from the lateral strain as defined for the curve"},
        {"stable_time_step",
         "s, exact stability limit: 4M - 2dt C - dt^2 K is positive definite below it, as a Cholesky factorisation "
         "shows if stable_time_step_proved is true"},
        {"time_step_bound", "s, time step below which stability is guaranteed, found without an eigenvalue solve"},
        {"time_step", "s, time step that crackle test uses"},
        {"first_break_stress",
         stress + ", axial stress at which the first bond fails (linear solution without slip); null if no bond fails"},
        {"first_slip_stress",
         stress + ", axial stress at which the first contact point reaches its Coulomb limit; null if no point does"},
        {"bond_strength", "N"},
        {"x", "m"},
        {"y", "m"},
        {"zero_energy_modes",
         "motions that store no energy: floating particles, and particles held by a single circle contact"},
        {"zero_energy_bodies", "ids of the bodies that move in these modes"},
        {"residual", "|f - Ku| / |f|, the numerical error of the solve"},
        {"angular_frequencies",
         "rad/s, angular frequencies of the lowest modes that store energy, with the platens held"},
        {"seconds",
         "s, time for bonding, exact time step, assembly, solves and eigenvalues, without making the specimen"}};
    if (compliance)
        json["units"]["compliance"] = fmt::format(
            "1/({0}), compliance matrices of the jointed rock without platens; rows: strain x, strain y, shear strain; "
            "columns: stress x, stress y, shear stress; tension positive; welded: with the rock's properties on the "
            "traces; expected: welded plus the compliance of persistent traces (Amadei and Goodman); moduli: {0}, "
            "along x, along y, in shear",
            stress);
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

CommandLine describe_elastic() {
    po::options_description options;
    options.add_options()("json", "print one JSON object")  //
        ("strain", po::value<double>()->value_name("X")->default_value(1e-4, "1e-4"),
         "axial strain at which --bonds computes the forces")  //
        ("bonds", po::value<std::string>()->value_name("FILE"),
         "CSV file to write: forces in all bonds, compression positive. The shear force acts on body_i, along the "
         "normal from i to j turned by +90 degrees. Strains at break and slip are inf if these never occur; the "
         "strength of an unbreakable bond is inf")      //
        ("force", "replace an existing file of bonds")  //
        ("modes", po::value<int>()->value_name("N")->default_value(0), "number of lowest vibration modes to find");
    return {.synopses = {"crackle elastic CASE.toml [OPTIONS]"},
            .description =
                "Makes and bonds the specimen of CASE.toml with its platens, and solves the linear equations of its "
                "stiffness matrix. Prints the small-strain Young's modulus and Poisson's ratio, the bond that breaks "
                "first (linear, no slip), and the contact point that slips first. Also prints the exact stable time "
                "step and the number of motions that store no energy. For a jointed rock it also prints the moduli of "
                "the rock without platens, and the moduli predicted for persistent joint sets. Takes no time step; "
                "writes no file unless an option requests it.",
            .options = {{"options", options}},
            .operand = "CASE.toml",
            .companions = {{"strain", {"bonds"}}, {"force", {"bonds"}}},
            .verbose = "time taken by each stage in seconds, and numbers of bodies, contacts and unknowns",
            .examples = {{"crackle elastic specimens/guide_rock/circles_tension.toml"},
                         {"crackle elastic case.toml --json --modes 5"},
                         {"crackle elastic case.toml --strain 1e-4 --bonds bonds.csv"}}};
}

int elastic(const Invocation& given) {
    const po::variables_map& values = given.values;
    Messages& messages = given.messages;
    if (given.operands.empty())
        throw InputError("crackle elastic: found no CASE.toml, expected one (see crackle elastic --help)");
    const double strain = values["strain"].as<double>();
    if (!(strain > 0.0) || !(strain < 1.0))
        throw InputError(fmt::format("crackle elastic: --strain: found {}, expected a number > 0 and < 1", strain));
    const int modes = values["modes"].as<int>();
    if (modes < 0) throw InputError(fmt::format("crackle elastic: --modes: found {}, expected a number >= 0", modes));
    ResolvedCase description = read_case(given_or_shipped(given.operands.front()));
    if (values.contains("bonds"))
        output_file(values["bonds"].as<std::string>(), values.contains("force"), files_read(description));
    TestHooks hooks;
    if (!values.contains("json") || messages.verbose())
        hooks.stage = [&messages](const std::string& text) { messages.stage(text); };
    if (messages.verbose()) hooks.detail = [&messages](const std::string& text) { messages.detail(text); };
    if (messages.progress().shown())
        hooks.working = [&messages](const std::string& what) { messages.progress().draw({.detail = what}); };
    std::vector<std::string> notices;
    description = elastic_case(std::move(description), notices);
    for (const std::string& notice : notices) messages.notice(notice);
    const Clock::time_point start = Clock::now();
    const VirtualTest test = bond_test(description, hooks);
    messages.progress().begin("solving the linear system", 2.0, "");
    if (modes > 0) messages.progress().step(0.0, fmt::format("solving the linear system and finding {} modes", modes));
    const ElasticAnalysis analysis = analyse_elastic(test.world, test.setup, moduli_of(test), strain, modes);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count() - test.specimen_seconds;
    TestHooks quietly = hooks;  // hooks for making the same specimen again without messages
    quietly.stage = quietly.detail = {};
    const std::optional<JointedCompliance> compliance = jointed_compliance(description, quietly);
    messages.make_room();
    messages.detail(fmt::format("solved for {} unknowns, residual {:.1e}", analysis.unknowns, analysis.residual));
    if (hooks.stage)
        for (const std::string& notice : test.setup.origin.notices) hooks.stage("notice: " + notice);
    if (values.contains("bonds")) replace_file(values["bonds"].as<std::string>(), bonds_table(analysis));
    if (values.contains("json"))
        print_text(elastic_as_json(test, analysis, compliance, seconds, 2) + '\n');
    else
        print(test, analysis, seconds);
    if (compliance && !values.contains("json")) print(*compliance, test.description.stress_unit());
    return exit_done;
}

}  // namespace crackle::tools
