// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle envelope OUT...`: strength over confinement, of tests and of campaigns.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/envelope/measured_strengths.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/results/json_number.hpp"
#include "specimens/statistics/mean.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/plot/envelope_panels.hpp"
#include "tools/plot/figure_options.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using plot::EnvelopeFigure;

/// Of strength over tension, from m: Hoek & Martin, J. Rock Mech. Geotech. Eng. 6, 2014.
double hoek_martin(double m) { return 8.62 + 0.7 * m; }

constexpr std::size_t enough_confinements = 5;  // for Hoek-Brown's two numbers (Hoek & Brown 2019)
constexpr double largest_share = 0.5;           // of the unconfined strength, likewise
constexpr double trusted_misfit = 0.1;          // about what packings scatter by
constexpr double trusted_factor = 1.5;          // between ratio and hoek_martin(): about the spread of their rocks
constexpr double smallest_m = 4.0, largest_m = 35.0;  // of intact rocks in their tables

/// What a reader of the numbers should know, a sentence each.
std::vector<std::string> notices_on(const EnvelopeFigure& e) {
    const StrengthEnvelope& laws = e.laws;
    std::vector<std::string> all;
    for (const auto& [law, misfit] :
         {std::pair("Mohr-Coulomb", laws.misfit), std::pair("Hoek-Brown", laws.hoek_brown_misfit)}) {
        if (misfit > trusted_misfit)
            all.push_back(fmt::format(
                "{} misses the means by {:.2g} of them: the rock does not follow it over these pressures, and "
                "its numbers hold for no other",
                law, misfit));
    }
    const double unconfined = laws.hoek_brown_strength.value, last = laws.strengths.back().confinement;
    const bool has_unconfined = laws.strengths.front().confinement == 0.0;
    const double strength = has_unconfined ? laws.strengths.front().mean : unconfined;
    if (last > largest_share * strength * (1.0 + 1e-9)) {
        all.push_back(
            fmt::format("the largest pressure is {:.2g} of the unconfined strength, beyond the half up to which "
                        "Hoek-Brown is meant",
                        last / strength));
    }
    if (!has_unconfined) all.emplace_back("no unconfined compression: the unconfined strength is extrapolated");
    if (laws.strengths.size() < enough_confinements) {
        all.push_back(fmt::format("{}; Hoek and Brown ask for {} or more, 0 among them",
                                  counted(laws.strengths.size(), "confinement"), enough_confinements));
    }
    if (!(laws.slope.value > 1.0))
        all.emplace_back("the strength grows by less than the confinement: the friction angle is not positive");
    const double m = laws.hoek_brown_m.value;
    if (m < smallest_m || m > largest_m) {
        all.push_back(fmt::format("m = {:.3g}; intact rocks have {:g} to {:g}", m, smallest_m, largest_m));
    }
    if (e.tension.count == 0) {
        all.emplace_back("no tension: m is not checked against the tensile strength");
    } else {
        const double factor = unconfined / e.tension.mean / hoek_martin(m);
        if (factor > trusted_factor || factor < 1.0 / trusted_factor) {
            all.push_back(
                fmt::format("unconfined over tensile strength is {:.2g} times what Hoek and Martin find at this m: one "
                            "of the three is not a rock's",
                            factor));
        }
    }
    for (const std::string& one : e.tests.left_out) all.push_back("left out: " + one);
    return all;
}

Json interval_of(const FittedNumber& number) {
    return {{"value", finite_or_null(number.value)},
            {"low", finite_or_null(number.low)},
            {"high", finite_or_null(number.high)}};
}

Json as_json(const EnvelopeFigure& e, const std::vector<std::string>& notices) {
    const StrengthEnvelope& laws = e.laws;
    Json strengths = Json::array();
    for (const StrengthAt& at : laws.strengths) {
        strengths.push_back({{"confining_pressure", at.confinement},
                             {"tests", at.tests},
                             {"mean", at.mean},
                             {"deviation", finite_or_null(at.deviation)},
                             {"low", finite_or_null(at.low)},
                             {"high", finite_or_null(at.high)},
                             {"mohr_coulomb", laws.mohr_coulomb(at.confinement)},
                             {"hoek_brown", laws.hoek_brown(at.confinement)}});
    }
    const StrengthMeasure& measure = e.tests.measure;
    Json json{{"measure", measure.strain ? Json({{"strain", *measure.strain}}) : Json({{"figure", measure.figure}})},
              {"unit", e.tests.unit},
              {"packings", laws.packings},
              {"variation", finite_or_null(laws.variation)},
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
                           {"deviation", finite_or_null(e.tension.deviation)},
                           {"low", finite_or_null(e.tension.low)},
                           {"high", finite_or_null(e.tension.high)},
                           {"strength_ratio", laws.hoek_brown_strength.value / e.tension.mean},
                           {"strength_ratio_by_m", hoek_martin(laws.hoek_brown_m.value)}};
    }
    json["notices"] = notices;
    const std::string stress = e.tests.unit;
    json["units"] = {
        {"measure", "what is taken for the strength: a figure of summary.json, or the stress at an axial strain"},
        {"strengths",
         stress + ", means of tests; low and high: their 95 % interval; mohr_coulomb, hoek_brown: what the laws have"},
        {"variation", "-, pooled coefficient of variation of the packings"},
        {"mohr_coulomb", stress + ", degrees of friction_angle: strength + slope * confining_pressure"},
        {"hoek_brown", stress + ": confining_pressure + sqrt(m strength confining_pressure + strength^2)"},
        {"low, high",
         "95 % intervals of the laws' numbers: by drawing packings again, of fewer than 8 packings Student's t over "
         "them"},
        {"misfit", "-, root mean square of what the law misses the means by, over them"},
        {"strength_ratio", "-, Hoek-Brown's strength over the mean tensile strength"},
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
    fmt::print("{} of {} in {}, which scatter by {:.2g} of their mean\n", e.tests.measure.spoken(),
               counted(laws.packings, "packing"), unit, laws.variation);
    fmt::print("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", "pressure", "tests", "mean", "deviation",
               "95 % interval", "Mohr-Coulomb", "Hoek-Brown");
    for (const StrengthAt& at : laws.strengths) {
        fmt::print("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", stress(at.confinement), at.tests, stress(at.mean),
                   stress(at.deviation), range(at.low, at.high), stress(laws.mohr_coulomb(at.confinement)),
                   stress(laws.hoek_brown(at.confinement)));
    }
    if (e.tension.count > 0) {
        fmt::print("  {:>10}{:>7}{:>10}{:>11}{:>20}{:>14}{:>12}\n", "tension", e.tension.count, stress(e.tension.mean),
                   stress(e.tension.deviation), range(e.tension.low, e.tension.high), "",
                   stress(-laws.hoek_brown_tension()));
    }
    fmt::print("\nMohr-Coulomb, misfit {:.2g}\n", laws.misfit);
    fmt::print("  friction angle       {} degrees\n", number(laws.friction_angle, 1.0));
    fmt::print("  cohesion             {} {}\n", number(laws.cohesion, factor), unit);
    fmt::print("  unconfined strength  {} {}\n", number(laws.strength, factor), unit);
    fmt::print("  N                    {}\n", number(laws.slope, 1.0));
    fmt::print("Hoek-Brown, misfit {:.2g}\n", laws.hoek_brown_misfit);
    fmt::print("  m                    {}\n", number(laws.hoek_brown_m, 1.0));
    fmt::print("  unconfined strength  {} {}\n", number(laws.hoek_brown_strength, factor), unit);
    if (e.tension.count > 0) {
        const FittedNumber& m = laws.hoek_brown_m;
        fmt::print("  over the tensile     {:.3g}; 8.62 + 0.7 m = {:.3g} ({:.3g} to {:.3g}) after Hoek and Martin\n",
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

/// @throws InputError of too little, with what was left out
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
         "stress of summary.json taken for the strength of compressions: largest_stress of tests that harden")  //
        ("strain", po::value<double>()->value_name("X"),
         "take the stress of the curve at this axial strain in its place, of tests that reach it")  //
        ("output,o", po::value<std::string>()->value_name("FIGURE"),
         "figure to write: .svg, .pdf or .png; strengths with both laws over confinement and, beside or below, Mohr "
         "circles with both envelopes");
    plot::add_figure_options(options, 2);
    options.add_options()("force", "replace a figure that is there");
    std::vector<Companion> companions{{"force", {"output"}}};
    for (const std::string& option : plot::figure_options()) companions.push_back({option, {"output"}});
    return {
        .synopses = {"crackle envelope OUT... [OPTIONS]"},
        .description =
            "Strength over confining pressure from folders that `crackle test` or `crackle campaign` wrote: "
            "compressions without and under pressure (kind = \"biaxial\") of one rock, of two packings and three "
            "pressures at least. Mohr-Coulomb and Hoek-Brown by least squares, with 95 % intervals by drawing packings "
            "again, and what they miss the means by; tensile strength beside them where there are tensions. Tests "
            "without a strength are left out and named; of tests that harden --figure or --strain takes a stress.",
        .options = {{"options", options}},
        .operand = "OUT",
        .several_operands = true,
        .companions = companions,
        .examples = {{"crackle envelope out/granite-envelope", "a campaign: specimens/plans/granite_envelope.toml"},
                     {"crackle envelope out/granite-envelope -o envelope.pdf"},
                     {"crackle envelope out/soil --strain 0.02", "of tests that harden"},
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
        refuse_replacing(output, values.contains("force"));
    }
    const plot::FigureLook look = plot::figure_look("envelope", values, format);
    const MeasuredStrengths tests =
        read_strengths(std::vector<fs::path>(given.operands.begin(), given.operands.end()), measure_of(values));
    const EnvelopeFigure fitted = fitted_to(tests);
    const std::vector<std::string> notices = notices_on(fitted);
    if (!output.empty()) draw(fitted, output, look, format);
    if (values.contains("json")) {
        std::cout << as_json(fitted, notices).dump(2) << '\n';
    } else {
        print(fitted);
        for (const std::string& notice : notices) fmt::print("notice: {}\n", notice);
    }
    return exit_done;
}

}  // namespace crackle::tools
