// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/outcome_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/files/text_table.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const MeanFigure& mean) {
    return {{"packings", mean.count},
            {"mean", mean.mean},
            {"deviation", mean.deviation},
            {"standard_error", mean.standard_error},
            {"interval", {mean.low, mean.high}}};
}

/// Name of a target as used in sentences.
std::string target_name(const Rock& rock, std::size_t k) {
    return fmt::format("{} of {}", rock.targets[k].quantity(), rock.targets[k].source(rock.tests));
}

std::string percent(double share) { return fmt::format("{:+.1f} %", 100.0 * share); }

std::string keys_at_bounds(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text;
    for (std::size_t f = 0; f < rock.free.size(); ++f)
        if (outcome.keys[f].at_bound)
            text += fmt::format("{}{} = {:.4g}", text.empty() ? "" : ", ", rock.free[f].name(), outcome.keys[f].value);
    return text;
}

/// Describes targets that were not reached, and possible compromises.
std::string frontier_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text, names;
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const ReachedTarget& reached = outcome.targets[k];
        if (reached.verdict == TargetVerdict::not_found)
            text += fmt::format(
                "\n{} = {:.4g} was not reached: the search stopped at {:.4g} ± {:.2g}; change `start` in "
                "[[free]]\n",
                target_name(rock, k), rock.targets[k].value, reached.fresh.mean, reached.fresh.standard_error);
        if (reached.verdict != TargetVerdict::out_of_reach) continue;
        const std::string bounds = keys_at_bounds(rock, outcome);
        text += fmt::format(
            "\n{} = {:.4g} cannot be met together with the other targets; the nearest value reached is {:.4g} ± "
            "{:.2g}{}\n",
            target_name(rock, k), rock.targets[k].value, reached.fresh.mean, reached.fresh.standard_error,
            bounds.empty() ? "" : fmt::format(", at which these keys are at their bounds: {}", bounds));
    }
    if (outcome.frontier.empty()) return text;
    text += fmt::format(
        "\npossible compromises for {} (each value is the mean over the packings used for fitting ± its standard "
        "error):\n",
        target_name(rock, outcome.frontier_of));
    for (const FrontierPoint& point : outcome.frontier) {
        std::string line, keys;
        for (std::size_t t = 0; t < rock.targets.size(); ++t) {
            const MeanFigure& mean = point.figures[t];
            line += fmt::format("{}{} {:.4g} ± {:.1g} ({})", t == 0 ? "" : ", ", target_name(rock, t), mean.mean,
                                mean.standard_error, percent(mean.mean / rock.targets[t].value - 1.0));
        }
        for (std::size_t f = 0; f < rock.free.size(); ++f)
            keys += fmt::format("{}{} = {:.4g}", f == 0 ? "" : ", ", rock.free[f].name(), point.values[f]);
        text += fmt::format("  - {}\n    at {}\n", line, keys);
    }
    return text;
}

/// Describes packings that are left out of all means, and targets that were judged by the scatter between packings
/// because it exceeds the tolerance.
std::string packings_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text;
    const auto complete = static_cast<std::int64_t>(outcome.targets.front().fresh.count);
    if (complete < rock.fresh)
        text += fmt::format(
            "\n{} of {} fresh packings have all targets' figures: the others went wrong, or did not fail "
            "before loading.max_axial_strain, so the means cover only the weaker ones; `crackle campaign show "
            "DIR/fresh` lists them\n",
            complete, rock.fresh);
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const Target& target = rock.targets[k];
        const ReachedTarget& reached = outcome.targets[k];
        if (reached.without_peak > 0)
            text += fmt::format(
                "\n{}: {} of {} fresh packings have no peak, since their stress was still increasing at "
                "loading.max_axial_strain, and are left out; largest_stress, the largest stress up to that strain, is "
                "a figure of every test\n",
                target_name(rock, k), reached.without_peak, rock.fresh);
        if (reached.limit <= target.tolerance || std::abs(reached.off) > reached.limit) continue;
        // The half-width is about two standard errors of a difference between means over equal numbers of packings.
        const double wanted = 2.0 * packings_for(reached.fresh.deviation, 0.5 * target.tolerance * target.value);
        text += fmt::format(
            "\n{}: the scatter of {} fresh packings and of the {} of the last correction leaves an error of ±{:.2f} %, "
            "more than the tolerance of {:.2f} %; {} of each would reduce it to the tolerance\n",
            target_name(rock, k), reached.fresh.count, reached.polish.count, 100.0 * reached.limit,
            100.0 * target.tolerance, wanted > 1e4 ? "more than 10,000" : fmt::format("{:.0f}", wanted));
    }
    return text;
}

std::string directions_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text;
    for (const FreeDirection& direction : outcome.undetermined) {
        std::string keys;
        for (std::size_t f = 0; f < rock.free.size(); ++f) {
            const double factor = direction.factors[f];
            const bool ratio = rock.free[f].logarithmic();
            if (std::abs(ratio ? std::log(factor) : factor) < 0.03) continue;
            keys += fmt::format(
                "{}{} {}", keys.empty() ? "" : ", ", rock.free[f].name(),
                ratio ? fmt::format("times {:.2f}", factor) : fmt::format("{:+.3g}", factor * rock.free[f].scale()));
        }
        text += fmt::format(
            "\nnot determined by the targets: the combined change {} shifts no target by more than {:.2g} of its "
            "tolerance; only an additional target can determine these keys\n",
            keys, direction.change);
    }
    for (std::size_t f = 0; f < rock.free.size(); ++f) {
        if (!outcome.keys[f].lost_in_scatter) continue;
        text += fmt::format(
            "\nnot determined by these packings: their scatter allows {} to have any value between its bounds, {:.4g} "
            "and {:.4g}; use a larger polish in [packings], or another target\n",
            rock.free[f].name(), rock.free[f].from, rock.free[f].to);
    }
    return text;
}

}  // namespace

Json calibration_json(const Rock& rock, const CalibrationOutcome& outcome) {
    Json all;
    all["title"] = rock.title;
    all["reached"] = outcome.all_reached();
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const Target& target = rock.targets[k];
        const ReachedTarget& reached = outcome.targets[k];
        all["targets"].push_back({{"test", target.source(rock.tests)},
                                  {"figure", target.quantity()},
                                  {"value", target.value},
                                  {"tolerance", target.tolerance},
                                  {"error", target.error},
                                  {"fresh", json_of(reached.fresh)},
                                  {"polish", json_of(reached.polish)},
                                  {"off", reached.off},
                                  {"limit", reached.limit},
                                  {"without_peak", reached.without_peak},
                                  {"verdict", name_of(reached.verdict)}});
    }
    for (std::size_t k = 0; k < rock.free.size(); ++k) {
        const FoundKey& key = outcome.keys[k];
        all["keys"].push_back({{"key", rock.free[k].key},
                               {"of", rock.free[k].of},
                               {"value", key.value},
                               {"interval", {key.low, key.high}},
                               {"determined", key.determined},
                               {"at_bound", key.at_bound},
                               {"from", rock.free[k].from},
                               {"to", rock.free[k].to}});
    }
    all["undetermined"] = Json::array();
    for (const FreeDirection& direction : outcome.undetermined) {
        Json step;
        for (std::size_t f = 0; f < rock.free.size(); ++f) {
            if (rock.free[f].logarithmic())
                step[rock.free[f].name()]["times"] = direction.factors[f];
            else
                step[rock.free[f].name()]["plus"] = direction.factors[f] * rock.free[f].scale();
        }
        all["undetermined"].push_back({{"step", step}, {"change", direction.change}});
    }
    all["surfaces"] = Json::array();
    for (const SurfaceQuality& surface : outcome.surfaces)
        all["surfaces"].push_back(
            {{"target", surface.target}, {"quadratic", surface.quadratic}, {"left_out_error", surface.left_out_error}});
    all["frontier_of"] = outcome.frontier.empty() ? Json() : Json(outcome.frontier_of);
    all["frontier"] = Json::array();
    for (const FrontierPoint& point : outcome.frontier) {
        Json figures;
        for (const MeanFigure& mean : point.figures) figures.push_back(json_of(mean));
        all["frontier"].push_back({{"weight", point.weight}, {"values", point.values}, {"figures", figures}});
    }
    for (std::size_t k = 0; k < outcome.tried.size(); ++k)
        all["tried"].push_back({{"values", outcome.tried[k]}, {"means", outcome.tried_means[k]}});
    all["rounds"] = outcome.rounds;
    all["tests"] = outcome.tests;
    all["linear_solves"] = outcome.linear_solves;
    all["processor_seconds"] = outcome.processor_seconds;
    return all;
}

std::string calibration_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text = fmt::format("{}: {} of {} reached on {}\n", rock.title,
                                   std::count_if(outcome.targets.begin(), outcome.targets.end(),
                                                 [](const ReachedTarget& one) { return one.reached(); }),
                                   counted(outcome.targets.size(), "target"),
                                   counted(outcome.targets.front().fresh.count, "fresh packing"));
    TextTable targets("<>>>>>><");
    targets.add({"target", "value", "mean", "± error", "scatter", "off", "allowed"});
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const ReachedTarget& reached = outcome.targets[k];
        const bool area = rock.case_of(rock.targets[k].test, outcome.values()).area_units();
        const std::string unit = rock.targets[k].unit(area);
        targets.add({fmt::format("{}{}{}", target_name(rock, k), unit.empty() ? "" : ", ", unit),
                     fmt::format("{:.4g}", rock.targets[k].value), fmt::format("{:.4g}", reached.fresh.mean),
                     fmt::format("{:.2g}", reached.fresh.standard_error),
                     fmt::format("{:.2g}", reached.fresh.deviation), percent(reached.off),
                     fmt::format("{:.1f} %", 100.0 * reached.limit), name_of(reached.verdict)});
    }
    TextTable keys("<>><");
    keys.add({"key", "value", "95 % interval"});
    for (std::size_t k = 0; k < rock.free.size(); ++k) {
        const FoundKey& key = outcome.keys[k];
        const bool cut = key.low <= rock.free[k].from || key.high >= rock.free[k].to;
        keys.add({rock.free[k].name(), fmt::format("{:.5g}", key.value),
                  key.determined ? fmt::format("{:.4g} to {:.4g}{}", key.low, key.high, cut ? " (cut)" : "")
                                 : "not determined",
                  key.at_bound ? "at its bound" : ""});
    }
    text += targets.text() + keys.text() + calibration_remarks(rock, outcome);
    text += fmt::format("\n{}, {} ({:.0f} s of a processor), {}\n", counted(std::int64_t{outcome.rounds}, "round"),
                        counted(outcome.tests, "test"), outcome.processor_seconds,
                        counted(outcome.linear_solves, "linear solve"));
    return text;
}

std::string calibration_remarks(const Rock& rock, const CalibrationOutcome& outcome) {
    return frontier_text(rock, outcome) + directions_text(rock, outcome) + packings_text(rock, outcome);
}

std::string found_keys_toml(const Rock& rock, const CalibrationOutcome& outcome) {
    // Tables appear in the order of their first key. Entries of a list such as [[mineral]] are written as comments,
    // because a case must give the list as a whole.
    std::vector<std::pair<std::string, std::string>> tables;
    std::string listed;
    const std::vector<CaseSetting> settings = rock.settings(outcome.values());
    for (std::size_t k = 0; k < settings.size(); ++k) {
        const std::size_t dot = settings[k].key.rfind('.');
        const std::string table = settings[k].key.substr(0, dot), key = settings[k].key.substr(dot + 1);
        const FoundKey& found = outcome.keys[k];
        std::string remark = rock.free[k].of.empty() ? ""
                                                     : fmt::format("{:.5g} times {}{}", found.value, rock.free[k].of,
                                                                   found.determined ? ", ratio " : "");
        if (!found.determined)
            remark += remark.empty() ? "not determined by the targets" : ", not determined by the targets";
        else
            remark += fmt::format("95 %: {:.4g} to {:.4g}", found.low, found.high);
        if (found.at_bound) remark += ", at its bound";
        const double value = std::get<double>(settings[k].value);
        if (table.find('[') != std::string::npos) {
            listed += fmt::format("# {} = {}  # {}\n", settings[k].key, value, remark);
            continue;
        }
        auto at = std::find_if(tables.begin(), tables.end(), [&](const auto& one) { return one.first == table; });
        if (at == tables.end()) at = tables.insert(tables.end(), {table, ""});
        at->second += fmt::format("{} = {}  # {}\n", key, value, remark);
    }
    std::string text;
    for (const auto& [table, lines] : tables) text += fmt::format("[{}]\n{}", table, lines);
    return text + listed;
}

namespace {

/// Names of tests that an earlier calibration wrote to this folder; empty if its file does not list them.
std::set<std::string> tests_before(const std::filesystem::path& file) {
    std::set<std::string> names;
    if (!is_file(file)) return names;
    const Json earlier = Json::parse(read_file(file), nullptr, false);
    const Json targets = earlier.is_object() ? earlier.value("targets", Json::array()) : Json::array();
    for (const Json& target : targets) {
        if (!target.is_object() || !target.contains("test") || !target["test"].is_string()) continue;
        std::istringstream listed(target["test"].get<std::string>());
        for (std::string name; std::getline(listed >> std::ws, name, ',');)
            if (std::filesystem::path(name).filename() == name) names.insert(name);
    }
    return names;
}

}  // namespace

void write_calibration(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder) {
    const std::vector<double> values = outcome.values();
    const std::filesystem::path cases = folder / "cases";
    make_folder(cases);
    std::set<std::filesystem::path> written;
    for (std::size_t test = 0; test < rock.tests.size(); ++test) {
        std::ostringstream out;
        write_resolved_case(out, rock.case_of(test, values), cases);
        written.insert(cases / (rock.tests[test].name + ".toml"));
        replace_file(cases / (rock.tests[test].name + ".toml"), out.str());
    }
    for (const std::string& name : tests_before(folder / "calibration.json"))
        if (const std::filesystem::path file = cases / (name + ".toml"); !written.contains(file))
            std::filesystem::remove(file);
    replace_file(folder / "rock.toml", fmt::format("# {}: keys found by `crackle calibrate`; calibration.txt "
                                                   "lists the results they reach.\n{}",
                                                   rock.title, found_keys_toml(rock, outcome)));
    replace_file(folder / "calibration.json",
                 calibration_json(rock, outcome).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    replace_file(folder / "calibration.txt", calibration_text(rock, outcome));
}

}  // namespace crackle
