// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench features`: measures the cost of each feature per contact and step, and the remaining cost of absent
// features.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/commands/gnuplot.hpp"
#include "tests/bench/commands/results_folder.hpp"
#include "tests/bench/throughput/feature_costs.hpp"
#include "tests/bench/throughput/machine_limits.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using namespace throughput;

std::string interval(const MedianInterval& value, double unit, const char* format) {
    const auto number = [&](double x) { return fmt::format(fmt::runtime(format), unit * x); };
    return fmt::format("{} ({} to {})", number(value.median), number(value.low), number(value.high));
}

bool holds_one(const MedianInterval& ratio) { return ratio.low <= 1.0 && 1.0 <= ratio.high; }

std::string page_of(const std::string& command, const FeatureStudy& study, const std::vector<FeatureRow>& rows) {
    std::string text = fmt::format(
        "# The cost of features\n\nMade by `{}` on {}, kernels for {}, {} lanes of doubles, one thread. Processor time "
        "in ns per contact and step; contacts carry load. Medians of {} pairs of runs of about {:g} s with the same "
        "initial state and alternating order; in brackets the distribution-free interval that contains the median with "
        "a probability of 95 % (order statistics). Bodies are displaced by about a hundredth of an overlap.\n\n"
        "## Features one at a time\n\nEach row has one feature more than the row with which it is compared. The first "
        "row repeats its reference, and so shows the accuracy of the measurement. `bonds` moves the walls away, "
        "`driven platens` replaces them, `two materials` gives every second body another friction angle and "
        "stiffness. `faces` replace the coulomb bonds of the same cells; contacts of both are then faces.\n\n"
        "| bodies | feature | compared with | particles | contacts per particle | ns per contact | ns per particle | "
        "additional ns per contact | ratio |\n| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        command, processor_name(), name_of(chosen_set()), lanes_of(chosen_set()), study.pairs, study.seconds);
    for (const FeatureRow& row : rows) {
        if (row.kind != FeatureRowKind::added) continue;
        text += fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.1f} | {} | {} |\n", row.bodies, row.feature,
                            row.beside, row.particles,
                            static_cast<double>(row.contacts) / static_cast<double>(row.particles),
                            1e9 * row.contact_seconds, 1e9 * row.particle_seconds,
                            interval(row.difference, 1e9, "{:.2f}"), interval(row.ratio, 1.0, "{:.3f}"));
    }
    text +=
        "\n## Features that a scene lacks\n\n`dispatched`: force passes with the kernel that the engine chooses, "
        "compared with the kernel compiled without the feature; complete steps, which check for all features, compared "
        "with the minimal step (only forces, their sums, kick and drift: tests/bench/throughput/least_step.hpp). "
        "`forced`: the same scene with a kernel compiled with the unused feature, which shows the cost of a single "
        "kernel for all features. A difference is not resolved if the interval contains 1. Instructions are counted by "
        "`tests/benchmarks/instruction_counts`.\n\n"
        "| bodies | absent | how | compared with | ns per contact | ratio | difference |\n"
        "| --- | --- | --- | --- | ---: | ---: | --- |\n";
    for (const FeatureRow& row : rows) {
        if (row.kind == FeatureRowKind::added) continue;
        text += fmt::format(
            "| {} | {} | {} | {} | {:.2f} | {} | {} |\n", row.bodies, row.feature, name_of(row.kind), row.beside,
            1e9 * row.contact_seconds, interval(row.ratio, 1.0, "{:.3f}"),
            holds_one(row.ratio) ? "not resolved" : fmt::format("{:+.1f} %", 100.0 * (row.ratio.median - 1.0)));
    }
    return text;
}

std::string table_of(const std::string& command, const std::vector<FeatureRow>& rows) {
    std::string text = fmt::format(
        "# Made by `{}` on {}. Times per step; intervals contain the median with a probability of 95 %.\n"
        "kind,bodies,feature,beside,particles,contacts,ns_a_contact,ns_a_particle,ns_a_contact_more,more_low,more_high,"
        "ratio,ratio_low,ratio_high\n",
        command, processor_name());
    for (const FeatureRow& row : rows) {
        text += fmt::format("{},{},\"{}\",\"{}\",{},{},{:.5g},{:.5g},{:.4g},{:.4g},{:.4g},{:.5g},{:.5g},{:.5g}\n",
                            name_of(row.kind), row.bodies, row.feature, row.beside, row.particles, row.contacts,
                            1e9 * row.contact_seconds, 1e9 * row.particle_seconds, 1e9 * row.difference.median,
                            1e9 * row.difference.low, 1e9 * row.difference.high, row.ratio.median, row.ratio.low,
                            row.ratio.high);
    }
    return text;
}

/// A bar chart of the first table, with discs and polygons side by side. It shows ratios, since absolute times of
/// different pairs depend on what else the machine was doing.
std::string script_of(const std::vector<FeatureRow>& rows) {
    const auto data_of = [&](bool discs) {
        std::string data;
        for (const FeatureRow& row : rows) {
            if (row.kind == FeatureRowKind::added && (row.bodies == "discs") == discs)
                data += fmt::format("\"{}\" {:.5g} {:.5g} {:.5g}\n", row.feature, row.ratio.median, row.ratio.low,
                                    row.ratio.high);
        }
        return data;
    };
    return fmt::format(
        "# SPDX-License-Identifier: GPL-3.0-or-later\n$discs << EOD\n{}EOD\n$polygons << EOD\n{}EOD\n"
        "set terminal svg size 900,480 font \"DejaVu Sans,11\" background rgb 'white'\nset output \"features.svg\"\n"
        "set multiplot layout 1,2\nset style fill solid 0.5 noborder\nset errorbars 2\n"
        "set grid ytics lc rgb '#d8d8d8'\nset xtics rotate by 40 right nomirror\nset yrange [0:*]\nset key off\n"
        "set bmargin 11\nset lmargin 15\nset rmargin 1\nset ylabel \"ratio to the compared row\"\n"
        "set title \"discs\"\nplot $discs using 0:2:3:4:(0.7):xtic(1) with boxerrorbars lc rgb '#33608c', 1 lc rgb "
        "'#808080'\nset title \"polygons\"\nplot $polygons using 0:2:3:4:(0.7):xtic(1) with boxerrorbars lc rgb "
        "'#33608c', 1 lc rgb '#808080'\nunset multiplot\n",
        data_of(true), data_of(false));
}

/// Number of rows in both tables, checked by tests/bench_tests/commands/bench_test.cpp; used only for progress.
constexpr std::size_t feature_rows = 44;

FeatureStudy study_of(const po::variables_map& given) {
    const bool quick = given.contains("quick");
    FeatureStudy study;
    study.count = given.contains("count") ? given["count"].as<std::int64_t>() : quick ? 300 : 5000;
    study.pairs = given.contains("pairs") ? given["pairs"].as<int>() : quick ? fewest_for_interval : 15;
    study.seconds = given.contains("seconds") ? given["seconds"].as<double>() : quick ? 0.01 : 0.08;
    if (study.count < 100 || study.count > 1'000'000)
        throw InputError(
            fmt::format("crackle-bench features: --count: found {}, expected 100 to 1000000", study.count));
    if (study.pairs < fewest_for_interval || study.pairs > 1000)
        throw InputError(fmt::format("crackle-bench features: --pairs: found {}, expected {} to 1000", study.pairs,
                                     fewest_for_interval));
    if (!(study.seconds > 0.0 && study.seconds <= 60.0))
        throw InputError(
            fmt::format("crackle-bench features: --seconds: found {}, expected above 0, at most 60", study.seconds));
    return study;
}

}  // namespace

CommandLine describe_bench_features() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR")->default_value("out/features"),
                          "folder for features.md, .csv, .svg")  //
        ("count", po::value<std::int64_t>()->value_name("N"),
         "number of discs, and of polygons, in each scene (default 5000; quick: 300)")  //
        ("pairs", po::value<int>()->value_name("N"),
         "pairs of runs, of which the median is used (default 15; quick: 6)")  //
        ("seconds", po::value<double>()->value_name("X"),
         "approximate duration of a run (default 0.08; quick: 0.01)")  //
        ("quick", "small scenes and short runs");
    return {.synopses = {"crackle-bench features [OPTIONS]"},
            .description =
                "Measures the time per contact and step while features are added one at a time, and the cost of "
                "features that a scene lacks.",
            .options = {{"options", options}},
            .verbose = "seconds of each row",
            .examples = {{"crackle-bench features --quick", "seconds: 300 bodies, short runs"},
                         {"crackle-bench features -o out/features", "minutes: features.md, .csv, .svg"},
                         {"crackle-bench features --count 50000 --pairs 30"}},
            .notes = {"Runs of a pair alternate, so that other work on the machine affects both; if an interval "
                      "contains 1, no difference is shown."}};
}

int bench_features(const Invocation& invocation) {
    const po::variables_map& given = invocation.values;
    Messages& messages = invocation.messages;
    FeatureStudy study = study_of(given);
    const fs::path folder = given["output"].as<std::string>();
    make_results_folder(folder);
    study.scratch = folder / "scratch";

    std::string command = "crackle-bench features";
    for (const std::string& word : invocation.words) command += ' ' + word;
    std::vector<FeatureRow> rows;
    messages.progress().begin("comparing scenes", static_cast<double>(feature_rows), "rows");
    measure_feature_costs(study, [&](const FeatureRow& row) {
        rows.push_back(row);
        messages.stage(fmt::format("{:<11}{:<9}{:<46}{:>8.2f} ns, {} times {}", name_of(row.kind), row.bodies,
                                   row.feature, 1e9 * row.contact_seconds, interval(row.ratio, 1.0, "{:.3f}"),
                                   row.beside));
        messages.progress().count(static_cast<double>(rows.size()));
        replace_file(folder / "features.md", page_of(command, study, rows));
        replace_file(folder / "features.csv", table_of(command, rows));
    });
    std::error_code failed;
    fs::remove_all(study.scratch, failed);
    replace_file(folder / "features.gp", script_of(rows));
    const std::string problem = draw_with_gnuplot(folder / "features.gp");
    messages.make_room();
    if (!problem.empty()) messages.notice(problem + ". features.csv is complete");
    std::cout << page_of(command, study, rows);
    return exit_done;
}

}  // namespace crackle::tools
