// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a plan with toml++.
#include "specimens/campaign/plan_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/keyed_table.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/case/toml_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr DeclaredKey plan_keys[]{
    {"", "title", "a text", "Title of the campaign."},
    {"[[test]]", "case", "a file", "Case of `crackle test`, relative to the plan; required."},
    {"[[test]]", "name", "a text", "Name of the test; by default, the case's file name."},
    {"[[test]]", "set", "a table",
     "Keys of the case that are given other values, for example set = {\"loading.max_axial_strain\" = 0.02}."},
    {"[[axis]]", "key", "a key of a case", "\"material.cohesion\", \"mineral[2].cohesion\"; required."},
    {"[[axis]]", "values", "a list", "Values of the axis; alternatively, give from and to."},
    {"[[axis]]", "from", "a number", "First value; `to` is then required as well."},
    {"[[axis]]", "to", "a number", "Last value."},
    {"[[axis]]", "count", "a whole number, 2 to ten million",
     "Number of values from `from` to `to`; without it, the axis is one of the axes of [design]."},
    {"[[axis]]", "spacing", "\"linear\" or \"logarithmic\"",
     "Spacing of the values between `from` and `to`; linear by default."},
    {"[[axis]]", "tests", "a list of names", "The tests to which the axis applies; all by default."},
    {"[design]", "points", "a whole number, 1 to ten million",
     "Number of points, which are spread evenly over the ranges of all axes that have no count."},
    {"[design]", "sequence", "\"sobol\" or \"halton\"",
     "Low-discrepancy sequence from which the points are taken; sobol by default."},
    {"[packings]", "count", "a whole number >= 1",
     "Number of packings tested at every point, with the same seeds at all points; 1 by default."},
    {"[packings]", "first_seed", "a whole number >= 0",
     "Seed of the first packing; the next packings have consecutive seeds. 1 by default."},
    {"[run]", "keep", "\"figures\", \"curves\" or \"all\"",
     "Files of each test to keep in addition to the ledger: none (figures), curve.csv (curves) or all files (all); "
     "figures by default."},
    {"[run]", "time_limit", "a number > 0 in s",
     "Longest wall-clock time allowed for a test; a test that takes longer is stopped and reported."},
};

PlannedTest read_test(const fs::path& file, const KeyedTable& table) {
    const std::optional<std::string> written = table.text("case");
    if (!written) table.refuse("case", "nothing", "a case of `crackle test`; add it to [[test]]");
    const fs::path path = (file.parent_path() / *written).lexically_normal();
    if (!is_file(path))
        table.refuse("case", fmt::format("no file {:.200}", path.string()), "a case of `crackle test`; check the path");
    PlannedTest test{table.text("name").value_or(path.stem().string()), path, {}, CaseFiles(path)};
    if (const toml::node* set = table.get("set")) {
        if (!set->is_table()) table.refuse("set", kind_name(*set));
        for (const auto& [key, node] : *set->as_table()) {
            if (!node.is_table()) {
                test.settings.push_back({std::string(key.str()), table.case_value("set", node), line_of(file, node)});
                continue;
            }
            // An unquoted key, such as loading.kind = …, is parsed as nested tables.
            for (const auto& [inner, value] : *node.as_table())
                test.settings.push_back({fmt::format("{}.{}", key.str(), inner.str()), table.case_value("set", value),
                                         line_of(file, value)});
        }
    }
    return test;
}

Axis read_axis(const KeyedTable& table, std::int64_t most_values) {
    Axis axis;
    const auto [key, parameter] = read_case_key(table);
    const Parameter& p = *parameter;
    axis.key = key;
    axis.where = table.where("key");
    axis.whole = p.kind == ValueKind::integer;
    axis.tests = table.texts("tests");
    const toml::node* values = table.get("values");
    const std::optional<double> from = table.number("from"), to = table.number("to");
    const std::optional<std::int64_t> count = table.whole("count", 2, most_values);
    axis.spacing = table.choice<Spacing>("spacing");
    if (values != nullptr) {
        if (from || to || count)
            table.refuse(from ? "from" : to ? "to" : "count", "this key together with values", "only one of the two");
        const toml::array* list = values->as_array();
        if (list == nullptr || list->empty()) table.refuse("values", list == nullptr ? kind_name(*values) : "none");
        for (const toml::node& node : *list) axis.values.push_back(table.case_value("values", node));
        return axis;
    }
    if (!from || !to) table.refuse(from ? "to" : "from", "nothing", "values, or from and to; add them to [[axis]]");
    if (p.kind != ValueKind::real && p.kind != ValueKind::integer)
        table.refuse("from", "a range for a key whose values are not numbers", "values");
    if (*from == *to)
        table.refuse("to", fmt::format("{}, the same as `from`", *to), "a number that differs from `from`");
    if (axis.spacing == Spacing::logarithmic && !(*from > 0.0 && *to > 0.0))
        table.refuse("from", fmt::format("{} to {}", *from, *to), "numbers > 0 with logarithmic spacing");
    axis.from = *from;
    axis.to = *to;
    if (count) axis.values = spaced_values(axis, *count);
    return axis;
}

void check_names(const Plan& plan) {
    std::set<std::string> names, keys;
    for (const PlannedTest& test : plan.tests) names.insert(test.name);
    for (const Axis& axis : plan.axes) {
        for (const std::string& test : axis.tests) {
            if (!names.contains(test))
                throw InputError(fmt::format("{}: [[axis]] tests: found {:.40}, expected one of {}", axis.where, test,
                                             fmt::join(names, ", ")));
        }
        if (!keys.insert(axis.key).second)
            throw InputError(
                fmt::format("{}: [[axis]] key: found {:.40} twice, expected one axis per key", axis.where, axis.key));
    }
}

}  // namespace

std::pair<std::string, const Parameter*> read_case_key(const KeyedTable& table) {
    const std::optional<std::string> key = table.text("key");
    if (!key) table.refuse("key", "nothing");
    const std::size_t dot = key->find('.');
    const std::string name = dot == std::string::npos ? "" : key->substr(0, key->find('['));
    const std::string of = name.substr(0, name.find('.'));
    const Parameter* p = find_parameter(of, dot == std::string::npos ? *key : key->substr(dot + 1));
    if (p == nullptr)
        table.refuse("key", fmt::format("\"{:.40}\"", *key), "a key of a case; `crackle test --keys` lists them");
    return {*key, p};
}

std::vector<PlannedTest> read_planned_tests(const KeyedFile& file) {
    std::vector<PlannedTest> tests;
    std::set<std::string> names;
    for (const KeyedTable& table : file.tables("test")) {
        tests.push_back(read_test(file.path(), table));
        const std::string& name = tests.back().name;
        if (name.find('/') != std::string::npos || name.front() == '.')
            table.refuse("name", fmt::format("\"{:.40}\"", name), "a name without / that does not begin with a dot");
        if (!names.insert(tests.back().name).second)
            throw InputError(fmt::format("{}: found two tests called {:.40}, expected different names",
                                         file.path().string(), tests.back().name));
    }
    if (tests.empty())
        throw InputError(
            fmt::format("{}: found no [[test]], expected one or more, each with a case", file.path().string()));
    return tests;
}

Plan read_plan(const fs::path& path, bool with_companions, std::int64_t most_rows) {
    const KeyedFile file(path, "a plan of a campaign", plan_keys);
    Plan plan;
    plan.file = path;
    plan.text = read_text(path, most_bytes_of_keys);
    plan.title = file.top().text("title").value_or(path.stem().string());
    plan.tests = read_planned_tests(file);
    DesignRequest design;
    const KeyedTable design_table = file.table("design");
    design.sequence = design_table.choice<Sequence>("sequence");
    const auto points = design_table.whole("points", 1, most_rows);
    design.points = static_cast<std::size_t>(points.value_or(0));
    std::size_t of_design = 0;
    for (const KeyedTable& table : file.tables("axis")) {
        plan.axes.push_back(read_axis(table, most_rows));
        if (!plan.axes.back().of_design()) continue;
        if (design.points == 0) table.refuse("from", "from and to without count", "count, or points in [design]");
        if (++of_design > most_design_axes)
            table.refuse("key", fmt::format("axis number {} of the design", of_design),
                         fmt::format("at most {}", most_design_axes));
    }
    if (design.points > 0 && of_design == 0)
        design_table.refuse("points", "no axis of the design", "an [[axis]] with from and to, without count");
    const KeyedTable packings = file.table("packings");
    plan.own_seeds = !file.has("packings");
    plan.packings = packings.whole("count", 1).value_or(1);
    plan.first_seed = packings.whole("first_seed", 0).value_or(1);
    const KeyedTable run = file.table("run");
    plan.keep = run.choice<Keep>("keep");
    plan.time_limit = run.positive("time_limit").value_or(0.0);
    check_names(plan);
    expand(plan, design, with_companions, most_rows);
    return plan;
}

std::string describe_plan_keys() { return describe_declared_keys(plan_keys); }

}  // namespace crackle
