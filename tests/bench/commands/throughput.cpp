// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench throughput`: measures the engine's speed and the machine's limits in the same run.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/commands/gnuplot.hpp"
#include "tests/bench/commands/results_folder.hpp"
#include "tests/bench/throughput/bare_kernel.hpp"
#include "tests/bench/throughput/flowing.hpp"
#include "tests/bench/throughput/machine_limits.hpp"
#include "tests/bench/throughput/median_interval.hpp"
#include "tests/bench/throughput/timed_test.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace throughput;

struct Row {
    std::string scene;
    std::int64_t particles = 0;
    int threads = 1;
    double contacts = 0.0;   // number of contacts per particle
    double rate = 0.0;       // particle-steps / s
    double bare = 0.0;       // bare kernel on the same discs, particle-steps/s; 0 if not measured
    double bytes = 0.0;      // bytes of memory per particle; 0 if unknown
    double list = 0.0;       // number of steps per neighbour list; 0 if unknown
    std::int64_t count = 0;  // requested number of circles, from which polygons are meshed
};

/// Takes steps for the given time. @return particle-steps per second
template <class Step>
double rate_of(std::size_t particles, double seconds, Step step) {
    std::int64_t steps = 0;
    const std::int64_t together = std::max<std::int64_t>(1, 20000 / static_cast<std::int64_t>(particles));
    const Clock::time_point begun = Clock::now();
    double took = 0.0;
    while (took < seconds) {
        for (std::int64_t k = 0; k < together; ++k) step();
        steps += together;
        took = std::chrono::duration<double>(Clock::now() - begun).count();
    }
    return static_cast<double>(particles) * static_cast<double>(steps) / took;
}

struct Settings {
    double seconds;
    int repeats;
    fs::path folder;
    std::size_t empty_process;
};

/// Speed of the bare kernel on the discs of a timed test.
double bare_rate(std::int64_t count, double seconds) {
    World world = build_world(timed_discs(count));
    compute_forces(world);
    BareKernel bare(world);
    return rate_of(bare.bodies(), seconds, [&] { bare.step(); });
}

Row measure_test(const Settings& settings, const std::string& kind, std::int64_t count, int threads, bool with_bare) {
    std::vector<double> rates, bares;
    Row row{kind, count, threads, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < settings.repeats; ++k) {
        const TimedTest timed =
            time_test({kind, count, threads, settings.seconds}, settings.folder / "scratch", settings.empty_process);
        rates.push_back(timed.rate());
        row.particles = timed.particles;
        row.contacts = timed.contacts_per_particle;
        row.count = count;
        if (k == 0) row.bytes = timed.bytes_per_particle;  // later runs include memory left by earlier ones
        if (with_bare) bares.push_back(bare_rate(count, 0.25 * settings.seconds));
    }
    row.rate = median(rates);
    if (with_bare) row.bare = median(bares);
    return row;
}

/// Runs flowing columns one after another for the given time in total, each for as long as it flows.
Row measure_flow(const Settings& settings, bool polygons, std::int64_t count) {
    constexpr int until_in_touch = 100;  // steps
    std::vector<double> rates, lists;
    Row row{polygons ? "flowing hexagons" : "flowing circles", count, 1, 0.0, 0.0, 0.0, 0.0, 0.0};
    const FlowingColumn column = flowing_column(count, polygons);
    for (int k = 0; k < settings.repeats; ++k) {
        double took = 0.0, steps = 0.0, builds = 0.0;
        while (took < settings.seconds) {
            World world = build_world(column.scene);
            row.particles = static_cast<std::int64_t>(world.bodies.size());
            for (int n = 0; n < until_in_touch; ++n) step(world);
            const std::int64_t first_step = world.stepping.steps, first_build = world.list.builds;
            const Clock::time_point begun = Clock::now();
            const auto gone = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
            const std::int64_t together = std::max<std::int64_t>(1, 20000 / row.particles);
            while (world.stepping.time < column.lasts && took + gone() < settings.seconds)
                for (std::int64_t n = 0; n < together; ++n) step(world);
            took += gone();
            steps += static_cast<double>(world.stepping.steps - first_step);
            builds += static_cast<double>(world.list.builds - first_build);
            std::int64_t touching = 0;
            for (const PointState point : world.points.state) touching += (point.flags & point_touching) != 0 ? 1 : 0;
            row.contacts = static_cast<double>(touching) / static_cast<double>(row.particles);
        }
        rates.push_back(static_cast<double>(row.particles) * steps / took);
        lists.push_back(builds > 0.0 ? steps / builds : 0.0);
    }
    row.rate = median(rates);
    row.list = median(lists);
    return row;
}

struct Limits {
    double l1, l2, memory;  // GB/s
};

std::string shown(double value, const char* format) {
    return value > 0.0 ? fmt::format(fmt::runtime(format), value) : "–";
}

/// Time per particle and step, relative to the same number of circles on one thread; 0 if these were not measured.
double times_circles(const std::vector<Row>& rows, const Row& row) {
    if (row.scene == "circles" || row.count == 0) return 0.0;
    for (const Row& other : rows)
        if (other.scene == "circles" && other.threads == 1 && other.count == row.count) return other.rate / row.rate;
    return 0.0;
}

std::string page_of(const std::string& command, const Limits& limits, const std::vector<Row>& rows) {
    std::string text = fmt::format(
        "# Throughput\n\nMade by `{}` on {}, kernels for {}, {} lanes of doubles, one process. Triad: {:.0f} GB/s in "
        "the first cache, "
        "{:.0f} in the second, {:.0f} in memory. Rates are million particle-steps per second of the whole engine, as "
        "in `crackle test` (bonds, friction, dashpots, platens, curve, events, frames; a curve row every 100 steps). "
        "The bare kernel has no neighbour search, bonds, energy balance, controls or observers. `coulomb`, `faces` and "
        "`pressure` are the cells of `voronoi` with stiffnesses per area, bonded by coulomb points, by faces, and by "
        "faces with pressures of the cells. Times circles: time per particle and step over that of as many circles. "
        "Contacts: bonded points or faces per particle. Memory: peak resident set while stepping minus that of an "
        "empty process. Flowing: "
        "a "
        "collapsing column without its right wall, whose front is as fast as that of a dam break; contacts are "
        "touching points. Steps per list: number of steps for which a neighbour list remains valid.\n\n"
        "| scene | particles | threads | contacts per particle | rate, M/s | bare kernel, M/s | ratio | ns per "
        "particle | times circles | bytes per particle | steps per list |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        command, processor_name(), name_of(chosen_set()), lanes_of(chosen_set()), limits.l1, limits.l2, limits.memory);
    for (const Row& row : rows) {
        text += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | {} | {} | {:.1f} | {} | {} | {} |\n", row.scene,
                            row.particles, row.threads, row.contacts, 1e-6 * row.rate, shown(1e-6 * row.bare, "{:.2f}"),
                            shown(row.bare > 0.0 ? row.rate / row.bare : 0.0, "{:.2f}"), 1e9 / row.rate,
                            shown(times_circles(rows, row), "{:.2f}"), shown(row.bytes, "{:.0f}"),
                            shown(row.list, "{:.1f}"));
    }
    return text;
}

std::string table_of(const std::string& command, const Limits& limits, const std::vector<Row>& rows) {
    std::string text = fmt::format(
        "# Made by `{}` on {}. triad [GB/s]: {:.1f} first cache, {:.1f} second, {:.1f} memory.\n"
        "scene,particles,threads,contacts_per_particle,particle_steps_per_second,bare_kernel_per_second,"
        "bytes_per_particle,steps_per_list\n",
        command, processor_name(), limits.l1, limits.l2, limits.memory);
    for (const Row& row : rows) {
        text += fmt::format("{},{},{},{:.4g},{:.5g},{:.5g},{:.4g},{:.4g}\n", row.scene, row.particles, row.threads,
                            row.contacts, row.rate, row.bare, row.bytes, row.list);
    }
    return text;
}

/// Draws speed against size, with one curve per scene.
std::string script_of(const std::vector<Row>& rows) {
    std::string data, plots;
    const auto add = [&](const std::string& name, const std::string& title, auto chosen, auto value) {
        std::string points;
        for (const Row& row : rows) {
            if (chosen(row)) points += fmt::format("{} {:.5g}\n", row.particles, 1e-6 * value(row));
        }
        if (points.empty()) return;
        data += fmt::format("${} << EOD\n{}EOD\n", name, points);
        plots += fmt::format("{}${} with linespoints lw 1.6 title \"{}\"", plots.empty() ? "" : ", ", name, title);
    };
    const auto rate = [](const Row& row) { return row.rate; };
    for (const int threads : {1, 2}) {
        add(
            fmt::format("circles{}", threads),
            fmt::format("bonded circles, {} thread{}", threads, threads > 1 ? "s" : ""),
            [=](const Row& row) { return row.scene == "circles" && row.threads == threads; }, rate);
    }
    add(
        "bare", "bare kernel", [](const Row& row) { return row.bare > 0.0; }, [](const Row& row) { return row.bare; });
    for (const char* kind : {"voronoi", "delaunay", "coulomb", "faces", "pressure"})
        add(
            kind, kind, [=](const Row& row) { return row.scene == kind; }, rate);
    add(
        "flow", "flowing circles", [](const Row& row) { return row.scene == "flowing circles"; }, rate);
    add(
        "flow_polygons", "flowing hexagons", [](const Row& row) { return row.scene == "flowing hexagons"; }, rate);
    return "# SPDX-License-Identifier: GPL-3.0-or-later\n" + data +
           "set terminal svg size 640,420 font \"DejaVu Sans,11\" background rgb 'white'\nset output "
           "\"throughput.svg\"\nset logscale xy\nset format x \"10^{%L}\"\nset grid lc rgb '#d8d8d8'\n"
           "set xlabel \"particles\"\nset ylabel \"million particle-steps per second\"\nset key outside right\n"
           "plot " +
           plots + "\n";
}

}  // namespace

CommandLine describe_bench_throughput() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR")->default_value("out/throughput"),
                          "folder for throughput.md, .csv, .svg")  //
        ("counts", po::value<std::vector<std::int64_t>>()->multitoken()->value_name("N"),
         "numbers of circles (default 300 1000 5000 50000 1000000; quick: 300 5000)")                                 //
        ("seconds", po::value<double>()->value_name("X"), "duration of each run's stepping (default 2; quick: 0.3)")  //
        ("repeats", po::value<int>()->value_name("N"),
         "runs of a scene, of which the median is used (default 3; quick: 1)")  //
        ("kinds", po::value<std::vector<std::string>>()->multitoken()->value_name("KIND"),
         "circles, voronoi, delaunay, coulomb, faces, pressure, flowing (default all, polygons up to 50000)")  //
        ("threads", po::value<std::vector<int>>()->multitoken()->value_name("N"), "of circles (default 1 2)")  //
        ("quick", "small and short");
    return {.synopses = {"crackle-bench throughput [OPTIONS]"},
            .description =
                "Measures the engine's rate for several sizes, threads and kinds of specimens, and compares it with a "
                "bare kernel and the memory's bandwidth in the same run.",
            .options = {{"options", options}},
            .verbose = "seconds of each row",
            .examples = {{"crackle-bench throughput --quick", "seconds: small scenes, half a second each"},
                         {"crackle-bench throughput -o out/throughput",
                          "minutes: up to a million circles; throughput.md, .csv, .svg"},
                         {"crackle-bench throughput --counts 300 5000 --repeats 5"},
                         {"crackle-bench throughput --kinds circles voronoi --threads 1"}},
            .notes = {
                "Rates are particle-steps per second. Machines are noisy, so compare only values of the same table."}};
}

int bench_throughput(const Invocation& invocation) {
    const std::size_t empty_process = peak_memory();
    const po::variables_map& given = invocation.values;
    Messages& messages = invocation.messages;
    const bool quick = given.contains("quick");
    const auto counts = given.contains("counts") ? given["counts"].as<std::vector<std::int64_t>>()
                        : quick                  ? std::vector<std::int64_t>{300, 5000}
                                                 : std::vector<std::int64_t>{300, 1000, 5000, 50'000, 1'000'000};
    for (const std::int64_t count : counts) {
        if (count < 100 || count > 4'000'000)
            throw InputError(
                fmt::format("crackle-bench throughput: --counts: found {}, expected 100 to 4000000", count));
    }
    Settings settings{given.contains("seconds") ? given["seconds"].as<double>()
                      : quick                   ? 0.3
                                                : 2.0,
                      given.contains("repeats") ? given["repeats"].as<int>()
                      : quick                   ? 1
                                                : 3,
                      given["output"].as<std::string>(), empty_process};
    if (!(settings.seconds > 0.0 && settings.seconds <= 600.0))
        throw InputError(fmt::format("crackle-bench throughput: --seconds: found {}, expected above 0, at most 600",
                                     settings.seconds));
    if (settings.repeats < 1 || settings.repeats > 100)
        throw InputError(
            fmt::format("crackle-bench throughput: --repeats: found {}, expected 1 to 100", settings.repeats));
    const std::vector<std::string> all_kinds{"circles", "voronoi",  "delaunay", "coulomb",
                                             "faces",   "pressure", "flowing"};
    const auto kinds = given.contains("kinds") ? given["kinds"].as<std::vector<std::string>>() : all_kinds;
    for (const std::string& kind : kinds) {
        if (std::ranges::find(all_kinds, kind) == all_kinds.end())
            throw InputError(fmt::format("crackle-bench throughput: --kinds: found '{:.40}', expected some of {}", kind,
                                         fmt::join(all_kinds, ", ")));
    }
    const auto wanted = [&](const char* kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
    const auto thread_counts =
        given.contains("threads") ? given["threads"].as<std::vector<int>>() : std::vector<int>{1, 2};
    for (const int number : thread_counts) {
        if (number < 1 || number > 64)
            throw InputError(fmt::format("crackle-bench throughput: --threads: found {}, expected 1 to 64", number));
    }
    make_results_folder(settings.folder);

    std::string command = "crackle-bench throughput";
    for (const std::string& word : invocation.words) command += ' ' + word;
    const Limits limits{triad_bandwidth(std::size_t{24} << 10, 0.2), triad_bandwidth(std::size_t{384} << 10, 0.2),
                        triad_bandwidth(std::size_t{384} << 20, 0.5)};
    std::vector<Row> rows;
    const auto add = [&](const Row& row) {
        rows.push_back(row);
        messages.stage(
            fmt::format("{:<18}{:>9} on {}: {:7.2f} M/s{}", row.scene, row.particles, row.threads, 1e-6 * row.rate,
                        row.bare > 0.0 ? fmt::format(", {:.2f} of the bare kernel", row.rate / row.bare) : ""));
        replace_file(settings.folder / "throughput.md", page_of(command, limits, rows));
        replace_file(settings.folder / "throughput.csv", table_of(command, limits, rows));
    };
    // All rows are planned before the first is run, because the progress line shows their number.
    struct Planned {
        std::string what;
        std::function<Row()> measure;
    };
    std::vector<Planned> plan;
    const auto plan_test = [&](const std::string& kind, std::int64_t count, int threads, bool with_bare) {
        plan.push_back({fmt::format("{} {} on {}", count, kind, threads),
                        [=, &settings] { return measure_test(settings, kind, count, threads, with_bare); }});
    };
    for (const int number : thread_counts) {
        for (const std::int64_t count : counts) {
            if (wanted("circles") && (number == 1 || count >= 5000)) plan_test("circles", count, number, number == 1);
        }
    }
    for (const char* kind : {"voronoi", "delaunay", "coulomb", "faces", "pressure"}) {
        for (const std::int64_t count : counts) {
            if (wanted(kind) && (count <= 50'000 || given.contains("kinds"))) plan_test(kind, count, 1, false);
        }
    }
    for (const bool polygons : {false, true}) {
        if (!wanted("flowing")) break;
        for (const std::int64_t count : {std::int64_t{582}, std::int64_t{50'000}}) {
            if (count > *std::max_element(counts.begin(), counts.end())) continue;
            plan.push_back({fmt::format("{} flowing {}", count, polygons ? "hexagons" : "circles"),
                            [=, &settings] { return measure_flow(settings, polygons, count); }});
        }
    }
    messages.progress().begin("", static_cast<double>(plan.size()), "rows");
    for (const Planned& planned : plan) {
        messages.progress().step(static_cast<double>(rows.size()), planned.what);
        add(planned.measure());
    }
    messages.make_room();
    std::error_code failed;
    fs::remove_all(settings.folder / "scratch", failed);
    replace_file(settings.folder / "throughput.gp", script_of(rows));
    const std::string problem = draw_with_gnuplot(settings.folder / "throughput.gp");
    if (!problem.empty()) messages.notice(problem + ". throughput.csv is complete");
    std::cout << page_of(command, limits, rows);
    return exit_done;
}

}  // namespace crackle::tools
