// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/guide/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/bench/guide/experiments.hpp"
#include "tests/bench/guide/rows.hpp"

namespace crackle::studies {
namespace {

std::string number(double value) {
    return std::abs(value) >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string ours(const Spread& spread) {
    if (spread.packings == 0) return "–";
    if (spread.packings == 1) return number(spread.mean) + " (1)";
    return fmt::format("{} ± {:.2g} ({})", number(spread.mean), spread.deviation, spread.packings);
}

std::string verdict(const GuideRow& row, const Spread& spread) {
    const GuideVerdict judged = judge(row, spread);
    if (!row.judged()) return "";
    if (judged == GuideVerdict::open) return "–";
    if (judged == GuideVerdict::inside) return "inside";
    return fmt::format("**outside**, {:+.0f} %", 100.0 * (spread.mean / row.guide - 1.0));
}

Spread row_spread(const GuideRow& row, const GuidePage& page, const GuideResults& results, const std::string& law) {
    std::vector<double> values;
    for (std::int64_t seed = 1; seed <= page.packings; ++seed)
        values.push_back(row_value(row, results, as_shipped, law, seed));
    return spread_of(values);
}

/// Effect of an experiment on a row, from the packings that were tested with and without it.
struct Effect {
    std::string law, experiment, sentence;
    int packings = 0;
    double before = 0.0, after = 0.0;
    bool reaches = false;
};

std::optional<Effect> effect_of(const GuideRow& row, const GuidePage& page, const GuideResults& results,
                                const std::string& law, const std::string& other_law, const std::string& experiment,
                                const Spread& shipped) {
    std::vector<double> before, after;
    for (std::int64_t seed = 1; seed <= page.packings; ++seed) {
        const double with = row_value(row, results, experiment, other_law, seed);
        const double without = row_value(row, results, as_shipped, law, seed);
        if (std::isnan(with) || std::isnan(without)) continue;
        before.push_back(without);
        after.push_back(with);
    }
    if (before.empty()) return std::nullopt;
    const Spread a = spread_of(before), b = spread_of(after);
    return Effect{law,
                  experiment,
                  guide_experiment(experiment).sentence,
                  a.packings,
                  a.mean,
                  b.mean,  // A change smaller than the scatter is no effect, even if it crosses the limit.
                  reaches_guide(row, b.mean, shipped) && std::abs(b.mean - a.mean) >= shipped.deviation};
}

bool touches(const GuideExperiment& experiment, const GuideRow& row) {
    return std::any_of(row.tests.begin(), row.tests.end(),
                       [&](const auto& test) { return experiment.reach.holds(test.first, test.second); });
}

bool takes_polygons(const GuideRow& row) {
    return std::any_of(row.tests.begin(), row.tests.end(), [](const auto& test) { return test.first != "circles"; });
}

std::vector<Effect> effects_on(const GuideRow& row, const GuidePage& page, const GuideResults& results,
                               const std::string& law) {
    const Spread shipped = row_spread(row, page, results, law);
    std::vector<Effect> effects;
    for (const std::string& other : page.laws) {
        if (other == law || !takes_polygons(row)) continue;
        if (auto effect = effect_of(row, page, results, law, other, as_shipped, shipped)) {
            effect->experiment = "law " + other;
            effect->sentence = fmt::format("contact law {} instead of {}", other, law);
            effects.push_back(*effect);
        }
    }
    for (const GuideExperiment& experiment : guide_experiments()) {
        if (experiment.name == as_shipped || !touches(experiment, row)) continue;
        if (auto effect = effect_of(row, page, results, law, law, experiment.name, shipped)) effects.push_back(*effect);
    }
    return effects;
}

/// One sentence on the results of the experiments, derived only from their numbers.
std::string finding(const GuideRow& row, const std::vector<Effect>& effects) {
    std::vector<std::string> reaching;
    const Effect* nearest = nullptr;
    for (const Effect& effect : effects) {
        if (effect.reaches) reaching.push_back(fmt::format("`{}` ({})", effect.experiment, number(effect.after)));
        const auto gain = [&](const Effect& e) {
            return std::abs(row.guide - e.before) - std::abs(row.guide - e.after);
        };
        if (gain(effect) > 0.0 && (nearest == nullptr || gain(effect) > gain(*nearest))) nearest = &effect;
    }
    if (!reaching.empty()) return fmt::format("Brings it inside: {}.", fmt::join(reaching, ", "));
    if (nearest != nullptr) {
        return fmt::format("None alone brings it inside; the largest change towards it is that of `{}`: {} → {}.",
                           nearest->experiment, number(nearest->before), number(nearest->after));
    }
    return "None changes it towards the guide's value.";
}

/// Groups laws that give the same value in a row. Rows about circles or the mesh have only one group.
std::vector<std::vector<std::string>> laws_alike(const GuideRow& row, const GuidePage& page,
                                                 const GuideResults& results) {
    std::vector<std::vector<std::string>> groups;
    for (const std::string& law : page.laws) {
        const double mean = row_spread(row, page, results, law).mean;
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
            return row_spread(row, page, results, group.front()).mean == mean;
        });
        if (same == groups.end()) {
            groups.push_back({law});
        } else {
            same->push_back(law);
        }
    }
    return groups;
}

std::string experiments_of(const GuideRow& row, const GuidePage& page, const GuideResults& results) {
    std::string text;
    for (const std::vector<std::string>& laws : laws_alike(row, page, results)) {
        const std::string& law = laws.front();
        const Spread shipped = row_spread(row, page, results, law);
        if (judge(row, shipped) != GuideVerdict::outside) continue;
        text += fmt::format("\n### {}: the guide {}, ours {}{}\n\n", row.words, row.guide_text, ours(shipped),
                            takes_polygons(row) ? fmt::format(", {}", fmt::join(laws, " and ")) : "");
        const std::vector<Effect> effects = effects_on(row, page, results, law);
        if (effects.empty()) {
            text += "No experiment has been run for it.\n";
            continue;
        }
        text += finding(row, effects) + "\n\n";
        std::vector<std::string> idle;
        std::string lines;
        for (const Effect& e : effects) {
            // The change is smaller than the digits that the page prints, so the experiment does not affect this row.
            if (std::abs(e.after - e.before) < 5e-4 * std::abs(e.before)) {
                idle.push_back("`" + e.experiment + "`");
                continue;
            }
            lines += fmt::format("| {} | {} | {} | {} | {} | {} |\n", e.experiment, e.sentence, e.packings,
                                 number(e.before), number(e.after), e.reaches ? "inside" : "outside");
        }
        if (!lines.empty()) {
            text +=
                "| experiment | what it changes | packings | as shipped | changed | the guide's value |\n"
                "| --- | --- | --- | --- | --- | --- |\n" +
                lines;
        }
        if (!idle.empty())
            text += fmt::format("{}Without effect: {}.\n", lines.empty() ? "" : "\n", fmt::join(idle, ", "));
    }
    return text;
}

std::string table(const GuidePage& page, const GuideResults& results) {
    std::string head = "| what | the guide |", rule = "| --- | --- |", text;
    for (const std::string& law : page.laws) {
        head += fmt::format(" {}: ours | verdict |", law);
        rule += " --- | --- |";
    }
    for (const GuideRow& row : guide_rows()) {
        text += fmt::format("| {} | {} |", row.words, row.judged() ? row.guide_text : "");
        for (const std::string& law : page.laws) {
            const Spread spread = row_spread(row, page, results, law);
            text += fmt::format(" {} | {} |", ours(spread), verdict(row, spread));
        }
        text += '\n';
    }
    return head + '\n' + rule + '\n' + text;
}

/// Lists tests that are missing, have no result or did not fail.
std::string notices(const GuidePage& page, const GuideResults& results) {
    std::string text;
    if (page.tests_missing > 0)
        text += fmt::format("- {} tests of this plan have not been run yet; the same command runs them.\n",
                            page.tests_missing);
    for (const auto& [test, result] : results) {
        const std::string who =
            fmt::format("{}, {}, {}, {}, seed {}", test.experiment, test.law, test.specimen, test.loading, test.seed);
        if (!result.error.empty()) text += fmt::format("- {}: no result: {}\n", who, result.error);
        const auto failed = result.quantities.find("failed");
        if (failed != result.quantities.end() && failed->second == 0.0)
            text += fmt::format("- {}: has not failed; its largest stress is the largest so far.\n", who);
    }
    return text.empty() ? text : "\n## Notices\n\n" + text;
}

}  // namespace

std::string guide_page(const GuidePage& page, const GuideResults& results) {
    std::string text = fmt::format(
        "# The guide's rock, as an ensemble\n\nMade by `{}`; every number is in guide.csv.\n\n"
        "Packings have the seeds 1 to {} of the shipped rock. Ours: mean ± standard deviation (packings). **Inside**: "
        "the guide's value, which is that of one packing, differs from our mean by at most two standard deviations or "
        "by its rounding. If the guide states «larger», our mean is larger. Strengths are means over fewer packings "
        "because they need complete runs{}. Circles are tested once, since the laws differ only for polygons (and by "
        "0.02 % of the modulus if a circle touches the end of a platen). Run times are processor seconds per simulated "
        "second, on one thread.\n\n",
        page.command, page.packings,
        page.rate_factor == 1.0 ? std::string(" (loaded as shipped)")
                                : fmt::format(" (loaded {:g} times as fast as shipped)", page.rate_factor));
    text += table(page, results);
    std::string experiments;
    for (const GuideRow& row : guide_rows()) {
        if (row.judged()) experiments += experiments_of(row, page, results);
    }
    if (!experiments.empty()) {
        text +=
            "\n## What changes the rows outside\n\nEach experiment makes one change to the shipped cases, with the "
            "same packings. Its mean is judged with the relative spread of the shipped case; changes below one "
            "standard deviation count as no effect.\n" +
            experiments;
    }
    return text + notices(page, results);
}

std::string guide_csv(const GuidePage& page, const GuideResults& results) {
    std::string text = "seed,experiment,law,quantity,unit,value\n";
    const auto line = [&](std::int64_t seed, const std::string& experiment, const std::string& law,
                          const std::string& quantity, const std::string& unit, double value) {
        text += fmt::format("{},{},{},{},{},{:.9g}\n", seed, experiment, law, quantity, unit, value);
    };
    for (const GuideExperiment& experiment : guide_experiments()) {
        for (const std::string& law : page.laws) {
            for (const GuideRow& row : guide_rows()) {
                if (!touches(experiment, row)) continue;
                for (std::int64_t seed = 1; seed <= page.packings; ++seed) {
                    const double value = row_value(row, results, experiment.name, law, seed);
                    if (!std::isnan(value)) line(seed, experiment.name, law, row.key, row.unit, value);
                }
            }
        }
    }
    for (const auto& [test, result] : results) {
        for (const auto& [quantity, value] : result.quantities) {
            line(test.seed, test.experiment, test.law, fmt::format("{}.{}.{}", test.specimen, test.loading, quantity),
                 unit_of_quantity(quantity), value);
        }
    }
    return text;
}

}  // namespace crackle::studies
