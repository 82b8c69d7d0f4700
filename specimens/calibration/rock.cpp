// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/rock.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/case/keyed_table.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/recordings/measured_curve.hpp"
#include "specimens/summary/summary_keys.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr DeclaredKey rock_keys[]{
    {"", "title", "a text", "Name of the rock."},
    {"[[test]]", "case", "a file", "Case of `crackle test`, relative to this file; required."},
    {"[[test]]", "name", "a text", "Name by which targets refer to the test; by default, the case's file name."},
    {"[[test]]", "set", "a table", "Keys of the case that are given other values, as in a plan of `crackle campaign`."},
    {"[[target]]", "test", "the name of a test", "Test that provides the figure; required if there are several tests."},
    {"[[target]]", "figure", "a figure of summary.json", "\"youngs_modulus\", \"peak_stress\"; required."},
    {"[[target]]", "over", "another figure of summary.json",
     "The target is then the ratio of `figure` to this key, for example crack_initiation_stress to peak_stress."},
    {"[[target]]", "tests", "a list of names",
     "Replaces test if figure is \"friction_angle\" (Mohr-Coulomb, deg) or \"hoek_brown_m\": names of compression "
     "tests under at least three confining pressures, including 0. The law is fitted to the tests of each packing "
     "separately."},
    {"[[target]]", "value", "a number > 0",
     "Value that the mean over packings should reach, in the figure's unit; required."},
    {"[[target]]", "tolerance", "a number > 0 and < 1",
     "Allowed deviation of the mean, as a fraction of the value; 0.05 by default."},
    {"[[target]]", "error", "a number >= 0 and < 1",
     "Standard error of the measured value, as a fraction of the value; 0 by default."},
    {"[[free]]", "key", "a key of a case", "Key of the cases whose value is to be calibrated; required."},
    {"[[free]]", "of", "another free key",
     "If given, the ratio of `key` to this key is calibrated, for example cohesion divided by tensile strength."},
    {"[[free]]", "from", "a number",
     "Lower bound; required. If it is above 0, the search uses a logarithmic scale, otherwise a linear one."},
    {"[[free]]", "to", "a number > from", "Upper bound; required."},
    {"[[free]]", "start", "a number between from and to",
     "Value at which the search starts; by default, an estimate from the targets or, if there is none, the middle of "
     "the bounds."},
    {"[[curve]]", "test", "the name of a test",
     "Test to which the measured curve belongs; required if there are several tests."},
    {"[[curve]]", "file", "a file", "CSV with columns axial_strain and axial_stress; required."},
    {"[packings]", "fit", "a whole number, 4 to 10000",
     "Number of packings tested at each point of the search; 8 by default."},
    {"[packings]", "polish", "a whole number, from the value of fit to 10000",
     "Number of packings used for the last correction; 40 by default."},
    {"[packings]", "fresh", "a whole number, 4 to 10000",
     "Number of fresh packings on which the result is judged; 20 by default."},
    {"[packings]", "first_seed", "a whole number >= 0", "Seed of the first packing; 1 by default."},
    {"[run]", "time_limit", "a number > 0 in s",
     "Longest wall-clock time allowed for a test; a test that takes longer is stopped and reported."},
};
constexpr std::size_t most_free_keys = 8;

std::size_t test_named(const Rock& rock, const KeyedTable& table, const char* key, const std::string& name) {
    const auto at =
        std::find_if(rock.tests.begin(), rock.tests.end(), [&](const auto& one) { return one.name == name; });
    if (at == rock.tests.end()) {
        std::vector<std::string> names;
        names.reserve(rock.tests.size());
        for (const PlannedTest& test : rock.tests) names.push_back(test.name);
        table.refuse(key, fmt::format("\"{:.40}\"", name), fmt::format("one of {}", fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(at - rock.tests.begin());
}

std::size_t test_of(const Rock& rock, const KeyedTable& table) {
    const std::optional<std::string> name = table.text("test");
    if (!name && rock.tests.size() == 1) return 0;
    if (!name) table.refuse("test", "nothing");
    return test_named(rock, table, "test", *name);
}

double share(const KeyedTable& table, const char* key, double otherwise, bool zero) {
    const std::optional<double> found = table.number(key);
    if (found && (*found < 0.0 || *found >= 1.0 || (!zero && *found == 0.0))) table.refuse(key, shown(*table.get(key)));
    return found.value_or(otherwise);
}

void require_summary_figure(const KeyedTable& table, const char* key, const std::string& asked) {
    if (std::ranges::find(summary_keys(), without_suffix(asked), &SummaryKey::name) == summary_keys().end())
        table.refuse(key, fmt::format("\"{:.60}\"", asked), "a figure of summary.json such as peak_stress");
}

constexpr const char* law_figures[]{"friction_angle", "hoek_brown_m"};
bool is_of_law(const std::string& figure) { return std::ranges::find(law_figures, figure) != std::end(law_figures); }

/// The tests to which a law is fitted. Their pressures are checked in judge_laws(), when the cases are complete.
std::vector<std::size_t> law_tests(const Rock& rock, const KeyedTable& table) {
    std::vector<std::size_t> tests;
    for (const std::string& name : table.texts("tests")) {
        const std::size_t test = test_named(rock, table, "tests", name);
        if (std::ranges::find(tests, test) != tests.end())
            table.refuse("tests", fmt::format("\"{:.40}\" twice", name), "each test once");
        tests.push_back(test);
    }
    return tests;
}

Target read_target(const Rock& rock, const KeyedTable& table) {
    Target target;
    target.where = table.where("figure");
    const std::optional<std::string> figure = table.text("figure");
    if (!figure) table.refuse("figure", "nothing");
    target.figure = *figure;
    target.over = table.text("over").value_or("");
    target.tests = law_tests(rock, table);
    if (is_of_law(target.figure) != target.of_law()) {
        if (target.of_law())
            table.refuse("figure", fmt::format("\"{:.60}\" of several tests", *figure),
                         fmt::format("one of {}", fmt::join(law_figures, ", ")));
        table.refuse("tests", "nothing", fmt::format("the compression tests to which {} is fitted", *figure));
    }
    if (target.of_law()) {
        target.test = target.tests.front();
        for (const char* key : {"test", "over"})
            if (table.text(key)) table.refuse(key, "this key together with tests", "only one of the two");
    } else {
        target.test = test_of(rock, table);
        require_summary_figure(table, "figure", target.figure);
    }
    if (!target.over.empty()) {
        require_summary_figure(table, "over", target.over);
        if (target.over == target.figure) table.refuse("over", "the figure itself", "another one");
    }
    for (const Target& other : rock.targets)
        if (other.test == target.test && other.tests == target.tests && other.quantity() == target.quantity())
            table.refuse("figure", fmt::format("{} twice", target.quantity()), "one [[target]] per figure of a test");
    const std::optional<double> value = table.positive("value");
    if (!value) table.refuse("value", "nothing");
    target.value = *value;
    target.tolerance = share(table, "tolerance", target.tolerance, false);
    target.error = share(table, "error", 0.0, true);
    return target;
}

FreeKey read_free(const Rock& rock, const KeyedTable& table) {
    const auto [key, parameter] = read_case_key(table);
    if (parameter->kind != ValueKind::real)
        table.refuse("key", fmt::format("\"{:.40}\"", key), "a key with a numeric value");
    for (const char* other : {"numerics.", "output.", "loading."})
        if (key.starts_with(other))
            table.refuse("key", fmt::format("\"{}\"", key), "a key that describes the rock, not how it is tested");
    FreeKey free;
    free.key = key;
    for (const PlannedTest& test : rock.tests)
        for (const CaseSetting& setting : test.settings)
            if (setting.key == key)
                table.refuse("key", fmt::format("{}, to which `set` of test {} also gives a value", key, test.name),
                             "a key that is either free or in `set`, not both");
    free.where = table.where("key");
    for (const FreeKey& other : rock.free)
        if (other.key == free.key) table.refuse("key", fmt::format("{} twice", key), "one [[free]] per key");
    free.of = table.text("of").value_or("");
    if (!free.of.empty() && std::none_of(rock.free.begin(), rock.free.end(), [&](const FreeKey& other) {
            return other.key == free.of && other.of.empty();
        }))
        table.refuse("of", fmt::format("\"{:.40}\"", free.of), "the key of an earlier [[free]] table");
    const std::optional<double> from = table.number("from"), to = table.number("to"), start = table.number("start");
    if (!from || !to) table.refuse(from ? "to" : "from", "nothing");
    if (!(*to > *from)) table.refuse("to", shown(*table.get("to")));
    free.from = *from;
    free.to = *to;
    const double middle = 0.5 * (free.to_variable(*from) + free.to_variable(*to));
    free.start = start.value_or(free.to_value(middle));
    free.start_given = start.has_value();
    if (free.start < *from || free.start > *to) table.refuse("start", shown(*table.get("start")));
    return free;
}

/// Checks every combination of bounds in every test. If all are valid, so are all values between the bounds.
void judge_bounds(const Rock& rock) {
    for (std::size_t corner = 0; corner < std::size_t{1} << rock.free.size(); ++corner) {
        std::vector<double> values;
        std::string at;
        for (std::size_t k = 0; k < rock.free.size(); ++k) {
            values.push_back((corner >> k & 1U) == 0 ? rock.free[k].from : rock.free[k].to);
            at += fmt::format("{}{} = {:g}", k == 0 ? "" : ", ", rock.free[k].name(), values.back());
        }
        for (std::size_t test = 0; test < rock.tests.size(); ++test) {
            try {
                (void)rock.case_of(test, values);
            } catch (const InputError& error) {
                throw InputError(
                    fmt::format("{} (test {} at {}, a corner of the bounds)", error.what(), rock.tests[test].name, at));
            }
        }
    }
}

/// Checks that each law is fitted to compression tests under several pressures.
void judge_laws(const Rock& rock) {
    std::vector<double> start;
    start.reserve(rock.free.size());
    for (const FreeKey& free : rock.free) start.push_back(free.start);
    for (const Target& target : rock.targets) {
        std::set<double> pressures;
        for (const std::size_t test : target.tests) {
            const ResolvedCase of = rock.case_of(test, start);
            if (test_kind(of.loading.kind).pulls()) {
                throw InputError(
                    fmt::format("{}: [[target]] tests: found {}, a tension test, expected compression tests",
                                target.where, rock.tests[test].name));
            }
            pressures.insert(of.pressure());
        }
        if (target.of_law() && pressures.size() < fewest_confinements) {
            throw InputError(fmt::format("{}: [[target]] tests: found {} confining pressures, expected {} or more",
                                         target.where, pressures.size(), fewest_confinements));
        }
    }
}

}  // namespace

std::string Target::source(const std::vector<PlannedTest>& all) const {
    if (!of_law()) return all[test].name;
    std::string names;
    for (const std::size_t one : tests) names += (names.empty() ? "" : ", ") + all[one].name;
    return names;
}

std::string Target::unit(bool area_units) const {
    if (of_law()) return figure == "friction_angle" ? "deg" : "";
    return over.empty() ? unit_of_figure(figure, area_units) : "";
}

double FreeKey::to_variable(double value) const { return logarithmic() ? std::log(value) : value / scale(); }
double FreeKey::to_value(double variable) const {
    return std::clamp(logarithmic() ? std::exp(variable) : variable * scale(), from, to);
}

std::vector<CaseSetting> Rock::settings(std::span<const double> values) const {
    std::vector<CaseSetting> all;
    for (std::size_t k = 0; k < free.size(); ++k) {
        double value = values[k];
        if (!free[k].of.empty()) {
            const auto base =
                std::find_if(free.begin(), free.end(), [&](const auto& one) { return one.key == free[k].of; });
            value *= values[static_cast<std::size_t>(base - free.begin())];
        }
        all.push_back({free[k].key, value, free[k].where});
    }
    return all;
}

ResolvedCase Rock::case_of(std::size_t test, std::span<const double> values) const {
    std::vector<CaseSetting> all = tests[test].settings;
    for (CaseSetting& setting : settings(values)) all.push_back(std::move(setting));
    return tests[test].files.with(all);
}

Rock read_rock(const fs::path& path) {
    const KeyedFile file(path, "a rock to be calibrated", rock_keys);
    Rock rock;
    rock.file = path;
    rock.text = read_text(path, most_bytes_of_keys);
    rock.title = file.top().text("title").value_or(path.stem().string());
    rock.tests = read_planned_tests(file);
    for (const KeyedTable& table : file.tables("target")) rock.targets.push_back(read_target(rock, table));
    if (rock.targets.empty())
        throw InputError(fmt::format("{}: found no [[target]], expected one or more", path.string()));
    for (const KeyedTable& table : file.tables("free")) {
        if (rock.free.size() == most_free_keys)
            table.refuse("key", "another free key", fmt::format("at most {} free keys", most_free_keys));
        rock.free.push_back(read_free(rock, table));
    }
    if (rock.free.empty()) throw InputError(fmt::format("{}: found no [[free]], expected one or more", path.string()));
    for (const KeyedTable& table : file.tables("curve")) {
        MeasuredCurve curve;
        curve.test = test_of(rock, table);
        const std::optional<std::string> name = table.text("file");
        if (!name) table.refuse("file", "nothing");
        curve.file = (path.parent_path() / *name).lexically_normal();
        if (!is_file(curve.file)) table.refuse("file", fmt::format("no file {:.200}", curve.file.string()));
        try {
            curve.points = read_measured_curve(curve.file);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: [[curve]] file: {}", table.where("file"), error.what()));
        }
        rock.curves.push_back(curve);
    }
    const KeyedTable packings = file.table("packings");
    constexpr std::int64_t fewest = 4, most = 10'000;
    rock.fit = packings.whole("fit", fewest, most).value_or(rock.fit);
    rock.polish = packings.whole("polish", rock.fit, most).value_or(std::max(rock.fit, rock.polish));
    rock.fresh = packings.whole("fresh", fewest, most).value_or(rock.fresh);
    rock.first_seed = packings.whole("first_seed", 0).value_or(rock.first_seed);
    rock.time_limit = file.table("run").positive("time_limit").value_or(0.0);
    judge_bounds(rock);
    judge_laws(rock);
    return rock;
}

std::string describe_rock_keys() { return describe_declared_keys(rock_keys); }

}  // namespace crackle
