// SPDX-License-Identifier: GPL-3.0-or-later
// Derives the points and rows of a plan that plan_file.cpp has read.
#include "specimens/campaign/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

bool is_for(const Axis& axis, const PlannedTest& test) {
    return axis.tests.empty() || std::find(axis.tests.begin(), axis.tests.end(), test.name) != axis.tests.end();
}

/// Adds all combinations of one test's axes. The last grid axis changes fastest and the design slowest.
void add_points(Plan& plan, std::size_t test, const std::vector<std::vector<double>>& design) {
    PlanPoint point;
    point.test = test;
    std::size_t design_axes = 0, combinations = 1;
    for (std::size_t a = 0; a < plan.axes.size(); ++a) {
        if (!is_for(plan.axes[a], plan.tests[test])) continue;
        point.axes.push_back(a);
        if (plan.axes[a].of_design())
            ++design_axes;
        else
            combinations *= plan.axes[a].values.size();
    }
    const std::size_t designs = design_axes > 0 ? design.size() : 1;
    for (std::size_t d = 0; d < designs; ++d) {
        for (std::size_t combination = 0; combination < combinations; ++combination) {
            point.settings.clear();
            std::size_t left = combinations, rest = combination, dimension = 0;
            for (std::size_t a = 0; a < plan.axes.size(); ++a) {
                const Axis& axis = plan.axes[a];
                const std::size_t own = axis.of_design() ? dimension++ : 0;
                if (!is_for(axis, plan.tests[test])) continue;
                if (axis.of_design()) {
                    point.settings.push_back({axis.key, axis.at(design[d][own]), axis.where});
                    continue;
                }
                left /= axis.values.size();
                point.settings.push_back({axis.key, axis.values[rest / left], axis.where});
                rest %= left;
            }
            plan.points.push_back(point);
        }
    }
}

/// Names of all seed keys of a case.
std::vector<std::string> seeds_of(const ResolvedCase& test) {
    std::vector<std::string> keys;
    if (test.packing() != nullptr) keys.emplace_back("packing.seed");
    if (test.bond.random) keys.emplace_back("bond.strength_seed");
    const parts::Minerals& minerals = test.minerals;
    if (!minerals.list.empty() && std::holds_alternative<parts::RandomGrains>(minerals.assign))
        keys.emplace_back("minerals.seed");
    if (!test.joints.sets.empty()) keys.emplace_back("joints.seed");
    return keys;
}

std::vector<CaseSetting> settings_of(const Plan& plan, const PlanPoint& point) {
    std::vector<CaseSetting> settings = plan.tests[point.test].settings;
    settings.insert(settings.end(), point.settings.begin(), point.settings.end());
    return settings;
}

}  // namespace

std::string value_text(const CaseValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* pair = std::get_if<std::array<std::string, 2>>(&value))
        return fmt::format("{}-{}", (*pair)[0], (*pair)[1]);
    if (const auto* numbers = std::get_if<std::vector<double>>(&value))
        return fmt::format("{}", fmt::join(*numbers, "-"));
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
    return fmt::format("{}", std::get<double>(value));
}

ResolvedCase Plan::test_of(const PlanRow& row) const {
    const PlanPoint& point = points[row.point];
    std::vector<CaseSetting> settings = settings_of(*this, point);
    const PlannedTest& kind = tests[point.test];
    for (const std::string& key : point.seeds) settings.push_back({key, row.seed, file.string() + ":1"});
    return kind.files.with(settings, {.rate = row.variant == Variant::half_rate ? 0.5 : 1.0,
                                      .step = row.variant == Variant::half_step ? 0.5 : 1.0});
}

// Resolves the case of every point, so that errors in any case are found before the first test runs. Also stores the
// keys of the case's random seeds in the point.
void judge_points(Plan& plan) {
    for (PlanPoint& point : plan.points) {
        const PlannedTest& kind = plan.tests[point.test];
        try {
            const ResolvedCase test = kind.files.with(settings_of(plan, point));
            if (test.packing() != nullptr) point.own_seed = test.packing()->seed;
            if (plan.own_seeds) continue;
            point.seeds = seeds_of(test);
            for (const CaseSetting& setting : point.settings) {
                if (std::find(point.seeds.begin(), point.seeds.end(), setting.key) == point.seeds.end()) continue;
                throw InputError(
                    fmt::format("{}: {}: found a value together with [packings], which sets the seeds of each packing; "
                                "remove one of the two",
                                setting.where, setting.key));
            }
            if (plan.packings > 1 && point.seeds.empty()) {
                throw InputError(
                    fmt::format("{}: packings.count: found {}, expected 1: nothing in the test {} is random; add "
                                "[packing] or a strength_distribution to its case, or remove [packings]",
                                plan.file.string(), plan.packings, kind.name));
            }
        } catch (const InputError& error) {
            std::string at;
            for (const CaseSetting& s : point.settings)
                at += fmt::format("{}{} = {}", at.empty() ? "" : ", ", s.key, value_text(s.value));
            throw InputError(at.empty() ? std::string(error.what())
                                        : fmt::format("{} (test {} at {})", error.what(), kind.name, at));
        }
    }
}

void expand(Plan& plan, const DesignRequest& design, bool with_companions, std::int64_t most_rows) {
    std::size_t design_axes = 0;
    for (const Axis& axis : plan.axes) design_axes += axis.of_design() ? 1 : 0;
    double rows = 0.0;
    for (const PlannedTest& test : plan.tests) {
        double of_test = static_cast<double>(plan.packings) * (with_companions ? variants : 1);
        bool designed = false;
        for (const Axis& axis : plan.axes) {
            if (!is_for(axis, test)) continue;
            designed = designed || axis.of_design();
            if (!axis.of_design()) of_test *= static_cast<double>(axis.values.size());
        }
        rows += designed ? of_test * static_cast<double>(design.points) : of_test;
    }
    if (rows > static_cast<double>(most_rows)) {
        throw InputError(fmt::format("{}: found {:.3g} tests, expected at most {}; use fewer values or packings",
                                     plan.file.string(), rows, most_rows));
    }
    const auto shares = design_axes > 0 ? design_points(design.sequence, design.points, design_axes)
                                        : std::vector<std::vector<double>>{};
    for (std::size_t test = 0; test < plan.tests.size(); ++test) add_points(plan, test, shares);
    judge_points(plan);
    for (std::int64_t k = 0; k < plan.packings; ++k) {
        for (std::size_t point = 0; point < plan.points.size(); ++point) {
            for (int variant = 0; variant < (with_companions ? variants : 1); ++variant)
                plan.rows.push_back({point, plan.own_seeds ? plan.points[point].own_seed : plan.first_seed + k,
                                     static_cast<Variant>(variant)});
        }
    }
}

}  // namespace crackle
