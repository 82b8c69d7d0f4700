// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench accuracy`: writes work-precision curves as a table and a picture.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/bench/accuracy/accuracy.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/commands/gnuplot.hpp"
#include "tests/bench/commands/results_folder.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using accuracy::AccuracyRow;
using accuracy::AccuracyStudy;

std::string table_of(const std::vector<AccuracyRow>& rows, const std::string& command) {
    std::string text = fmt::format(
        "# Made by `{}`. cpu_seconds: processor time, median of 3 runs (1 run if above 0.5 s).\n"
        "# parameter time_step: value over the stable step [-]; axial_strain_rate: value in 1/s; rate_tolerance [-].\n"
        "study,law,integrator,parameter,value,cpu_seconds [s],error [-]\n",
        command);
    for (const AccuracyRow& r : rows) {
        text += fmt::format("{},{},{},{},{:.6g},{:.4g},{:.6g}\n", r.study, r.law, r.integrator, r.parameter, r.value,
                            r.cpu_seconds, r.error);
    }
    return text;
}

/// Appearance of a curve, the same in all panels.
struct Curve {
    const char *law, *integrator, *parameter, *label, *style;
};
constexpr Curve curves[] = {
    {"rounded", "leapfrog", "time_step", "rounded, leapfrog: time step", "lc rgb '#0072b2' pt 7 dt 1"},
    {"rounded", "consistent", "time_step", "rounded, consistent: time step", "lc rgb '#d55e00' pt 5 dt 1"},
    {"demseg", "leapfrog", "time_step", "demseg, leapfrog: time step", "lc rgb '#009e73' pt 9 dt 1"},
    {"rounded", "leapfrog", "axial_strain_rate", "rounded, leapfrog: loading rate", "lc rgb '#0072b2' pt 6 dt 2"},
    {"rounded", "consistent", "axial_strain_rate", "rounded, consistent: loading rate", "lc rgb '#d55e00' pt 4 dt 2"},
    {"demseg", "leapfrog", "axial_strain_rate", "demseg, leapfrog: loading rate", "lc rgb '#009e73' pt 8 dt 2"},
    {"rounded", "leapfrog", "rate_tolerance", "rounded, leapfrog: rate tolerance", "lc rgb '#000000' pt 11 dt 3"},
};

// An error of 0 cannot be shown on a logarithmic axis; it is drawn at the round-off of a double.
constexpr double smallest_drawn = 1e-16;

/// Panels are in rows of three; the legend has its own cell.
std::string script_of(const std::vector<const AccuracyStudy*>& studies, const std::vector<AccuracyRow>& rows) {
    const std::size_t columns = std::min<std::size_t>(3, studies.size() + 1);
    const std::size_t lines = (studies.size() + columns) / columns;
    const std::size_t width = 420 * columns, height = 340 * lines;
    std::string data, panels;
    for (const AccuracyStudy* study : studies) {
        std::string plots;
        for (std::size_t c = 0; c < std::size(curves); ++c) {
            std::string points;
            for (const AccuracyRow& r : rows) {
                if (r.study != study->name || r.law != curves[c].law || r.integrator != curves[c].integrator ||
                    r.parameter != curves[c].parameter || !std::isfinite(r.error))
                    continue;
                points += fmt::format("{:.6g} {:.6g}\n", r.cpu_seconds, std::max(r.error, smallest_drawn));
            }
            if (points.empty()) continue;
            data += fmt::format("${}_{} << EOD\n{}EOD\n", study->name, c, points);
            plots += fmt::format("{}${}_{} with linespoints linestyle {} notitle", plots.empty() ? "" : ", ",
                                 study->name, c, c + 1);
        }
        if (plots.empty()) plots = "NaN notitle";  // no run gave a finite error
        panels += fmt::format("set title \"{}\"\nset ylabel \"{}\"\nplot {}\n", study->title, study->error, plots);
    }
    std::string styles, keys;
    for (std::size_t c = 0; c < std::size(curves); ++c) {
        styles += fmt::format("set linetype {0} {1} lw 1.6 ps 0.9\nset style line {0} {1} lw 1.6 ps 0.9\n", c + 1,
                              curves[c].style);
        keys +=
            fmt::format("{}NaN with linespoints linestyle {} title \"{}\"", c == 0 ? "" : ", ", c + 1, curves[c].label);
    }
    const std::string body = fmt::format(
        "set multiplot layout {},{} margins char 10,2,4,2 spacing char 12,6\n"
        "set logscale xy\nset format x \"10^{{%L}}\"\nset format y \"10^{{%L}}\"\n"
        "set xtics 10\nset grid xtics ytics lc rgb '#d8d8d8' lw 0.6\nset tics scale 0.6\n"
        "set xlabel \"CPU time [s]\"\nset offsets graph 0.05, graph 0.05, graph 0.08, graph 0.08\n"
        "{}{}"
        "unset title\nunset xlabel\nunset ylabel\nunset tics\nunset border\nunset grid\nunset logscale\nunset offsets\n"
        "set xrange [0:1]\nset yrange [0:1]\nset key left center Left reverse samplen 3 spacing 1.4\n"
        "plot {}\nunset multiplot\n",
        lines, columns, styles, panels, keys);
    std::string script = "# SPDX-License-Identifier: GPL-3.0-or-later\n" + data;
    for (const auto& [terminal, name] : {std::pair{"pngcairo", "accuracy.png"}, std::pair{"svg", "accuracy.svg"}}) {
        script += fmt::format(
            "reset\nset terminal {} size {},{} font \"DejaVu Sans,11\" background rgb 'white'\n"
            "set output \"{}\"\n{}set output\n",
            terminal, width, height, name, body);
    }
    return script;
}

std::vector<const AccuracyStudy*> chosen(const std::vector<std::string>& only) {
    std::vector<const AccuracyStudy*> some;
    std::string names;
    for (const AccuracyStudy& study : accuracy::accuracy_studies()) {
        names += (names.empty() ? "" : ", ") + study.name;
        if (only.empty() || std::find(only.begin(), only.end(), study.name) != only.end()) some.push_back(&study);
    }
    for (const std::string& name : only) {
        if (std::none_of(some.begin(), some.end(), [&](const AccuracyStudy* s) { return s->name == name; }))
            throw InputError(
                fmt::format("crackle-bench accuracy: found no study '{}', expected one of {}", name, names));
    }
    return some;
}

}  // namespace

CommandLine describe_bench_accuracy() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR")->default_value("."),
                          "folder for accuracy.csv and its figure")  //
        ("quick", "fewer and shorter runs")                          //
        ("only", po::value<Arguments>()->value_name("STUDY"), "this study; may be given more than once");
    Choices names{"only", {}};
    for (const AccuracyStudy& study : accuracy::accuracy_studies()) names.words.push_back(study.name);
    return {.synopses = {"crackle-bench accuracy [OPTIONS]"},
            .description =
                "Measures error against processor time, for several time steps and loading rates, and for each contact "
                "law and integrator.",
            .options = {{"options", options}},
            .choices = {names},
            .verbose = "seconds of each study",
            .examples = {{"crackle-bench accuracy -o accuracy", "minutes; writes accuracy.csv, .gp, .svg and .png"},
                         {"crackle-bench accuracy -o accuracy --quick", "seconds, with fewer and shorter runs"},
                         {"crackle-bench accuracy --only bounce_energy"}}};
}

int bench_accuracy(const Invocation& invocation) {
    const po::variables_map& given = invocation.values;
    Messages& messages = invocation.messages;
    const auto only =
        given.contains("only") ? given["only"].as<std::vector<std::string>>() : std::vector<std::string>{};
    const std::vector<const AccuracyStudy*> studies = chosen(only);
    const fs::path folder = given["output"].as<std::string>();
    make_results_folder(folder);

    const bool quick = given.contains("quick");
    std::string command = "crackle-bench accuracy";
    if (quick) command += " --quick";
    for (const std::string& name : only) command += " --only " + name;
    replace_file(folder / "accuracy.csv", table_of({}, command));  // fails early if the file cannot be written
    std::vector<AccuracyRow> rows;
    messages.progress().begin(studies.front()->name, static_cast<double>(studies.size()), "studies");
    double done = 0.0;
    for (const AccuracyStudy* study : studies) {
        messages.progress().step(done++, study->name);
        const std::vector<AccuracyRow> more = study->run(quick);
        rows.insert(rows.end(), more.begin(), more.end());
        messages.stage(fmt::format("{:<20} {} runs", study->name, more.size()));
        replace_file(folder / "accuracy.csv", table_of(rows, command));
    }
    replace_file(folder / "accuracy.gp", script_of(studies, rows));
    const std::string problem = draw_with_gnuplot(folder / "accuracy.gp");
    if (!problem.empty())
        messages.notice(problem + ". accuracy.csv is complete; draw the figure later with gnuplot accuracy.gp");
    return exit_done;
}

}  // namespace crackle::tools
