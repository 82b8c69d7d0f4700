// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle envelope OUT...`: prints strength against confinement, from tests or campaigns.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/envelope/measured_strengths.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/statistics/mean.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/plot/envelope_panels.hpp"
#include "tools/plot/figure_options.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using plot::EnvelopeFigure;

/// Ratio of unconfined to tensile strength for Hoek-Brown's m: Hoek & Martin, J. Rock Mech. Geotech. Eng. 6, 2014.
double hoek_martin(double m) { return 8.62 + 0.7 * m; }

// Number of confinements needed to fit the two parameters of Hoek-Brown (Hoek & Brown 2019).
constexpr std::size_t enough_confinements = 5;
// Largest confinement for Hoek-Brown, relative to the unconfined strength (ibid.).
constexpr double largest_share = 0.5;
constexpr double trusted_misfit = 0.1;  // largest misfit without a notice, about the scatter between packings
// Accepted factor between a strength ratio and hoek_martin(); it is about the scatter of Hoek and Martin's data.
constexpr double trusted_factor = 1.5;
constexpr double smallest_m = 4.0, largest_m = 35.0;  // range of m for intact rocks in Hoek and Brown's tables

/// Notices about the fitted parameters for the user, one sentence each.
std::vector<std::string> notices_on(const EnvelopeFigure& e) {
    const StrengthEnvelope& laws = e.laws;
    std::vector<std::string> all;
    for (const auto& [law, misfit] :
         {std::pair("Mohr-Coulomb", laws.misfit), std::pair("Hoek-Brown", laws.hoek_brown_misfit)}) {
        if (misfit > trusted_misfit)
            all.push_back(fmt::format(
                "{} deviates from the mean strengths by {:.2g} of their values; this rock does not follow the law in "
                "this range of pressures, and the fitted parameters are not valid for other ranges",
                law, misfit));
    }
    const double unconfined = laws.hoek_brown_strength.value, last = laws.strengths.back().confinement;
    const bool has_unconfined = laws.strengths.front().confinement == 0.0;
    const double strength = has_unconfined ? laws.strengths.front().mean : unconfined;
    if (last > largest_share * strength * (1.0 + 1e-9)) {
        all.push_back(
            fmt::format("the largest confining pressure is {:.2g} times the unconfined strength; the Hoek-Brown law "
                        "applies only up to half of it",
                        last / strength));
    }
    if (!has_unconfined)
        all.emplace_back("there are no unconfined compression tests, so the unconfined strength is extrapolated");
    if (laws.strengths.size() < enough_confinements) {
        all.push_back(fmt::format("{}; Hoek and Brown require at least {}, including 0",
                                  counted(laws.strengths.size(), "confinement"), enough_confinements));
    }
    if (!(laws.slope.value > 1.0))
        all.emplace_back("the strength increases less than the confinement, so the friction angle is not positive");
    const double m = laws.hoek_brown_m.value;
    if (m < smallest_m || m > largest_m) {
        all.push_back(
            fmt::format("m = {:.3g}, while it lies between {:g} and {:g} for intact rocks", m, smallest_m, largest_m));
    }
    if (e.tension.count == 0) {
        all.emplace_back("there are no tension tests, so m is not checked against the tensile strength");
    } else {
        const double factor = unconfined / e.tension.mean / hoek_martin(m);
        if (factor > trusted_factor || factor < 1.0 / trusted_factor) {
            all.push_back(
                fmt::format("the ratio of unconfined to tensile strength is {:.2g} times that of Hoek and Martin for "
                            "this m; at least one of the three values is unrealistic for rock",
                            factor));
        }
    }
    if (e.tests.bounds > 0)
        all.push_back(
            fmt::format("{} of {} largest stresses are those at the end of loading, so they are lower bounds of "
                        "strengths; raise loading.max_axial_strain",
                        e.tests.bounds, e.tests.compressions.size()));
    for (const std::string& one : e.tests.left_out) all.push_back("left out: " + one);
    if (e.tests.failures > 0)
        all.push_back(fmt::format("{} ended with a system error; run `crackle campaign` again to repeat them",
                                  counted(e.tests.failures, "test")));
    return all;
}

Json interval_of(const FittedNumber& number) {
    return {{"value", number.value}, {"low", number.low}, {"high", number.high}};
}

Json measured_as_json(const EnvelopeFigure& e) {
    Json all = Json::array();
    for (const StrengthOfCores& cores : e.measured)
        all.push_back({{"confining_pressure", cores.confinement},
                       {"strength", cores.strength},
                       {"error", cores.error},
                       {"mohr_coulomb", e.laws.mohr_coulomb(cores.confinement)},
                       {"hoek_brown", e.laws.hoek_brown(cores.confinement)}});
    return all;
}

Json as_json(const EnvelopeFigure& e, const std::vector<std::string>& notices) {
    const StrengthEnvelope& laws = e.laws;
    Json strengths = Json::array();
    for (const StrengthAt& at : laws.strengths) {
        strengths.push_back({{"confining_pressure", at.confinement},
                             {"tests", at.tests},
                             {"mean", at.mean},
                             {"deviation", at.deviation},
                             {"low", at.low},
                             {"high", at.high},
                             {"mohr_coulomb", laws.mohr_coulomb(at.confinement)},
                             {"hoek_brown", laws.hoek_brown(at.confinement)}});
    }
    const StrengthMeasure& measure = e.tests.measure;
    Json json{{"measure", measure.strain ? Json({{"strain", *measure.strain}}) : Json({{"figure", measure.figure}})},
              {"unit", e.tests.unit},
              {"packings", laws.packings},
              {"variation", laws.variation},
              {"strengths", strengths},
              {"mohr_coulomb",
               {{"strength", interval_of(laws.strength)},
                {"slope", interval_of(laws.slope)},
                {"friction_angle", interval_of(laws.friction_angle)},
                {"cohesion", interval_of(laws.cohesion)},
                {"misfit", laws.misfit}}},
              {"hoek_brown",
               {{"strength", interval_of(laws.hoek_brown_strength)},
                {"m", interval_of(laws.hoek_brown_m)},
                {"tensile_strength", -laws.hoek_brown_tension()},
                {"misfit", laws.hoek_brown_misfit}}}};
    json["tension"] = nullptr;
    if (e.tension.count > 0) {
        json["tension"] = {{"tests", e.tension.count},
                           {"mean", e.tension.mean},
                           {"deviation", e.tension.deviation},
                           {"low", e.tension.low},
                           {"high", e.tension.high},
                           {"strength_ratio", laws.hoek_brown_strength.value / e.tension.mean},
                           {"strength_ratio_by_m", hoek_martin(laws.hoek_brown_m.value)}};
    }
    if (!e.measured.empty()) json["measured"] = measured_as_json(e);
    json["notices"] = notices;
    const std::string stress = e.tests.unit;
    json["units"] = {
        {"measure", "quantity used as the strength: a key of summary.json, or the stress at an axial strain"},
        {"strengths", stress + ", mean over the tests at each confining pressure; low and high: its 95 % interval; "
                               "mohr_coulomb, hoek_brown: strengths according to the fitted laws"},
        {"variation", "-, coefficient of variation between packings, pooled over the pressures"},
        {"mohr_coulomb", stress + ", friction_angle in degrees: strength + slope * confining_pressure"},
        {"hoek_brown", stress + ": confining_pressure + sqrt(m strength confining_pressure + strength^2)"},
        {"low, high",
         "95 % intervals of the fitted parameters, by resampling the packings, or by Student's t if there are fewer "
         "than 8 packings"},
        {"misfit", "-, root mean square of the law's deviations from the means, relative to the means"},
        {"strength_ratio", "-, ratio of the Hoek-Brown unconfined strength to the mean tensile strength"},
        {"strength_ratio_by_m", "-, 8.62 + 0.7 m, Hoek & Martin 2014"}};
    return json;
}

void print(const EnvelopeFigure& e) {
    const StrengthEnvelope& laws = e.laws;
    const bool area = e.tests.unit == "Pa";
    const double factor = area ? 1e6 : 1e3;
    const std::string unit = area ? "MPa" : "kN/m";
    const auto stress = [&](double value) {
        return std::isfinite(value) ? fmt::format("{:.4g}", value / factor) : std::string("-");
    };
    const auto range = [&](double low, double high) {
        return std::isfinite(low) ? fmt::format("{} to {}", stress(low), stress(high)) : std::string("-");
    };
    const auto number = [](const FittedNumber& n, double by) {
        if (!std::isfinite(n.low)) return fmt::format("{:.4g} (no interval)", n.value / by);
        return fmt::format("{:.4g} ({:.4g} to {:.4g})", n.value / by, n.low / by, n.high / by);
    };
    print_out("{} of {} in {}; coefficient of variation {:.2g}\n", e.tests.measure.spoken(),
              counted(laws.packings, "packing"), unit, laws.variation);
    print_out("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", "pressure", "tests", "mean", "deviation",
              "95 % interval", "Mohr-Coulomb", "Hoek-Brown");
    for (const StrengthAt& at : laws.strengths) {
        print_out("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", stress(at.confinement), at.tests, stress(at.mean),
                  stress(at.deviation), range(at.low, at.high), stress(laws.mohr_coulomb(at.confinement)),
                  stress(laws.hoek_brown(at.confinement)));
    }
    if (e.tension.count > 0) {
        print_out("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", "tension", e.tension.count, stress(e.tension.mean),
                  stress(e.tension.deviation), range(e.tension.low, e.tension.high), "",
                  stress(-laws.hoek_brown_tension()));
    }
    for (const StrengthOfCores& cores : e.measured) {
        print_out("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", stress(cores.confinement), "meas.",
                  stress(cores.strength), cores.error > 0.0 ? stress(cores.error) : "-", "",
                  stress(laws.mohr_coulomb(cores.confinement)), stress(laws.hoek_brown(cores.confinement)));
    }
    print_out("\nMohr-Coulomb, misfit {:.2g}\n", laws.misfit);
    print_out("  friction angle       {} degrees\n", number(laws.friction_angle, 1.0));
    print_out("  cohesion             {} {}\n", number(laws.cohesion, factor), unit);
    print_out("  unconfined strength  {} {}\n", number(laws.strength, factor), unit);
    print_out("  N                    {}\n", number(laws.slope, 1.0));
    print_out("Hoek-Brown, misfit {:.2g}\n", laws.hoek_brown_misfit);
    print_out("  m                    {}\n", number(laws.hoek_brown_m, 1.0));
    print_out("  unconfined strength  {} {}\n", number(laws.hoek_brown_strength, factor), unit);
    if (e.tension.count > 0) {
        const FittedNumber& m = laws.hoek_brown_m;
        print_out("  ratio to tensile     {:.3g}; Hoek and Martin: 8.62 + 0.7 m = {:.3g} ({:.3g} to {:.3g})\n",
                  laws.hoek_brown_strength.value / e.tension.mean, hoek_martin(m.value), hoek_martin(m.low),
                  hoek_martin(m.high));
    }
}

StrengthMeasure measure_of(const po::variables_map& values) {
    StrengthMeasure measure{.figure = values["figure"].as<std::string>()};
    if (!values.contains("strain")) return measure;
    if (!values["figure"].defaulted()) throw without_effect("envelope", "--figure", "--strain");
    measure.strain = values["strain"].as<double>();
    if (!(*measure.strain > 0.0 && *measure.strain < 1.0))
        throw InputError(fmt::format("envelope: --strain: found {}, expected a number > 0 and < 1", *measure.strain));
    return measure;
}

/// Fits both laws. @throws InputError if there are too few tests; the message names tests that were left out
EnvelopeFigure fitted_to(const MeasuredStrengths& tests) {
    try {
        return {fit_envelope(tests.compressions), tests, mean_of(tests.tensions)};
    } catch (const InputError& error) {
        if (tests.left_out.empty()) throw;
        constexpr std::size_t most_named = 5;
        const std::size_t named = std::min(most_named, tests.left_out.size());
        throw InputError(fmt::format(
            "{}; left out: {}{}", error.what(), fmt::join(std::span(tests.left_out).first(named), "; "),
            named < tests.left_out.size() ? fmt::format("; and {} more", tests.left_out.size() - named) : ""));
    }
}

/// Adds strengths measured in a laboratory. @throws InputError also if their magnitude shows that the unit is wrong
void add_measured(EnvelopeFigure& e, const fs::path& file) {
    e.measured = read_measured_strengths(file);
    e.measured_label = fmt::format("measured ({})", file.filename().string());
    double largest = 0.0, measured = 0.0;
    for (const StrengthPoint& test : e.tests.compressions) largest = std::max(largest, test.strength);
    for (const StrengthOfCores& cores : e.measured) measured = std::max(measured, cores.strength);
    require_like_scale(file.string(), "strength", measured, largest, " " + e.tests.unit, "strength (MPa)");
}

void draw(const EnvelopeFigure& e, const fs::path& output, const plot::FigureLook& look, plot::Format format) {
    using Rows = std::vector<std::vector<plot::Panel>>;
    constexpr double widest_stacked = 120.0 * plot::points_of_mm;
    const plot::Panel strengths = plot::strengths_over_confinement(e), circles = plot::mohr_circles(e);
    const Rows rows = look.width < widest_stacked ? Rows{{strengths}, {circles}} : Rows{{strengths, circles}};
    replace_file(output, plot::figure(rows, look.title, look.width, format, look.sheet));
}

}  // namespace

CommandLine describe_envelope() {
    po::options_description options;
    options.add_options()("json", "print one JSON object")  //
        ("figure", po::value<std::string>()->value_name("NAME")->default_value("peak_stress"),
         "key of summary.json whose stress is used as the strength of compression tests, for example largest_stress "
         "for specimens that harden")  //
        ("strain", po::value<double>()->value_name("X"),
         "use the stress at this axial strain as the strength instead, for tests that reach it")  //
        ("measured", po::value<std::string>()->value_name("FILE"),
         "table with the columns confining_pressure and strength, and error if there is one, with their units as in "
         "\"strength (MPa)\"; printed and drawn beside the computed strengths")  //
        ("output,o", po::value<std::string>()->value_name("FIGURE"),
         "figure to write: .svg, .pdf or .png; it shows strengths and both laws against confinement, and Mohr circles "
         "with both envelopes");
    plot::add_figure_options(options, 2);
    options.add_options()("force", "replace an existing figure");
    std::vector<Companion> companions{{"force", {"output"}}};
    for (const std::string& option : plot::figure_options()) companions.push_back({option, {"output"}});
    return {
        .synopses = {"crackle envelope OUT... [OPTIONS]"},
        .description =
            "Prints strength against confining pressure, from folders that `crackle test` or `crackle campaign` wrote. "
            "It needs compression tests of one rock without and with confining pressure (kind = \"biaxial\"), at least "
            "two packings and three pressures. Mohr-Coulomb and Hoek-Brown are fitted by least squares; their "
            "parameters have 95 % intervals from resampled packings. The tensile strength is printed if there are "
            "tension tests. Tests without a strength are left out and listed. For specimens that harden, use --figure "
            "or --strain. Exit code 4: some tests were left out because they ended with a system error.",
        .options = {{"options", options}},
        .operand = "OUT",
        .several_operands = true,
        .companions = companions,
        .examples = {{"crackle envelope out/granite-envelope", "a campaign: specimens/plans/granite_envelope.toml"},
                     {"crackle envelope out/granite-envelope -o envelope.pdf"},
                     {"crackle envelope out/granite-envelope -o envelope.pdf --measured laboratory.csv"},
                     {"crackle envelope out/soil --strain 0.02", "the strength is the stress at a strain of 0.02"},
                     {"crackle envelope out/unconfined-1 out/unconfined-2 out/confined-1 out/confined-2 --json"}}};
}

int envelope(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty()) {
        throw InputError(
            "envelope: found no folder of results, expected at least one: crackle envelope OUT... (see --help)");
    }
    const fs::path output = values.contains("output") ? values["output"].as<std::string>() : "";
    plot::Format format = plot::Format::svg;
    if (!output.empty()) {
        format = plot::format_of_output("envelope", output);
        output_file(output, values.contains("force"));
    }
    const plot::FigureLook look = plot::figure_look("envelope", values, format);
    const MeasuredStrengths tests =
        read_strengths(std::vector<fs::path>(given.operands.begin(), given.operands.end()), measure_of(values));
    EnvelopeFigure fitted = fitted_to(tests);
    if (values.contains("measured")) add_measured(fitted, values["measured"].as<std::string>());
    const std::vector<std::string> notices = notices_on(fitted);
    if (!output.empty()) draw(fitted, output, look, format);
    if (values.contains("json")) {
        print_text(as_json(fitted, notices).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    } else {
        print(fitted);
        for (const std::string& notice : notices) print_out("notice: {}\n", notice);
    }
    return tests.failures > 0 ? exit_system_fails : exit_done;
}

}  // namespace crackle::tools
