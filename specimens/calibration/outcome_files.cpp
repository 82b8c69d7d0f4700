// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/outcome_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "solver/files/replace_file.hpp"
#include "specimens/campaign/point_table.hpp"

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

/// What a target is called in a sentence.
std::string target_name(const Rock& rock, std::size_t k) {
    return fmt::format("{} of {}", rock.targets[k].figure, rock.tests[rock.targets[k].test].name);
}

std::string percent(double share) { return fmt::format("{:+.1f} %", 100.0 * share); }

/// «peak_stress of compression = 2e8 is out of reach together with the others: …».
std::string frontier_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text;
    for (const std::size_t k : outcome.out_of_reach) {
        const ReachedTarget& reached = outcome.targets[k];
        std::string bounds;
        for (std::size_t f = 0; f < rock.free.size(); ++f)
            if (outcome.keys[f].at_bound)
                bounds += fmt::format("{}{} = {:.4g}", bounds.empty() ? "" : ", ", rock.free[f].name(),
                                      outcome.keys[f].value);
        text +=
            fmt::format("\n{} = {:.4g} is out of reach together with the other targets: nearest {:.4g} ± {:.2g}{}\n",
                        target_name(rock, k), rock.targets[k].value, reached.fresh.mean, reached.fresh.standard_error,
                        bounds.empty() ? "" : fmt::format(" ({} at the bounds)", bounds));
    }
    if (outcome.frontier.empty()) return text;
    text += "  what can be had for what (means of the fit packings ± standard error):\n";
    for (const FrontierPoint& point : outcome.frontier) {
        std::string line;
        for (std::size_t t = 0; t < rock.targets.size(); ++t) {
            const MeanFigure& mean = point.figures[t];
            line += fmt::format("{}{} {:.4g} ± {:.1g} ({})", t == 0 ? "" : ", ", target_name(rock, t), mean.mean,
                                mean.standard_error, percent(mean.mean / rock.targets[t].value - 1.0));
        }
        std::string keys;
        for (std::size_t f = 0; f < rock.free.size(); ++f)
            keys += fmt::format("{}{} = {:.4g}", f == 0 ? "" : ", ", rock.free[f].name(), point.values[f]);
        text += fmt::format("  - {}\n    at {}\n", line, keys);
    }
    return text;
}

/// Where the scatter decides and not the tolerance.
std::string scatter_text(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text;
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const Target& target = rock.targets[k];
        const ReachedTarget& reached = outcome.targets[k];
        if (reached.limit <= target.tolerance) continue;
        text += fmt::format(
            "\n{}: two standard errors of {} packings are {:.1f} %, more than the tolerance; {:.0f} fresh "
            "packings bring them down to it\n",
            target_name(rock, k), reached.fresh.count, 100.0 * reached.limit,
            packings_for(reached.fresh.deviation, 0.5 * target.tolerance * target.value));
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
            "\nnot determined by the targets: {}: together they change no target by more than {:.2g} of "
            "its tolerance; they lie where the search began, or give another target\n",
            keys, direction.change);
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
        all["targets"].push_back({{"test", rock.tests[target.test].name},
                                  {"figure", target.figure},
                                  {"value", target.value},
                                  {"tolerance", target.tolerance},
                                  {"error", target.error},
                                  {"fresh", json_of(reached.fresh)},
                                  {"polish", json_of(reached.polish)},
                                  {"deviation", reached.deviation},
                                  {"limit", reached.limit},
                                  {"reached", reached.reached},
                                  {"within_reach", reached.within_reach}});
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
        all["undetermined"].push_back({{"factors", direction.factors}, {"change", direction.change}});
    }
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
    std::string text = fmt::format("{}: {} of {} targets reached on {} fresh packings\n", rock.title,
                                   std::count_if(outcome.targets.begin(), outcome.targets.end(),
                                                 [](const ReachedTarget& one) { return one.reached; }),
                                   outcome.targets.size(), rock.fresh);
    text += fmt::format("  {:<34}{:>11}{:>11}{:>11}{:>11}{:>10}{:>9}  {}\n", "target", "value", "mean", "± error",
                        "deviation", "off", "allowed", "");
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const ReachedTarget& reached = outcome.targets[k];
        const bool area = rock.case_of(rock.targets[k].test, outcome.values()).area_units();
        const std::string unit = unit_of_figure(rock.targets[k].figure, area);
        text += fmt::format("  {:<34}{:>11.4g}{:>11.4g}{:>11.2g}{:>11.2g}{:>10}{:>7.1f} %  {}\n",
                            fmt::format("{}{}{}", target_name(rock, k), unit.empty() ? "" : ", ", unit),
                            rock.targets[k].value, reached.fresh.mean, reached.fresh.standard_error,
                            reached.fresh.deviation, percent(reached.deviation), 100.0 * reached.limit,
                            reached.reached        ? "reached"
                            : reached.within_reach ? "missed"
                                                   : "out of reach");
    }
    text += fmt::format("  {:<54}{:>12}{:>26}\n", "key", "value", "95 % interval");
    for (std::size_t k = 0; k < rock.free.size(); ++k) {
        const FoundKey& key = outcome.keys[k];
        text += fmt::format("  {:<54}{:>12.5g}{:>26}{}\n", rock.free[k].name(), key.value,
                            key.determined ? fmt::format("{:.4g} to {:.4g}", key.low, key.high) : "not determined",
                            key.at_bound ? "  at its bound" : "");
    }
    text += calibration_remarks(rock, outcome);
    text += fmt::format("\n{} rounds, {} tests ({:.0f} s of a processor), {} linear solves\n", outcome.rounds,
                        outcome.tests, outcome.processor_seconds, outcome.linear_solves);
    return text;
}

std::string calibration_remarks(const Rock& rock, const CalibrationOutcome& outcome) {
    return frontier_text(rock, outcome) + directions_text(rock, outcome) + scatter_text(rock, outcome);
}

std::string found_keys_toml(const Rock& rock, const CalibrationOutcome& outcome) {
    // By tables, in the order in which they come first; a mineral of several keeps its place in the name.
    std::vector<std::pair<std::string, std::string>> tables;
    const std::vector<CaseSetting> settings = rock.settings(outcome.values());
    for (std::size_t k = 0; k < settings.size(); ++k) {
        const std::size_t dot = settings[k].key.rfind('.');
        const std::string table = settings[k].key.substr(0, dot), key = settings[k].key.substr(dot + 1);
        auto at = std::find_if(tables.begin(), tables.end(), [&](const auto& one) { return one.first == table; });
        if (at == tables.end()) at = tables.insert(tables.end(), {table, ""});
        const FoundKey& found = outcome.keys[k];
        at->second +=
            fmt::format("{} = {:.6g}  # {}\n", key, std::get<double>(settings[k].value),
                        !found.determined         ? "not determined by the targets"
                        : rock.free[k].of.empty() ? fmt::format("95 %: {:.4g} to {:.4g}", found.low, found.high)
                                                  : fmt::format("{:.4g} of {}, 95 %: {:.4g} to {:.4g}", found.value,
                                                                rock.free[k].of, found.low, found.high));
    }
    std::string text;
    for (const auto& [table, lines] : tables) text += fmt::format("[{}]\n{}", table, lines);
    return text;
}

void write_calibration(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder) {
    const std::vector<double> values = outcome.values();
    for (std::size_t test = 0; test < rock.tests.size(); ++test) {
        std::ostringstream out;
        write_resolved_case(out, rock.case_of(test, values), folder);
        replace_file(folder / (rock.tests[test].name + ".toml"), out.str());
    }
    replace_file(folder / "rock.toml", fmt::format("# {}: keys as `crackle calibrate` has found them; calibration.txt "
                                                   "says what they reach.\n{}",
                                                   rock.title, found_keys_toml(rock, outcome)));
    replace_file(folder / "calibration.json", calibration_json(rock, outcome).dump(2) + "\n");
    replace_file(folder / "calibration.txt", calibration_text(rock, outcome));
}

}  // namespace crackle
