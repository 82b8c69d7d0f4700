// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a plan with toml++.
#include "specimens/campaign/plan_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/case/toml_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

struct PlanKey {
    const char *table, *key, *expected, *sentence;
};

constexpr PlanKey plan_keys[]{
    {"", "title", "a text", "What it is about."},
    {"[[test]]", "case", "a file", "Case of `crackle test`, relative to the plan; required."},
    {"[[test]]", "name", "a text", "What its tests are called; the case's file name without one."},
    {"[[test]]", "set", "a table", "Keys of the case with other values: set = {\"loading.max_axial_strain\" = 0.02}."},
    {"[[axis]]", "key", "a key of a case", "\"material.cohesion\", \"mineral[2].cohesion\"; required."},
    {"[[axis]]", "values", "a list", "The values themselves; or:"},
    {"[[axis]]", "from", "a number", "First value, with `to`."},
    {"[[axis]]", "to", "a number", "Last value."},
    {"[[axis]]", "count", "a whole number, 2 to ten million",
     "So many from first to last; without it the axis is the design's."},
    {"[[axis]]", "spacing", "\"linear\" or \"logarithmic\"", "Of these; linear by default."},
    {"[[axis]]", "tests", "a list of names", "Tests that it is for; all by default."},
    {"[design]", "points", "a whole number, 1 to ten million", "How many fill the box of its axes."},
    {"[design]", "sequence", "\"sobol\" or \"halton\"", "How; sobol by default."},
    {"[packings]", "count", "a whole number >= 1", "Specimens of every point, the same ones for all; 1 by default."},
    {"[packings]", "first_seed", "a whole number >= 0", "Of the first; those after it count up. 1 by default."},
    {"[run]", "keep", "\"figures\", \"curves\" or \"all\"",
     "What is left of a test beside the ledger; figures by default."},
    {"[run]", "time_limit", "a number > 0 in s", "Of the wall clock a test: one that takes longer is ended, and told."},
};

/// One table of a plan, with errors that name file, line and key.
class Table {
  public:
    Table(const fs::path& file, std::string name, const toml::table& table)
        : file_(file), name_(std::move(name)), table_(table) {
        for (const auto& [key, node] : table) {
            std::vector<std::string> known;
            for (const PlanKey& one : plan_keys)
                if (name_ == one.table) known.emplace_back(one.key);
            if (name_.empty()) known.insert(known.end(), {"[[test]]", "[[axis]]", "[design]", "[packings]", "[run]"});
            const std::string word(key.str());
            const bool table_name = name_.empty() && (word == "test" || word == "axis" || word == "design" ||
                                                      word == "packings" || word == "run");
            if (!table_name && std::find(known.begin(), known.end(), word) == known.end()) {
                throw InputError(
                    fmt::format("{}: {:.40}: found an unknown key, expected one of {}; correct or remove it",
                                line_of(file_, node), label(word), fmt::join(known, ", ")));
            }
        }
    }

    std::string where(const char* key) const {
        const toml::node* node = table_.get(key);
        return node != nullptr ? line_of(file_, *node) : line_of(file_, table_);
    }
    [[noreturn]] void refuse(const char* key, const std::string& found, const std::string& expected) const {
        throw InputError(fmt::format("{}: {}: found {}, expected {}", where(key), label(key), found, expected));
    }
    /// As the list of keys describes it.
    [[noreturn]] void refuse(const char* key, const std::string& found) const {
        const auto* declared = std::find_if(std::begin(plan_keys), std::end(plan_keys), [&](const PlanKey& one) {
            return name_ == one.table && std::string(key) == one.key;
        });
        refuse(key, found, declared->expected);
    }

    const toml::node* get(const char* key) const { return table_.get(key); }
    std::optional<std::string> text(const char* key) const {
        const toml::node* node = get(key);
        if (node == nullptr) return std::nullopt;
        const auto* found = node->as_string();
        if (found == nullptr || found->get().empty()) refuse(key, shown(*node));
        return found->get();
    }
    std::optional<double> number(const char* key) const {
        const toml::node* node = get(key);
        if (node == nullptr) return std::nullopt;
        if (!node->is_number() || !std::isfinite(*node->value<double>())) refuse(key, shown(*node));
        return *node->value<double>();
    }
    std::optional<std::int64_t> whole(const char* key, std::int64_t least,
                                      std::int64_t most = 1'000'000'000'000) const {
        const toml::node* node = get(key);
        if (node == nullptr) return std::nullopt;
        const auto* found = node->as_integer();
        if (found == nullptr || found->get() < least || found->get() > most) refuse(key, shown(*node));
        return found->get();
    }
    /// The place of a word among those that a key understands; 0 where the key is not there.
    template <class Value>
    Value choice(const char* key, std::initializer_list<const char*> words) const {
        const std::optional<std::string> found = text(key);
        if (!found) return Value{};
        const auto at = std::find_if(words.begin(), words.end(), [&](const char* word) { return *found == word; });
        if (at == words.end()) refuse(key, fmt::format("\"{:.40}\"", *found));
        return static_cast<Value>(at - words.begin());
    }

  private:
    std::string label(const std::string& key) const { return name_.empty() ? key : name_ + " " + key; }

    const fs::path& file_;
    std::string name_;
    const toml::table& table_;
};

CaseValue value_of_node(const toml::node& node, const Table& table, const char* key) {
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* number = node.as_integer()) return number->get();
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* text = node.as_string()) return text->get();
    table.refuse(key, kind_name(node), "values that a key of a case can have: numbers, texts, true or false");
}

/// Entries of a list of tables; none where it is absent.
std::vector<Table> tables_of(const fs::path& file, const toml::table& plan, const char* name, const char* heading) {
    std::vector<Table> all;
    const toml::node* node = plan.get(name);
    if (node == nullptr) return all;
    const toml::array* entries = node->as_array();
    if (entries == nullptr ||
        std::any_of(entries->begin(), entries->end(), [](const toml::node& entry) { return !entry.is_table(); })) {
        throw InputError(fmt::format("{}: {}: found {}, expected a list of tables; write {} above each",
                                     line_of(file, *node), name, kind_name(*node), heading));
    }
    for (const toml::node& entry : *entries) all.emplace_back(file, heading, *entry.as_table());
    return all;
}

Table table_of(const fs::path& file, const toml::table& plan, const char* name, const toml::table& absent) {
    const toml::node* node = plan.get(name);
    const std::string heading = fmt::format("[{}]", name);
    if (node == nullptr) return {file, heading, absent};
    if (!node->is_table()) {
        throw InputError(fmt::format("{}: {}: found {}, expected a table; write {} above its keys",
                                     line_of(file, *node), name, kind_name(*node), heading));
    }
    return {file, heading, *node->as_table()};
}

PlannedTest read_test(const fs::path& file, const Table& table) {
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
                test.settings.push_back(
                    {std::string(key.str()), value_of_node(node, table, "set"), line_of(file, node)});
                continue;
            }
            // Without quotes loading.kind = … is a table of tables.
            for (const auto& [inner, value] : *node.as_table())
                test.settings.push_back({fmt::format("{}.{}", key.str(), inner.str()),
                                         value_of_node(value, table, "set"), line_of(file, value)});
        }
    }
    return test;
}

const Parameter& parameter_of(const Table& table, const std::string& key) {
    const std::size_t dot = key.find('.');
    const std::string name = dot == std::string::npos ? "" : key.substr(0, key.find('['));
    const std::string of = name.substr(0, name.find('.'));
    const Parameter* p = find_parameter(of, dot == std::string::npos ? key : key.substr(dot + 1));
    if (p == nullptr)
        table.refuse("key", fmt::format("\"{:.40}\"", key), "a key of a case; `crackle test --keys` lists them");
    return *p;
}

Axis read_axis(const Table& table, std::int64_t most_values) {
    Axis axis;
    const std::optional<std::string> key = table.text("key");
    if (!key) table.refuse("key", "nothing");
    axis.key = *key;
    axis.where = table.where("key");
    const Parameter& p = parameter_of(table, *key);
    axis.whole = p.kind == ValueKind::integer;
    if (const toml::node* tests = table.get("tests")) {
        const toml::array* names = tests->as_array();
        if (names == nullptr) table.refuse("tests", kind_name(*tests));
        for (const toml::node& name : *names) {
            if (!name.is_string()) table.refuse("tests", kind_name(name));
            axis.tests.push_back(name.as_string()->get());
        }
    }
    const toml::node* values = table.get("values");
    const std::optional<double> from = table.number("from"), to = table.number("to");
    const std::optional<std::int64_t> count = table.whole("count", 2, most_values);
    axis.spacing = table.choice<Spacing>("spacing", {"linear", "logarithmic"});
    if (values != nullptr) {
        if (from || to || count) table.refuse(from ? "from" : to ? "to" : "count", "it beside values", "one of both");
        const toml::array* list = values->as_array();
        if (list == nullptr || list->empty()) table.refuse("values", list == nullptr ? kind_name(*values) : "none");
        for (const toml::node& node : *list) axis.values.push_back(value_of_node(node, table, "values"));
        return axis;
    }
    if (!from || !to) table.refuse(from ? "to" : "from", "nothing", "values, or from and to; add them to [[axis]]");
    if (p.kind != ValueKind::real && p.kind != ValueKind::integer)
        table.refuse("from", "it for a key that has no numbers", "values");
    if (*from == *to) table.refuse("to", fmt::format("{}, as from", *to), "another number than from");
    if (axis.spacing == Spacing::logarithmic && !(*from > 0.0 && *to > 0.0))
        table.refuse("from", fmt::format("{} to {}", *from, *to), "numbers > 0 with logarithmic spacing");
    axis.from = *from;
    axis.to = *to;
    if (count) axis.values = spaced_values(axis, *count);
    return axis;
}

void check_names(const Plan& plan) {
    const std::string file = plan.file.string();
    if (plan.tests.empty())
        throw InputError(fmt::format("{}: found no [[test]], expected one or more, each with a case", file));
    std::set<std::string> names, keys;
    for (const PlannedTest& test : plan.tests) {
        if (!names.insert(test.name).second)
            throw InputError(
                fmt::format("{}: found two tests called {:.40}, expected a name for each", file, test.name));
    }
    for (const Axis& axis : plan.axes) {
        for (const std::string& test : axis.tests) {
            if (!names.contains(test))
                throw InputError(fmt::format("{}: [[axis]] tests: found {:.40}, expected one of {}", axis.where, test,
                                             fmt::join(names, ", ")));
        }
        if (!keys.insert(axis.key).second)
            throw InputError(
                fmt::format("{}: [[axis]] key: found {:.40} twice, expected one axis a key", axis.where, axis.key));
    }
}

}  // namespace

Plan read_plan(const fs::path& path, bool with_companions, std::int64_t most_rows) {
    const toml::table content = parse_toml(path, "a plan of a campaign");
    const toml::table absent;
    const Table top(path, "", content);
    Plan plan;
    plan.file = path;
    plan.text = read_text(path);
    plan.title = top.text("title").value_or(path.stem().string());
    for (const Table& table : tables_of(path, content, "test", "[[test]]"))
        plan.tests.push_back(read_test(path, table));
    DesignRequest design;
    const Table design_table = table_of(path, content, "design", absent);
    design.sequence = design_table.choice<Sequence>("sequence", {"sobol", "halton"});
    const auto points = design_table.whole("points", 1, most_rows);
    design.points = static_cast<std::size_t>(points.value_or(0));
    std::size_t of_design = 0;
    for (const Table& table : tables_of(path, content, "axis", "[[axis]]")) {
        plan.axes.push_back(read_axis(table, most_rows));
        if (!plan.axes.back().of_design()) continue;
        if (design.points == 0) table.refuse("from", "from and to without count", "count, or points in [design]");
        if (++of_design > most_design_axes)
            table.refuse("key", fmt::format("axis {} of the design", of_design),
                         fmt::format("at most {}", most_design_axes));
    }
    if (design.points > 0 && of_design == 0)
        design_table.refuse("points", "no axis for it", "an [[axis]] with from and to, without count");
    const Table packings = table_of(path, content, "packings", absent);
    plan.own_seeds = content.get("packings") == nullptr;
    plan.packings = packings.whole("count", 1).value_or(1);
    plan.first_seed = packings.whole("first_seed", 0).value_or(1);
    const Table run = table_of(path, content, "run", absent);
    plan.keep = run.choice<Keep>("keep", {"figures", "curves", "all"});
    plan.time_limit = run.number("time_limit").value_or(0.0);
    if (run.get("time_limit") != nullptr && !(plan.time_limit > 0.0))
        run.refuse("time_limit", fmt::format("{}", plan.time_limit));
    check_names(plan);
    expand(plan, design, with_companions, most_rows);
    return plan;
}

std::string describe_plan_keys() {
    std::string text, table;
    for (const PlanKey& key : plan_keys) {
        if (table != key.table) text += fmt::format("\n{}\n", table = key.table);
        text += fmt::format("  {:12} {}. {}\n", key.key, key.expected, key.sentence);
    }
    return text;
}

}  // namespace crackle
